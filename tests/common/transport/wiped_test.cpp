// "Keys in memory: zeroise on close" (tests/FAILURES.md): searches the memory of a destroyed connection for its keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <new>
#include <vector>

#include "tests/common/transport/secure_channel_pair.h"

namespace tandem::transport {
namespace {

using namespace std::chrono_literals;

/// Returns whether `memory` contains any 8 bytes of `needle`: a compiler may have kept parts.
bool holds(std::span<const std::byte> memory, std::span<const std::byte> needle) {
  for (std::size_t part = 0; part + 8 <= needle.size(); part += 8) {
    const auto piece = needle.subspan(part, 8);
    if (std::ranges::search(memory, piece).begin() != memory.end()) return true;
  }
  return false;
}

TEST(WipedMemory, HoldsNoKeyOfADestroyedChannel) {
  for (const Cipher cipher : {fastest_cipher(), Cipher::kChaCha20Poly1305}) {
    alignas(SecureChannel) static std::array<std::byte, sizeof(SecureChannel)> memory;
    SecureChannel::Params params = test::client_end(5);
    params.secrets = test::secrets(5, cipher);
    std::vector<std::array<std::byte, 32>> secrets, keys;
    for (Secret s : {params.secrets.to_server, params.secrets.to_client})
      for (int phase = 0; phase < 3; ++phase, s = next_secret(s)) {
        secrets.push_back(s.bytes);
        keys.push_back(key_of(s, cipher).key.bytes);
      }
    SecureChannel* const link = new (memory.data()) SecureChannel(params);
    std::array<std::byte, 200> datagram{};
    ASSERT_GT(link->seal(Time{1h}, wire::Type::kState, datagram, 100), 0U);
    std::size_t found = 0;
    for (const auto& key : keys) found += holds(memory, key) ? 1 : 0;
    ASSERT_GE(found, 2U) << "the keys in use must be there, or the search finds nothing at all";
    link->~SecureChannel();
    const std::span<const std::byte> left{std::launder(memory.data()), memory.size()};
    for (const auto& key : keys) EXPECT_FALSE(holds(left, key));
    for (const auto& secret : secrets) EXPECT_FALSE(holds(left, secret));
  }
}

}  // namespace
}  // namespace tandem::transport
