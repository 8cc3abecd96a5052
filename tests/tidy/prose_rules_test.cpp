#include "tests/tidy/prose_rules.h"

#include <gtest/gtest.h>

#include <string>

namespace tandem::tidy {
namespace {

const std::filesystem::path kRoot{TANDEM_SOURCE_DIR};

std::size_t count_in(const std::string& path, const std::string& text) {
  return check_prose(make_source(path, text)).size();
}

TEST(Prose, HasNoBannedPhrase) {
  for (const SourceFile& file : read_repository(kRoot)) {
    if (is_within(file.path, "tests/tidy")) continue;  // the rule itself contains the banned words
    const auto findings = check_prose(file);
    EXPECT_TRUE(findings.empty()) << to_string(findings);
  }
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
  EXPECT_EQ(count_in("a.cpp", "json[\"what\"] = f(\"what moves\");\n"), 1u) << "a literal of one word is a key";
}

}  // namespace
}  // namespace tandem::tidy
