#include "common/transport/key_schedule.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/alloc_guard.h"

namespace tandem::transport {
namespace {

std::string hex(std::span<const std::byte> bytes) {
  std::string out;
  for (const std::byte b : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    out += kDigits[std::to_integer<unsigned>(b) >> 4];
    out += kDigits[std::to_integer<unsigned>(b) & 15];
  }
  return out;
}

Secret counting() {
  Secret s;
  for (std::size_t i = 0; i < s.bytes.size(); ++i) s.bytes[i] = static_cast<std::byte>(i);
  return s;
}

// Expected values: computed with Python's hmac and hashlib from the definition in FORMAT.md.
TEST(KeySchedule, MatchesTheDefinition) {
  const Key key = key_of(counting(), Cipher::kChaCha20Poly1305);
  EXPECT_EQ(hex(key.key.bytes), "967a198e53607f0d50a585ce0c6c2fd12cb2ea7e6ae8a7bd26d41bf7e0339275");
  EXPECT_EQ(hex(key.iv.bytes), "72f4a8ea847dfeb300b54c1e");
  const Secret next = next_secret(counting());
  EXPECT_EQ(hex(next.bytes), "2db819bca05d0b8e8415cd8948b1abfdcaaf5dff3ba68f3e8a25576d4344456a");
  EXPECT_EQ(hex(key_of(next, Cipher::kChaCha20Poly1305).key.bytes),
            "ce7b982fe020b6bca47e159a8b48674c742ee05d32fc6270e65e8c36fe3ff8ac");
}

TEST(KeySchedule, DerivesSeparateKeysForEachDirection) {
  std::array<std::byte, kExportedSize> exported;
  for (std::size_t i = 0; i < exported.size(); ++i) exported[i] = static_cast<std::byte>(i);
  const ConnectionSecrets s = secrets_from_exporter(exported, Cipher::kAes256Gcm);
  EXPECT_EQ(s.cipher, Cipher::kAes256Gcm);
  EXPECT_EQ(s.to_server.bytes, counting().bytes);
  EXPECT_EQ(s.to_client.bytes[0], std::byte{32});
  EXPECT_EQ(s.to_client.bytes[31], std::byte{63});
}

TEST(KeySchedule, WorksWithoutHeap) {
  Secret s = counting();
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) {
    s = next_secret(s);
    const Key k = key_of(s, Cipher::kAes256Gcm);
    ASSERT_FALSE(k.key.bytes == s.bytes);
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::transport
