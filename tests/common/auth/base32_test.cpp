#include "common/auth/base32.h"

#include <gtest/gtest.h>

#include "common/auth/key_fingerprint.h"
#include "common/transport/digest.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

std::vector<std::byte> bytes(std::initializer_list<unsigned> values) {
  std::vector<std::byte> out;
  for (const unsigned v : values) out.push_back(static_cast<std::byte>(v));
  return out;
}

TEST(Base32, MatchesCrockfordsAlphabet) {
  EXPECT_EQ(to_base32({}), "");
  EXPECT_EQ(to_base32(bytes({0x00})), "00");                 // 00000 000|00
  EXPECT_EQ(to_base32(bytes({0xff})), "ZW");                 // 11111 111|00
  EXPECT_EQ(to_base32(bytes({0x66, 0x6f})), "CSQG");         // 01100 11001 10111 1|0000
  EXPECT_EQ(to_base32(bytes({1, 2, 3, 4, 5})), "04106105");  // 0x0102030405 in base-32 digits
}

TEST(Base32, ReadsItsOwnOutputOfAnyLength) {
  RandomStream random(3);
  for (std::size_t size = 0; size < 200; ++size) {
    const auto in = test::random_bytes(random, size);
    const std::string text = to_base32(in);
    EXPECT_EQ(text.size(), base32_length(size));
    EXPECT_EQ(from_base32(text), in);
  }
}

TEST(Base32, AcceptsEitherCaseDashesAndThreeDigitLookalikes) {
  const auto in = bytes({0x08, 0x42});  // 00001 00001 00001 0|0000
  ASSERT_EQ(to_base32(in), "1110");
  for (const char* text : {"1110", "il1o", "IL1O", "1-1-1-0", "-1110-", "LlIO"})
    EXPECT_EQ(from_base32(text), in) << text;
  EXPECT_EQ(grouped("ABCDEFG", 3), "ABC-DEF-G");
  EXPECT_EQ(grouped("ABC", 3), "ABC");
}

TEST(Base32, RejectsOtherCharactersLengthsAndPaddingBits) {
  std::size_t good = 0;
  for (int c = 0; c < 256; ++c) good += from_base32(std::string("0") + static_cast<char>(c)).has_value() ? 1 : 0;
  // The second character of one byte may be 0, 4, 8, C, G, M, R or W (two zero bits), in either case. O stands for 0.
  EXPECT_EQ(good, 3u + 5u * 2u + 2u);
  for (const char* text : {"1", "111", "111111", "ZZ", "0U", "0 0", "00=", "0\n"})
    EXPECT_FALSE(from_base32(text)) << text;
  EXPECT_FALSE(from_base32(std::string_view("0\0", 2)));
}

TEST(Base32, EncodesBytesToExactlyOneText) {
  RandomStream random(5);
  const std::uint64_t count = test::seeds(20000);
  for (std::uint64_t i = 0; i < count; ++i) {
    std::string text;
    const std::size_t length = random.below(30);
    for (std::size_t k = 0; k < length; ++k) text += "0123456789ABCDEFGHJKMNPQRSTVWXYZ"[random.below(32)];
    const auto got = from_base32(text);
    if (got) {
      EXPECT_EQ(to_base32(*got), text);
    }
  }
}

TEST(Hex, ReadsAndWrites) {
  std::array<std::byte, 3> out{};
  EXPECT_TRUE(from_hex("00aBFf", out));
  EXPECT_EQ(to_hex(out), "00abff");
  for (const char* text : {"00abf", "00abff0", "00abfg", "00abf ", ""}) EXPECT_FALSE(from_hex(text, out)) << text;
}

TEST(Sha256, IsFips180OfAbcInOneOrTwoPieces) {
  const auto abc = bytes({'a', 'b', 'c'});
  const char* known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  EXPECT_EQ(to_hex(transport::sha256(abc)), known);
  EXPECT_EQ(to_hex(transport::sha256(std::span(abc).first(1), std::span(abc).subspan(1))), known);
}

TEST(Secret, IsComparedByValueAndWiped) {
  auto a = test::secret_from<16>(1);
  auto b = a;
  EXPECT_EQ(a, b);
  b.bytes[15] ^= std::byte{1};
  EXPECT_FALSE(a == b);
  alignas(Secret<16>) std::array<std::byte, sizeof(Secret<16>)> memory;
  auto* const placed = new (memory.data()) Secret<16>(a);
  const volatile std::byte* const seen = memory.data();  // read after the end of its lifetime, on purpose
  EXPECT_TRUE(seen[0] == std::byte{1});
  placed->~Secret<16>();
  for (std::size_t i = 0; i < 16; ++i) EXPECT_TRUE(seen[i] == std::byte{0});
}

}  // namespace
}  // namespace tandem::auth
