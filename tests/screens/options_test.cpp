// What a person may type for a number with a unit, and what is said of a file that could not be written.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <signal.h>

#include <cerrno>
#include <filesystem>

#include "common/base/printed_command.h"
#include "common/base/unit.h"
#include "common/io/dialled_address.h"
#include "common/io/number_option.h"
#include "common/io/output_file.h"
#include "common/io/own_address.h"
#include "common/io/udp_socket.h"

namespace tandem::io {
namespace {

TEST(NumberOption, TakesTheUnitThatIsFixedAndGivesTheBareNumber) {
  for (const auto& [text, unit] : {std::pair{"20ms", "ms"}, {"20 ms", "ms"}, {"20", "ms"}, {"20%", "%"}, {"20s", "s"}, {"20h", "h"}, {"20kg", "kg"}, {"2e1us", "us"}}) {
    std::string value = text;
    EXPECT_EQ(number_in(0, 100, unit)(value), "") << text;
    EXPECT_EQ(std::stod(value), 20) << text;
    EXPECT_EQ(value.find_first_not_of("0123456789e"), std::string::npos) << value;
  }
}

TEST(NumberOption, NamesTheAllowedUnitWhenAnotherIsTyped) {
  for (const char* text : {"2s", "2 min", "5%", "3MS", "1m"}) {
    std::string value = text;
    const std::string problem = number_in(0, 100, "ms")(value);
    EXPECT_NE(problem.find("the unit is ms, and may be left out"), std::string::npos) << problem;
    EXPECT_EQ(value, text) << "nothing is changed that is wrong";
  }
  std::string value = "5s";
  EXPECT_NE(number_in(0, 9, "")(value).find("without a unit"), std::string::npos);
}

TEST(NumberOption, RefusesWhatIsNoNumberOrOutOfRange) {
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

TEST(Unit, IsTakenOffOnlyBehindADigit) {
  EXPECT_EQ(without_unit("12s", "s"), "12");
  EXPECT_EQ(without_unit("12 s", "s"), "12");
  EXPECT_EQ(without_unit("12", "s"), "12");
  EXPECT_EQ(without_unit("12ms", "s"), "12ms") << "another unit";
  EXPECT_EQ(without_unit("s", "s"), "s");
  EXPECT_EQ(without_unit("5%", "%"), "5");
}

TEST(PrintedCommand, OfAServerOnAllAddressesNamesOneThatIsThisMachines) {
  EXPECT_EQ(dialable("127.0.0.1:7000"), "127.0.0.1:7000");
  EXPECT_EQ(dialable("lab-server.invalid:7000"), "lab-server.invalid:7000");
  for (const char* all : {"0.0.0.0:7000", "[::]:7000"}) {
    const std::string text = dialable(all);
    EXPECT_EQ(dialled_problem(text), "");
    auto address = parse_address(text, 0);
    ASSERT_TRUE(address) << text;
    EXPECT_FALSE(address->any()) << text;
    EXPECT_EQ(address->port(), 7000);
    EXPECT_TRUE(bind_udp(*parse_address(text.substr(0, text.rfind(':')) + ":0", 0))) << text << " is an address of this machine";
  }
}

TEST(PrintedCommand, IsLeftOutWhereThereIsNoRoom) {
  EXPECT_EQ(without_commands("a (key r) or b (`x resume`), or c (`y`)"), "a (key r) or b, or c");
  EXPECT_EQ(without_commands("a (`x"), "a (`x");
}

TEST(PrintedCommand, QuotesWordsForAShell) {
  EXPECT_EQ(shell_word("/a/b-c_d.e:f=g,h+i%j@k"), "/a/b-c_d.e:f=g,h+i%j@k");
  EXPECT_EQ(shell_word("it's here"), "'it'\\''s here'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(state_option_of("my state"), " --state 'my state'");
  EXPECT_EQ(state_option_of(""), "");
}

TEST(PrintedCommand, GetsWhatItNeedsOnce) {
  EXPECT_EQ(with_options("ask for `tandem-server ticket --session a`", "tandem-server ticket", " --state /s"), "ask for `tandem-server ticket --state /s --session a`");
  EXPECT_EQ(with_options("`tandem-client control resume`", "tandem-client control", " --server h:1 --session a"), "`tandem-client control --server h:1 --session a resume`");
  const std::string has = "`tandem-client control --server HOST:PORT drain`";
  EXPECT_EQ(with_options(has, "tandem-client control", " --server h:1"), has);
  EXPECT_EQ(with_options("no command", "tandem-server ticket", " --state /s"), "no command");
  EXPECT_EQ(with_options("`tandem-server tickets`", "tandem-server ticket", " --state /s"), "`tandem-server tickets`");
  EXPECT_EQ(state_option_of("/var/lib/it's"), " --state '/var/lib/it'\\''s'");
  EXPECT_EQ(state_option_of(""), "");
}

TEST(OutputFile, CallsAFullDiskFull) {
  OutputFile file;
  ASSERT_EQ(file.open("/dev/full", false), "");
  file.write(std::string(100'000, 'x'));
  EXPECT_NE(file.close().find("/dev/full could not be written to the end: the disk is full"), std::string::npos);
  OutputFile small;
  ASSERT_EQ(small.open("/dev/full", false), "");
  small.write("x");
  EXPECT_NE(small.close().find("the disk is full"), std::string::npos) << "found when the buffer is written";
}

TEST(OutputFile, CallsAMissingPermissionAPermission) {
  EXPECT_NE(why_not_written(EACCES).find("no permission"), std::string::npos);
  if (geteuid() == 0) return;  // root may write everywhere
  EXPECT_NE(OutputFile::problem("/etc/passwd").find("no permission"), std::string::npos);
}

}  // namespace
}  // namespace tandem::io
