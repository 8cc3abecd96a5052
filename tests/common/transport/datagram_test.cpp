#include "common/transport/datagram.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace tandem::transport {
namespace {

std::vector<std::byte> with_header(const Header& h, std::size_t size = 64) {
  std::vector<std::byte> bytes(size);
  write_header(h, std::span(bytes).first<kHeaderSize>());
  return bytes;
}

TEST(Header, HasTheDocumentedByteLayout) {
  const auto bytes = with_header({wire::Type::kState, 3, 0x04030201, 0x0c0b0a0908070605});
  EXPECT_EQ(bytes[0], std::byte{0x23});
  EXPECT_EQ(bytes[1], std::byte{3});
  EXPECT_EQ(bytes[2], std::byte{0});
  EXPECT_EQ(bytes[3], std::byte{0});
  for (std::size_t i = 4; i < 16; ++i) EXPECT_EQ(bytes[i], static_cast<std::byte>(i - 3));
  const auto read = read_header(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->type, wire::Type::kState);
  EXPECT_EQ(read->key_phase, 3);
  EXPECT_EQ(read->cid, 0x04030201U);
  EXPECT_EQ(read->counter, 0x0c0b0a0908070605U);
}

TEST(Header, RejectsUnknownVersionsAndTypes) {
  for (unsigned first = 0; first < 256; ++first) {
    auto bytes = with_header({});
    bytes[0] = static_cast<std::byte>(first);
    const bool good = (first >> 4) == 2 && (first & 15) >= 3 && (first & 15) <= 13;
    EXPECT_EQ(read_header(bytes).has_value(), good) << first;
  }
}

TEST(Header, RejectsNonZeroReservedBits) {
  for (const std::size_t at : {2, 3}) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      auto bytes = with_header({});
      bytes[at] = static_cast<std::byte>(1U << bit);
      EXPECT_FALSE(read_header(bytes));
    }
  }
}

TEST(Header, RejectsTooShortAndTooLongDatagrams) {
  for (std::size_t size = 16; size < 1300; ++size) {
    EXPECT_EQ(read_header(with_header({}, size)).has_value(), size >= 32 && size <= 1200) << size;
  }
  EXPECT_FALSE(read_header({}));
}

}  // namespace
}  // namespace tandem::transport
