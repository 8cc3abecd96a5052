#include "common/link/seal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "tests/support/alloc_guard.h"

namespace tandem::link {
namespace {

std::vector<std::byte> from_hex(std::string_view hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::vector<std::byte> out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) out.push_back(static_cast<std::byte>(16 * digit(hex[i]) + digit(hex[i + 1])));
  return out;
}

Key key_of(std::string_view key, std::string_view iv) {
  Key k;
  std::ranges::copy(from_hex(key), k.key.begin());
  std::ranges::copy(from_hex(iv), k.iv.begin());
  return k;
}

/// Made with an implementation that is not ours (python-cryptography): AES-256-GCM, AAD = the 16 bytes of the header.
struct Known {
  std::string_view key, nonce, header, plaintext, sealed;
};
#include "tests/link/seal_known.inc"

std::vector<std::byte> datagram_of(const Known& k) {
  auto d = from_hex(k.header);
  const auto p = from_hex(k.plaintext);
  d.insert(d.end(), p.begin(), p.end());
  d.resize(d.size() + kTagSize);
  return d;
}

TEST(Seal, IsAes256GcmWithTheHeaderAuthenticated) {
  for (const Known& k : kKnown) {
    auto d = datagram_of(k);
    Seal seal(key_of(k.key, k.nonce), Seal::Use::kSealing);
    ASSERT_TRUE(seal.seal(0, d));
    EXPECT_EQ(std::vector(d.begin() + 16, d.end()), from_hex(k.sealed));
    EXPECT_EQ(std::vector(d.begin(), d.begin() + 16), from_hex(k.header));
  }
}

TEST(Seal, MixesTheCounterIntoTheLastEightBytesOfTheNonce) {  // little-endian
  const Known& k = kKnown[0];
  auto iv = from_hex(k.nonce);
  constexpr std::uint64_t kCounter = 0x0102030405060708;
  for (std::size_t i = 0; i < 8; ++i) iv[4 + i] ^= static_cast<std::byte>(8 - i);
  Key key = key_of(k.key, k.nonce);
  std::ranges::copy(iv, key.iv.begin());
  auto d = datagram_of(k);
  Seal seal(key, Seal::Use::kSealing);
  ASSERT_TRUE(seal.seal(kCounter, d));
  EXPECT_EQ(std::vector(d.begin() + 16, d.end()), from_hex(k.sealed));
}

TEST(Seal, OpensOnlyUnderTheSameKeyConnectionAndDirection) {
  std::vector<std::byte> d(100, std::byte{42}), plain(100 - 32);
  Seal sealing(loopback_key(7, Direction::kToServer), Seal::Use::kSealing);
  ASSERT_TRUE(sealing.seal(3, d));
  const auto opens = [&](std::uint32_t cid, Direction dir, std::uint64_t counter) {
    return Seal(loopback_key(cid, dir), Seal::Use::kOpening).open(counter, d, plain);
  };
  EXPECT_TRUE(opens(7, Direction::kToServer, 3));
  EXPECT_EQ(plain, std::vector(68, std::byte{42}));
  EXPECT_FALSE(opens(8, Direction::kToServer, 3));
  EXPECT_FALSE(opens(7 + (1U << 24), Direction::kToServer, 3));
  EXPECT_FALSE(opens(7, Direction::kToClient, 3));
  EXPECT_FALSE(opens(7, Direction::kToServer, 4));
  EXPECT_FALSE(opens(7, Direction::kToServer, 3 + (std::uint64_t{1} << 56)));
}

TEST(Seal, GoesOnAfterAForgery) {
  Seal sealing(loopback_key(1, Direction::kToServer), Seal::Use::kSealing);
  Seal opening(loopback_key(1, Direction::kToServer), Seal::Use::kOpening);
  std::vector<std::byte> d(64), plain(32);
  ASSERT_TRUE(sealing.seal(0, d));
  auto forged = d;
  forged[40] ^= std::byte{1};
  EXPECT_FALSE(opening.open(0, forged, plain));
  EXPECT_TRUE(opening.open(0, d, plain));
}

TEST(Seal, RefusesSizesThatCannotBe) {
  Seal sealing(loopback_key(1, Direction::kToServer), Seal::Use::kSealing);
  Seal opening(loopback_key(1, Direction::kToServer), Seal::Use::kOpening);
  std::vector<std::byte> d(64), plain(32);
  EXPECT_FALSE(sealing.seal(0, std::span(d).first(31)));
  EXPECT_FALSE(opening.open(0, std::span(d).first(31), plain));
  EXPECT_FALSE(opening.open(0, d, std::span(plain).first(31)));
}

TEST(Seal, WorksWithoutHeap) {
  Seal sealing(loopback_key(1, Direction::kToServer), Seal::Use::kSealing);
  Seal opening(loopback_key(1, Direction::kToServer), Seal::Use::kOpening);
  std::vector<std::byte> d(200), plain(168);
  const test::AllocGuard guard;
  for (std::uint64_t c = 0; c < 1000; ++c) {
    ASSERT_TRUE(sealing.seal(c, d));
    ASSERT_TRUE(opening.open(c, d, plain));
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::link
