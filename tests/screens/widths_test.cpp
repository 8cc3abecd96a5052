// Output of the programs on terminals of 80 to 200 columns: no line reaches the right margin, so no word is cut.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <sstream>

#include "tests/io/programs.h"
#include "tests/support/terminal.h"

namespace tandem::test {
namespace {

const std::vector<std::size_t> kWidths{80, 100, 120, 200};

/// Runs the program at every width. @param said  text that the screen must contain
void expect_whole(const Words& command, const std::string& said, int code = 0) {
  for (const std::size_t columns : kWidths) {
    SCOPED_TRACE(testing::PrintToString(command) + " at " + std::to_string(columns));
    TerminalProcess process(command, columns, 400);
    EXPECT_EQ(process.wait(), code) << process.picture();
    EXPECT_NE(flat(process.terminal().all()).find(said), std::string::npos) << process.picture();
    for (const std::string& row : process.terminal().wraps()) ADD_FAILURE() << "cut by the margin: " << row;
  }
}

TEST(Widths, FitATableOfResults) {
  expect_whole({TANDEM_NETSIM, "run", "one_axis", "--duration", "2"}, "whole session trainer");
  TerminalProcess run({TANDEM_NETSIM, "run", "contact", "--duration", "5"}, 80, 400);
  EXPECT_EQ(run.wait(), 0);
  const auto rows = run.terminal().all();
  EXPECT_TRUE(std::ranges::any_of(rows,
                                  [](const std::string& row) {
                                    return flat({row}).find("phase seat tracking lag free lag force err peak speed") !=
                                           std::string::npos;
                                  }))
      << "a row is one row" << run.picture();
  expect_whole({TANDEM_NETSIM, "run", "contact", "--duration", "5", "--delay", "20", "--loss", "20", "--verbose"},
               "all phases trainer");
  expect_whole({TANDEM_NETSIM, "sweep", "one_axis", "--delay", "0,10,20,40", "--loss", "0,10", "--duration", "2"},
               "delay");
  expect_whole({TANDEM_NETSIM, "test", "contact-delay", "--seeds", "1"}, "contact-delay");
}

TEST(Widths, FitTheDemo) {
  const Folder folder;
  expect_whole({TANDEM_DEMO, "--quick", "--runs", "contact,contact_bad", "--out", folder.file("out")}, "Bad network:");
}

TEST(Widths, FitLists) {
  expect_whole({TANDEM_NETSIM, "profiles"}, "wifi-busy");
  expect_whole({TANDEM_NETSIM, "profiles", "wifi-busy"}, "wifi-busy");
  expect_whole({TANDEM_NETSIM, "test", "--list"}, "free-motion-lan");
  expect_whole({TANDEM_SERVER, "scenes"}, "free_motion");
}

TEST(Widths, FitTheFindingsOfDoctor) {
  for (const std::size_t columns : kWidths) {
    TerminalProcess doctor({TANDEM_CLIENT, "doctor"}, columns, 400);
    static_cast<void>(doctor.wait());  // 1 on a computer without devices
    EXPECT_NE(flat(doctor.terminal().all()).find("looked with"), std::string::npos) << doctor.picture();
    for (const std::string& row : doctor.terminal().wraps()) ADD_FAILURE() << columns << ", cut by the margin: " << row;
  }
}

TEST(Widths, FitALinkTest) {
  Process host = hosting("free_motion", {"--duration", "600"});
  for (const std::size_t columns : {60u, 80u, 120u}) {
    TerminalProcess test({TANDEM_CLIENT, "link-test", "--server", address_of(host), "--duration", "1"}, columns, 400);
    static_cast<void>(test.wait());  // the verdict can be bad on a busy machine
    EXPECT_NE(flat(test.terminal().all()).find("ticks late by more than 1 ms"), std::string::npos) << test.picture();
    for (const std::string& row : test.terminal().wraps()) ADD_FAILURE() << columns << ", cut by the margin: " << row;
  }
}

TEST(Widths, FitTheSummaryOfAProxy) {
  for (const std::size_t columns : kWidths) {
    TerminalProcess proxy({TANDEM_NETSIM, "proxy", "--to", "127.0.0.1:9", "--listen", "127.0.0.1:0", "--delay", "20",
                           "--loss", "5", "--jitter", "5"},
                          columns, 24);
    ASSERT_TRUE(proxy.wait_for("(a command; `help`)")) << proxy.picture();
    proxy.signal(SIGINT);
    EXPECT_EQ(proxy.wait(), 0) << proxy.picture();
    for (const std::string& row : proxy.terminal().wraps()) ADD_FAILURE() << columns << ", cut by the margin: " << row;
  }
}

TEST(Widths, FitMistakes) {
  expect_whole({TANDEM_NETSIM, "run", "nosuch", "--profile", "nosuch", "--hand", "nosuch=x.csv", "--script",
                "nosuch.textproto", "--json", "/nosuch/folder/report.json"},
               "nothing was started", 2);
  expect_whole({TANDEM_SERVER, "run", "nosuch", "--listen", "nowhere", "--json", "/nosuch/folder/report.json",
                "--duration", "5ms"},
               "nothing was started", 2);
  expect_whole({TANDEM_CLIENT, "join", "--server", "127.0.0.1:1", "--seat", "a", "--device", "nosuch:thing",
                "--reconnect-timeout", "5ms", "--json", "/nosuch/folder/report.json"},
               "nothing was started", 2);
  expect_whole(
      {TANDEM_CLIENT, "doctor", "--confirm-motors", "--force-test", "--watch", "--root", "/nosuch", "--seconds", "5ms"},
      "mistakes, nothing was started", 2);
  expect_whole({TANDEM_CLIENT, "try", "nosuch", "--duration", "5ms"}, "nothing was started", 2);
  expect_whole({TANDEM_NETSIM, "profils"}, "no command is called", 2);
}

/// The help of `tandem-netsim control` at 80 columns: each command on its own line with its description, under group
/// headings.
TEST(Widths, KeepOneLinePerCommandInProxyControlHelp) {
  TerminalProcess help({TANDEM_NETSIM, "control", "--help"}, 80, 400);
  EXPECT_EQ(help.wait(), 0) << help.picture();
  for (const std::string& row : help.terminal().wraps()) ADD_FAILURE() << "cut by the margin: " << row;
  const std::vector<std::string> rows = help.terminal().all();
  for (const std::string& row : rows) EXPECT_LT(row.size(), 80u) << row;
  const auto row_of = [&](const std::string& start) {
    return std::ranges::find_if(rows, [&](const std::string& row) { return row.starts_with(start); });
  };
  // Each heading must exist before its position is compared, because a missing row is end().
  std::size_t before = 0;
  for (const char* heading : {"Usage:", "Positionals:", "Help:", "Commands, also", "Lengths:", "Examples", "Exit:"}) {
    const auto row = row_of(heading);
    ASSERT_NE(row, rows.end()) << heading << help.picture();
    const auto at = static_cast<std::size_t>(row - rows.begin());
    EXPECT_GE(at, before) << heading << " is out of order";
    before = at;
  }
  for (const char* command :
       {"profile NAME|FILE", "delay MS", "jitter MS", "loss PERCENT", "duplicate PERCENT", "reorder PERCENT",
        "outage LENGTH", "outage LENGTH hold", "outage LENGTH last", "reset", "rebind [LENGTH]", "... client N [N...]",
        "... up, ... down", "status [--json]", "stop"}) {
    // A gap and a description follow the command.
    const auto row = row_of("  " + std::string(command) + "  ");
    ASSERT_NE(row, rows.end()) << command << help.picture();
    const auto words = row->find_first_not_of(' ', 2 + std::string(command).size());
    EXPECT_EQ(words, 23u) << *row << ": all words begin in one column";
  }
}

/// As in `COLUMNS=60 tandem-netsim profiles | less`.
TEST(Widths, FollowColumnsForAPipe) {
  const auto lines_of = [](const std::string& columns, const Words& command) {
    Words words{"/usr/bin/env", columns};
    words.insert(words.end(), command.begin(), command.end());
    Process process(words);
    EXPECT_EQ(process.wait(), 0) << process.err();
    std::vector<std::string> lines;
    std::istringstream text(process.out());
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  };
  const auto widest = [](const std::vector<std::string>& lines) {
    std::size_t most = 0;
    for (const std::string& line : lines) most = std::max(most, line.size());
    return most;
  };
  for (const Words& command :
       {Words{TANDEM_NETSIM, "profiles"}, Words{TANDEM_CLIENT, "try", "--help"}, Words{TANDEM_SERVER, "scenes"}}) {
    EXPECT_LT(widest(lines_of("COLUMNS=60", command)), 60u) << command[1];
    EXPECT_GT(widest(lines_of("COLUMNS=110", command)), 80u) << command[1];
    EXPECT_EQ(lines_of("COLUMNS=x", command), lines_of("COLUMNS=", command)) << "no width";
  }
}

}  // namespace
}  // namespace tandem::test
