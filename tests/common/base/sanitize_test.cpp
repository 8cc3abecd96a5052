// Text from a remote peer on a terminal: any bytes.
#include "common/base/sanitize.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"

namespace tandem {
namespace {

TEST(Sanitize, KeepsPlainText) {
  for (const char* text : {"", "fire drill", "~!@#$%^&*()", "\xc3\xa4\xc3\xb6 \xe2\x82\xac \xf0\x9f\x99\x82"})
    EXPECT_EQ(sanitize(text), text);
}

TEST(Sanitize, EscapesControlAndInvisibleCharacters) {
  EXPECT_EQ(sanitize("\x1b[31m"), "\\x1b[31m");
  EXPECT_EQ(sanitize("a\r\nb\tc"), "a\\x0d\\x0ab\\x09c");
  EXPECT_EQ(sanitize("\x7f"), "\\x7f");
  EXPECT_EQ(sanitize("\xc2\x9b"), "\\u009b") << "a control character of two bytes";
  EXPECT_EQ(sanitize("x\xe2\x80\xaey"), "x\\u202ey") << "would turn the line around";
  EXPECT_EQ(sanitize("\xff\xc3(\xed\xa0\x80"), "\\xff\\xc3(\\xed\\xa0\\x80") << "no UTF-8";
  EXPECT_EQ(sanitize("\xc0\xaf"), "\\xc0\\xaf") << "not the shortest form";
}

TEST(Sanitize, CutsBetweenCharacters) {
  EXPECT_EQ(truncate_utf8("\xc3\xa4\xc3\xa4", 3), "\xc3\xa4");
  EXPECT_EQ(truncate_utf8("abc", 3), "abc");
  EXPECT_EQ(truncate_utf8("\x80\x80\x80", 1), "");
  EXPECT_EQ(sanitize("\xc3\xa4\xc3\xa4", 3), "\xc3\xa4...");
}

TEST(Sanitize, RemovesTerminalControlFromAnyBytes) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random{seed};
    std::string text;
    for (std::uint64_t left = random.below(64); left > 0; --left) text += static_cast<char>(random.bits() & 0xff);
    for (const char c : sanitize(text)) {
      const auto byte = static_cast<unsigned char>(c);
      ASSERT_TRUE(byte >= 0x20 && byte != 0x7f) << "seed " << seed;
    }
    EXPECT_EQ(sanitize(sanitize(text)), sanitize(text)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tandem
