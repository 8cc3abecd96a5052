// The keyed hash that hides network addresses.
#include "common/transport/keyed_hash.h"

#include <gtest/gtest.h>

#include <vector>

namespace tandem::transport {
namespace {

// Test vectors of the authors: key 00 01 ... 0f, messages empty and 00 01 ... 0e [Aumasson, Bernstein 2012, appendix A].
TEST(KeyedHash, IsSipHash24) {
  HashKey key;
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::byte>(i);
  std::vector<std::byte> message;
  EXPECT_EQ(keyed_hash(key, message), 0x726fdb47dd0e0e31ULL);
  for (std::size_t i = 0; i < 15; ++i) message.push_back(static_cast<std::byte>(i));
  EXPECT_EQ(keyed_hash(key, message), 0xa129ca6149be45e5ULL);
}

TEST(KeyedHash, DependsOnTheKey) {
  HashKey one{}, other{};
  other[15] = std::byte{1};
  const std::vector<std::byte> address(16, std::byte{1});
  EXPECT_NE(keyed_hash(one, address), keyed_hash(other, address));
}

}  // namespace
}  // namespace tandem::transport
