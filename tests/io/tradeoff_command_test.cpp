// `tandem-netsim tradeoff` as users start it: tables, files, the same bytes twice, counted instructions, and everything
// that is rejected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/io/programs.h"

namespace tandem {
namespace {

using test::Folder;
using test::Process;

Process tradeoff(test::Words arguments) {
  arguments.insert(arguments.begin(), {TANDEM_NETSIM, "tradeoff"});
  return Process(std::move(arguments));
}
/// Waits for the end, also longer than one limit of Process.
int code_of(Process& process) {
  std::optional<int> code;
  for (int attempt = 0; attempt < 10 && !(code = process.wait()); ++attempt) {
  }
  return code.value_or(-1000);
}
const test::Words kSmall{"--tick-hz", "500,1000", "--substeps", "1", "--no-times"};
test::Words with(test::Words words, const test::Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(TradeoffCommand, WritesTheSameTableAndPageTwice) {
  const Folder folder;
  for (const std::string name : {"a", "b"}) {
    Process process =
        tradeoff(with(with({"one_axis"}, kSmall), {"--no-instructions", "--quiet", "--csv", folder.file(name + ".csv"),
                                                   "--html", folder.file(name + ".html")}));
    EXPECT_EQ(code_of(process), 0) << process.err();
  }
  const std::string csv = folder.read("a.csv"), page = folder.read("a.html");
  EXPECT_EQ(csv, folder.read("b.csv"));
  EXPECT_EQ(page, folder.read("b.html"));
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 10 + 2 + 2 * 7) << "header, tool, tiers, device with friction";
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
}

TEST(TradeoffCommand, CountsInstructionsOfEveryRow) {
  if (std::system("valgrind --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "valgrind is not installed";
  if (!std::string(TANDEM_SANITIZED).empty()) GTEST_SKIP() << "callgrind does not run under sanitizers";
  Process process = tradeoff(with({"one_axis"}, with(kSmall, {"--csv", "-", "--quiet"})));
  const int code = code_of(process);
  ASSERT_EQ(code, 0) << process.err();
  std::istringstream csv(process.out());
  std::string line;
  std::getline(csv, line);
  int rows = 0;
  for (; std::getline(csv, line); ++rows) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; column < 7; ++column) std::getline(cells, cell, ',');
    EXPECT_GT(std::atof(cell.c_str()), 50) << line;
    EXPECT_LT(std::atof(cell.c_str()), 200'000) << line;
  }
  EXPECT_EQ(rows, 2 * 10 + 2 + 2 * 7);
}

TEST(TradeoffCommand, MeasuresADeviceThatMovesTheTool) {
  Process process = tradeoff(with({"seed_contact", "--no-instructions", "--tick-hz", "1000"}, {"--substeps", "1"}));
  EXPECT_EQ(code_of(process), 0) << process.err();
  EXPECT_NE(process.out().find("Device: arm with friction and gravity, contact: plane"), std::string::npos)
      << process.out();
  EXPECT_EQ(process.out().find("a lesson on one desk"), std::string::npos) << "no simulated tool, no advice for it";
}

TEST(TradeoffCommand, NamesEveryMistakeAtOnce) {
  Process process = tradeoff({"one_axis", "--tick-hz", "5", "--substeps", "1.5", "--csv", "same", "--html", "same"});
  EXPECT_EQ(code_of(process), 2);
  for (const std::string part : {"--tick-hz", "--substeps: 1.5", "--html: is the same file as --csv"})
    EXPECT_NE(process.err().find(part), std::string::npos) << part << "\n" << process.err();
}

TEST(TradeoffCommand, HidesItsInternalOption) {
  Process process = tradeoff({"--help"});
  EXPECT_EQ(code_of(process), 0);
  EXPECT_NE(process.out().find("--html"), std::string::npos);
  EXPECT_EQ(process.out().find("--under-callgrind"), std::string::npos);
}

}  // namespace
}  // namespace tandem
