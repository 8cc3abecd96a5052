// "Keys in memory: zeroise on close, checked by a grep of a forced dump" (tests/FAILURES.md). After a session is
// destroyed, the test searches all writable memory of this process for the keys of its connections. A core dump would
// contain the same memory.
#include <gtest/gtest.h>
#include <sodium.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <vector>

#include "common/transport/ratchet.h"
#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

/// Parts of keys, stored so that the search does not find its own copy.
class Wanted {
 public:
  void add(std::span<const std::byte> key) {
    for (std::size_t at = 0; at + 8 <= key.size(); at += 8) {
      std::uint64_t piece = 0;
      for (std::size_t i = 0; i < 8; ++i) piece |= (std::to_integer<std::uint64_t>(key[at + i]) ^ kMask) << (8 * i);
      pieces_.push_back(piece);
      first_[piece & 0xff] = true;
    }
  }
  /// Number of occurrences of the parts in this process.
  [[nodiscard]] std::size_t found() const {
    std::size_t count = 0;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
      std::uint64_t from = 0, to = 0;
      char rights[5] = {};
      if (std::sscanf(line.c_str(), "%" SCNx64 "-%" SCNx64 " %4s", &from, &to, rights) != 3 || rights[0] != 'r' ||
          rights[1] != 'w')
        continue;
      const auto* const begin =
          reinterpret_cast<const volatile unsigned char*>(from);  // the kernel reports it as mapped and readable
      for (std::size_t at = 0; at + 8 <= to - from; ++at) {
        if (!first_[begin[at] ^ kMask]) continue;
        std::uint64_t here = 0;
        for (std::size_t i = 0; i < 8; ++i) here |= (begin[at + i] ^ kMask) << (8 * i);
        count += std::ranges::find(pieces_, here) != pieces_.end() ? 1 : 0;
      }
    }
    return count;
  }

 private:
  static constexpr std::uint64_t kMask = 0xa5;
  std::vector<std::uint64_t> pieces_;
  std::array<bool, 256> first_{};
};

[[maybe_unused, gnu::noinline]] void collect(const SessionFixture& rig, Wanted& wanted) {
  for (const FixtureSeat& s : rig.seats)
    for (transport::Secret secret : {s.params.secrets.to_server, s.params.secrets.to_client})
      for (int phase = 0; phase < 6; ++phase, secret = transport::next_secret(secret)) {
        wanted.add(secret.bytes);
        wanted.add(transport::key_of(secret, s.params.secrets.cipher).key.bytes);
      }
}

TEST(WipedMemory, HoldsNoKeyOfAnEndedSession) {
#ifdef TANDEM_SANITIZED
  GTEST_SKIP() << "a sanitizer keeps freed memory";
#else
  Wanted wanted;
  {
    SessionFixture rig("free_motion", 3, {.packets = 400});
    collect(rig, wanted);
    sodium_stackzero(16384);  // clears what the collection itself left on the stack; later copies are the product's
    rig.run(1500ms);
    ASSERT_GE(rig.seats[0].core->link().sending_phase(), 3) << "keys must have changed";
    ASSERT_GE(wanted.found(), 16U) << "keys that are in use must be found, or the search finds nothing at all";
  }
  EXPECT_EQ(wanted.found(), 0U);
#endif
}

}  // namespace
}  // namespace tandem::server
