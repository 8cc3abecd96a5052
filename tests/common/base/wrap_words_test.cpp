#include "common/base/wrap_words.h"

#include <gtest/gtest.h>

namespace tandem {
namespace {

using Lines = std::vector<std::string>;

TEST(WrapWords, CountsCharactersNotBytes) {
  EXPECT_EQ(display_width("α ≤ 2 ✓"), 7U);
  EXPECT_EQ(wrap_words("αα ββ γγ", 5), (Lines{"αα ββ", "γγ"}));
}

TEST(WrapWords, IndentsAllLinesButTheFirst) {
  EXPECT_EQ(wrap_words("aa bb cc dd", 5, 2), (Lines{"aa bb", "  cc", "  dd"}));
  EXPECT_EQ(wrap_words("aa bb", 7, 4, 4), (Lines{"aa", "    bb"})) << "4 columns are used before the first word";
}

TEST(WrapWords, LeavesAWordWiderThanALineUncut) {
  EXPECT_EQ(wrap_words("a longest b", 4), (Lines{"a", "longest", "b"}));
  EXPECT_EQ(wrap_words("", 4), Lines{""});
}

// Property: no line but that of a single word is too wide, and no word is lost.
TEST(WrapWords, KeepsEveryWordAtAnyWidth) {
  const std::string text = "the server shares the authority among the hands, and every hand feels the tool";
  for (std::size_t width = 0; width < 90; ++width) {
    std::string joined;
    for (const std::string& line : wrap_words(text, width)) {
      EXPECT_TRUE(display_width(line) <= width || line.find(' ') == std::string::npos) << width << ": " << line;
      joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(joined, text) << width;
  }
}

}  // namespace
}  // namespace tandem
