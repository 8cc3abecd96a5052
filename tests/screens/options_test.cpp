// Accepted numbers with units, and error texts for files that cannot be written.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cerrno>
#include <filesystem>

#include "common/base/command_hints.h"
#include "common/base/unit_suffix.h"
#include "common/io/number_option.h"
#include "common/io/output_file.h"
#include "common/io/reachable_address.h"
#include "common/io/remote_address.h"
#include "common/io/udp_socket.h"

namespace tandem::io {
namespace {

TEST(NumberOption, AcceptsTheFixedUnitAndReturnsTheNumber) {
  for (const auto& [text, unit] : {std::pair{"20ms", "ms"},
                                   {"20 ms", "ms"},
                                   {"20", "ms"},
                                   {"20%", "%"},
                                   {"20s", "s"},
                                   {"20h", "h"},
                                   {"20kg", "kg"},
                                   {"2e1us", "us"}}) {
    std::string value = text;
    EXPECT_EQ(number_in(0, 100, unit)(value), "") << text;
    EXPECT_EQ(std::stod(value), 20) << text;
    EXPECT_EQ(value.find_first_not_of("0123456789e"), std::string::npos) << value;
  }
}

TEST(NumberOption, NamesTheAllowedUnitForAnotherUnit) {
  for (const char* text : {"2s", "2 min", "5%", "3MS", "1m"}) {
    std::string value = text;
    const std::string problem = number_in(0, 100, "ms")(value);
    EXPECT_NE(problem.find("the unit is ms, and may be left out"), std::string::npos) << problem;
    EXPECT_EQ(value, text) << "nothing is changed that is wrong";
  }
  std::string value = "5s";
  EXPECT_NE(number_in(0, 9, "")(value).find("without a unit"), std::string::npos);
}

TEST(NumberOption, RejectsNonNumbersAndNumbersOutOfRange) {
  for (const char* text : {"", "ms", "x", "1ms2", "1,5", "nan", "inf", "--5", "1 2", "1msms"}) {
    std::string value = text;
    EXPECT_NE(number_in(0, 100, "ms")(value), "") << text;
  }
  std::string value = "200ms";
  EXPECT_EQ(number_in(0, 100, "ms")(value), "\"200ms\" is out of range: must be in [0, 100] ms");
}

TEST(NumberOption, WorksAsAnOptionOfCli) {
  CLI::App app;
  double delay = 0;
  app.add_option("--delay", delay)->transform(number_in(0, 100, "ms"));
  app.parse("--delay 20ms", false);
  EXPECT_EQ(delay, 20);
  EXPECT_THROW(app.parse("--delay 20s", false), CLI::ParseError);
}

TEST(Unit, IsStrippedOnlyAfterADigit) {
  EXPECT_EQ(strip_unit("12s", "s"), "12");
  EXPECT_EQ(strip_unit("12 s", "s"), "12");
  EXPECT_EQ(strip_unit("12", "s"), "12");
  EXPECT_EQ(strip_unit("12ms", "s"), "12ms") << "another unit";
  EXPECT_EQ(strip_unit("s", "s"), "s");
  EXPECT_EQ(strip_unit("5%", "%"), "5");
}

TEST(PrintedCommand, NamesALocalAddressForAWildcardServer) {
  EXPECT_EQ(reachable_address("127.0.0.1:7000"), "127.0.0.1:7000");
  EXPECT_EQ(reachable_address("lab-server.invalid:7000"), "lab-server.invalid:7000");
  for (const char* all : {"0.0.0.0:7000", "[::]:7000"}) {
    const std::string text = reachable_address(all);
    EXPECT_EQ(remote_address_error(text), "");
    auto address = parse_address(text, 0);
    ASSERT_TRUE(address) << text;
    EXPECT_FALSE(address->any()) << text;
    EXPECT_EQ(address->port(), 7000);
    EXPECT_TRUE(bind_udp(*parse_address(text.substr(0, text.rfind(':')) + ":0", 0)))
        << text << " is an address of this machine";
  }
}

TEST(PrintedCommand, IsOmittedWithoutRoom) {
  EXPECT_EQ(strip_commands("a (key r) or b (`x resume`), or c (`y`)"), "a (key r) or b, or c");
  EXPECT_EQ(strip_commands("a (`x"), "a (`x");
}

TEST(PrintedCommand, QuotesWordsForAShell) {
  EXPECT_EQ(shell_quote("/a/b-c_d.e:f=g,h+i%j@k"), "/a/b-c_d.e:f=g,h+i%j@k");
  EXPECT_EQ(shell_quote("it's here"), "'it'\\''s here'");
  EXPECT_EQ(shell_quote(""), "''");
  EXPECT_EQ(state_option("my state"), " --state 'my state'");
  EXPECT_EQ(state_option(""), "");
}

TEST(PrintedCommand, GetsEachMissingOptionOnce) {
  EXPECT_EQ(with_options("ask for `tandem-server ticket --session a`", "tandem-server ticket", " --state /s"),
            "ask for `tandem-server ticket --state /s --session a`");
  EXPECT_EQ(with_options("`tandem-client control resume`", "tandem-client control", " --server h:1 --session a"),
            "`tandem-client control --server h:1 --session a resume`");
  const std::string has = "`tandem-client control --server HOST:PORT drain`";
  EXPECT_EQ(with_options(has, "tandem-client control", " --server h:1"), has);
  EXPECT_EQ(with_options("no command", "tandem-server ticket", " --state /s"), "no command");
  EXPECT_EQ(with_options("`tandem-server tickets`", "tandem-server ticket", " --state /s"), "`tandem-server tickets`");
  EXPECT_EQ(state_option("/var/lib/it's"), " --state '/var/lib/it'\\''s'");
  EXPECT_EQ(state_option(""), "");
}

TEST(OutputFile, ReportsAFullDisk) {
  OutputFile file;
  ASSERT_EQ(file.open("/dev/full", false), "");
  file.write(std::string(100'000, 'x'));
  EXPECT_NE(file.close().find("/dev/full could not be written to the end: the disk is full"), std::string::npos);
  OutputFile small;
  ASSERT_EQ(small.open("/dev/full", false), "");
  small.write("x");
  EXPECT_NE(small.close().find("the disk is full"), std::string::npos) << "found when the buffer is written";
}

TEST(OutputFile, ReportsAMissingPermission) {
  EXPECT_NE(write_error_text(EACCES).find("no permission"), std::string::npos);
  if (geteuid() == 0) return;  // root can write everywhere
  EXPECT_NE(OutputFile::problem("/etc/passwd").find("no permission"), std::string::npos);
}

}  // namespace
}  // namespace tandem::io
