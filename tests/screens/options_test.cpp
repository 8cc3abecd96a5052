// Accepted numbers with units, and error texts for files that cannot be written.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cerrno>
#include <filesystem>

#include "common/base/command_hints.h"
#include "common/base/unit_suffix.h"
#include "common/io/command_line.h"
#include "common/io/output_file.h"
#include "common/io/reachable_address.h"
#include "common/io/remote_address.h"
#include "common/io/udp_socket.h"
#include "common/io/usage_errors.h"

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

TEST(NumberOption, WorksAsAnOptionOfAProgram) {
  Program program("test", "1", "", [] { return 0; });
  double delay = 0;
  program.root().add_option("--delay", delay, "").check(number_in(0, 100, "ms"));
  EXPECT_EQ(program.run({"--delay", "20ms"}), 0);
  EXPECT_EQ(delay, 20);
  testing::internal::CaptureStderr();
  EXPECT_EQ(program.run({"--delay", "20s"}), 2);
  EXPECT_TRUE(testing::internal::GetCapturedStderr().starts_with("test: --delay: \"20s\" has the unit s"));
}

TEST(NumberOption, AcceptsWholeNumbersOnlyInTheirRange) {
  std::string value = "3";
  EXPECT_EQ(whole_number_in(1, 9)(value), "");
  value = "2.5";
  EXPECT_EQ(whole_number_in(1, 9)(value), "\"2.5\" is not a whole number in [1, 9]");
  value = "10";
  EXPECT_EQ(whole_number_in(1, 9)(value), "\"10\" is out of range: must be in [1, 9]");
}

struct Arguments {
  std::string law, file = "none";
  std::vector<std::string> rest;
  Command command;
};

/// Program with one command `go`. `run` returns 10 for a law, 20 for a given --file, plus the count of other words.
int exit_code(const std::vector<std::string>& words) {
  Program program("test", "1", "");
  const auto [command, arguments] = program.root().add_command(
      "go", "", +[](const Arguments& a) {
        return (a.law == "raw"  ? 10
                : a.law.empty() ? 0
                                : 40) +
               (a.command.given("--file") ? 20 : 0) + static_cast<int>(a.rest.size());
      });
  arguments.command = command;
  command.add_option("--law", arguments.law, "").check(one_of({"raw", "replica"}));
  std::uint64_t seeds = 0;
  command.add_option("--seeds", seeds, "").check(whole_number_in(1, 9));
  command.add_option("--file", arguments.file, "");
  command.take_rest(arguments.rest);
  return program.run(words);
}

TEST(Program, PassesArgumentsToTheChosenCommand) {
  EXPECT_EQ(exit_code({"go"}), 0);
  EXPECT_EQ(exit_code({"go", "--law", "RAW"}), 10) << "the text becomes the name";
  EXPECT_EQ(exit_code({"go", "--file", "none"}), 20) << "given, though it equals the default";
  EXPECT_EQ(exit_code({"go", "--seeds", "9"}), 0);
  EXPECT_EQ(exit_code({"go", "word", "--unknown", "x"}), 3);
}

TEST(Program, ReportsUsageErrorsWithExitCode2) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(exit_code({}), 2) << "it requires a command";
  EXPECT_EQ(exit_code({"og"}), 2);
  EXPECT_EQ(exit_code({"go", "--law", "x", "--seeds", "10"}), 2);
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("no command is called \"og\"; did you mean go?"), std::string::npos) << text;
  EXPECT_NE(text.find("--law: \"x\" is unknown; known here: "), std::string::npos) << text;
  EXPECT_NE(text.find("--seeds: \"10\" is out of range: must be in [1, 9]"), std::string::npos) << text;
  EXPECT_NE(text.find("2 mistakes; nothing was started"), std::string::npos) << text;
}

TEST(Program, SuggestsTheNearestValueOfAnOption) {
  for (const char* word : {"repl", "rapelica", "REPLICAS"}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(exit_code({"go", "--law", word}), 2) << word;
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_NE(text.find("--law: \"" + std::string(word) + "\" is unknown; did you mean replica? known here: "),
              std::string::npos)
        << text;
  }
}

TEST(UsageErrors, CollectsLinesAndIgnoresMissingProblems) {
  UsageErrors errors;
  errors.add("");
  errors.add("--json", "");
  errors.output_file("--json", "-");
  EXPECT_TRUE(errors.empty());
  errors.add("as a scene:\nfirst\nsecond\n");
  errors.add("--trace", "is the same file as --json");
  EXPECT_EQ(errors.count(), 3U) << "a line that ends in a colon belongs to the next";
  testing::internal::CaptureStderr();
  EXPECT_EQ(errors.report("tandem-x y", "nothing was sent"), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "as a scene:\nfirst\nsecond\n--trace: is the same file as --json\ntandem-x y: 3 mistakes, nothing was "
            "sent\n");
  testing::internal::CaptureStderr();
  EXPECT_EQ(report_usage_error("tandem-x", "bad"), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "tandem-x: bad\n1 mistake; nothing was started\n");
}

TEST(UsageErrors, ReadsNumbers) {
  UsageErrors errors;
  EXPECT_EQ(errors.number("--timeout", "1.5 s", 0, 2, "s"), 1.5);
  EXPECT_EQ(errors.optional_number("--timeout", "", 0, 2, "s"), 0);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(errors.number("--timeout", "", 0, 2, "s"), 0);
  EXPECT_EQ(errors.optional_number("--timeout", "3", 0, 2, "s"), 0);
  EXPECT_EQ(errors.count(), 2U);
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

/// Such as a server that starts before its network.
TEST(PrintedCommand, SaysWhenItsAddressWorksOnThisComputerOnly) {
  const auto note = [](const char* at, const char* reachable) {
    return only_here_note(*parse_address(at, 0), reachable);
  };
  for (const auto& [all, here] : {std::pair{"0.0.0.0:7000", "127.0.0.1:7000"}, std::pair{"[::]:7000", "[::1]:7000"}})
    EXPECT_EQ(note(all, here), std::string("this computer has no address in a network yet: commands with ") + here +
                                   " work here only; on other computers put its name or address in front of :7000");
  EXPECT_EQ(note("0.0.0.0:7000", "192.0.2.7:7000"), "");
  EXPECT_EQ(note("127.0.0.1:7000", "127.0.0.1:7000"), "") << "no other computer reaches it";
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
