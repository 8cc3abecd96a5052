#include "tests/tidy/prose_rules.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

namespace tandem::tidy {
namespace {

const std::filesystem::path kRoot{TANDEM_SOURCE_DIR};

std::size_t count_in(const std::string& path, const std::string& text) {
  return check_prose(make_source(path, text)).size();
}

TEST(Prose, HasNoBannedPhrase) {
  // Folders that are not rewritten yet, with the exact number of banned uses that remain there.
  std::map<std::string, std::size_t> allowed;
  std::ifstream in(kRoot / "tests/tidy/prose_allowance.txt");
  for (std::string folder; in >> folder;) in >> allowed[folder];
  std::map<std::string, std::vector<Finding>> found;
  for (const SourceFile& file : read_repository(kRoot)) {
    if (is_within(file.path, "tests/tidy")) continue;  // the rule itself contains the banned words
    const auto findings = check_prose(file);
    if (findings.empty()) continue;
    std::string folder;
    for (const auto& [name, n] : allowed) {
      if (is_within(file.path, name) && name.size() > folder.size()) folder = name;
    }
    auto& of = found[folder];
    of.insert(of.end(), findings.begin(), findings.end());
  }
  for (const auto& [folder, findings] : found) {
    if (folder.empty()) {
      ADD_FAILURE() << to_string(findings);
    } else {
      EXPECT_LE(findings.size(), allowed[folder]) << folder << ":\n" << to_string(findings);
    }
  }
  for (const auto& [folder, n] : allowed)
    EXPECT_GE(found[folder].size(), n) << folder
                                       << " has fewer by now: lower its number in tests/tidy/prose_allowance.txt";
}

TEST(Prose, FindsPhrasesInCommentsMessagesAndTestNames) {
  EXPECT_EQ(count_in("a.cpp", "// Nobody is here.\n"), 1u);
  EXPECT_EQ(count_in("a.cpp", "f(\"the hand is let\"\n  \" go\");\n"), 0u) << "a literal that is split is not joined";
  EXPECT_EQ(count_in("a.cpp", "f(\"the hand is let go\");\n"), 1u);
  EXPECT_EQ(count_in("a.cpp", "// by\n// and by\n"), 1u) << "over the end of a line";
  EXPECT_EQ(count_in("a.cpp", "TEST(Seat, TakesNobodyAnew) {}\n"), 2u);
  EXPECT_EQ(count_in("a.md", "The seat is told so.\n"), 1u);
  EXPECT_EQ(count_in("a.proto", "// He waits.\nmessage he {}\n"), 1u);
  EXPECT_EQ(count_in("a.cmake", "set(his 1)  # set anew\n"), 1u);
}

TEST(Prose, LeavesCodeAndLongerWordsAlone) {
  EXPECT_EQ(count_in("a.cpp", "int he = his_name + nobody;\n"), 0u);
  EXPECT_EQ(count_in("a.cpp", "// the header's history, here\n"), 0u);
  EXPECT_EQ(count_in("a.cpp", "// by this, and by that\n"), 0u);
}

TEST(Prose, FindsSentencesWithoutANamedSubject) {
  EXPECT_EQ(count_in("a.cpp", "// Who stops may resume.\n"), 1u);
  EXPECT_EQ(count_in("a.cpp", "// The hand rests. What moves is the tool.\n"), 1u);
  EXPECT_EQ(count_in("a.cpp", "int a;  ///< who moved last\n"), 1u);
  EXPECT_EQ(count_in("a.cpp", "// The seat knows\n// who stopped it.\n"), 0u) << "one sentence over two lines";
  EXPECT_EQ(count_in("a.md", "What is Tandem? A system.\n"), 0u) << "a question";
}

}  // namespace
}  // namespace tandem::tidy
