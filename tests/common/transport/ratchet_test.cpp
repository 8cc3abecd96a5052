#include "common/transport/ratchet.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "tests/common/base/counts.h"
#include "tests/common/transport/secure_channel_pair.h"
#include "tests/support/alloc_guard.h"

namespace tandem::transport {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::byte>;

constexpr Time at(Duration d) { return Time{1h + d}; }

Bytes sealed(SecureChannel& from, Time now) {
  Bytes d(kHeaderSize + 40 + kTagSize, std::byte{7});
  EXPECT_EQ(from.seal(now, wire::Type::kState, d, 40), d.size());
  return d;
}

/// Opens a datagram as the programs do: a newer one is accepted, with the peer's echo. @return whether it opened
bool hears(SecureChannel& to, const SecureChannel& from, const Bytes& d, Time now) {
  const auto opened = to.open(now, d);
  if (!opened) return false;
  if (opened->newer) to.accept(now, *opened, from.preamble(now, 0));
  return true;
}

TEST(Ratchet, StepsAtThePacketLimitOnceThePeerEchoed) {
  const RekeyPolicy rule{.packets = 10};
  SecureChannel a{test::client_end(1, rule)}, b{test::server_end(1, rule)};
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(hears(b, a, sealed(a, at(i * 1ms)), at(i * 1ms)));
    EXPECT_EQ(a.sending_phase(), 0U) << "no echo yet";
  }
  ASSERT_TRUE(hears(a, b, sealed(b, at(100ms)), at(100ms)));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(hears(b, a, sealed(a, at(101ms)), at(101ms)));
  EXPECT_EQ(a.sending_phase(), 1U);
  EXPECT_EQ(b.receiving_phase(), 1U);
}

TEST(Ratchet, StepsAfterFifteenMinutes) {
  SecureChannel a{test::client_end()}, b{test::server_end()};
  const auto exchange = [&](Duration t) {
    ASSERT_TRUE(hears(b, a, sealed(a, at(t)), at(t)));
    ASSERT_TRUE(hears(a, b, sealed(b, at(t)), at(t)));
  };
  exchange(0s);
  exchange(14min + 59s);
  EXPECT_EQ(a.sending_phase(), 0U);
  exchange(15min);
  EXPECT_EQ(a.sending_phase(), 1U);
  EXPECT_EQ(b.sending_phase(), 1U);
}

TEST(Ratchet, SealsNothingBeyondTheHardLimit) {
  SendKeys keys{test::secrets(1).to_server, fastest_cipher(), {.packets = 4, .hard_stop = 8}};
  Bytes d(64);
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(keys.seal(at(0s), wire::Type::kState, 1, d));
  EXPECT_FALSE(keys.seal(at(0s), wire::Type::kState, 1, d));
  EXPECT_EQ(keys.next_counter(), 8U) << "and no counter is used up";
  keys.echoed(3);
  EXPECT_TRUE(keys.seal(at(0s), wire::Type::kState, 1, d)) << "the peer is there after all: the next key";
  EXPECT_EQ(keys.phase(), 1U);
}

TEST(Ratchet, AcceptsThePreviousKeyForASecond) {
  const RekeyPolicy rule{.packets = 1};
  SecureChannel a{test::client_end(1, rule)}, b{test::server_end(1, rule)};
  const Bytes first = sealed(a, at(0s)), late = sealed(a, at(0s)), later = sealed(a, at(0s));
  ASSERT_TRUE(hears(b, a, first, at(0s)));
  ASSERT_TRUE(hears(a, b, sealed(b, at(0s)), at(0s)));
  const Bytes next = sealed(a, at(1ms));
  ASSERT_EQ(a.sending_phase(), 1U);
  ASSERT_TRUE(hears(b, a, next, at(1ms)));
  EXPECT_TRUE(b.open(at(1001ms), late));
  EXPECT_EQ(b.open(at(1002ms), later).error(), DropReason::kTag);
}

TEST(Ratchet, AdvancesOnlyOnAuthenticDatagrams) {
  SecureChannel a{test::client_end()}, b{test::server_end()};
  RandomStream random{3};
  for (int i = 0; i < 5000; ++i) {
    Bytes d(72);
    for (std::byte& x : d) x = static_cast<std::byte>(random.bits());
    write_header({wire::Type::kState, static_cast<std::uint8_t>(random.bits()), 22, random.bits()},
                 std::span(d).first<kHeaderSize>());
    ASSERT_FALSE(b.open(at(0s), d));
  }
  EXPECT_EQ(b.receiving_phase(), 0U);
  EXPECT_TRUE(hears(b, a, sealed(a, at(0s)), at(0s)));
}

// Key changes forced at every packet boundary, under loss, duplication and reordering. Every datagram that is new
// enough to act opens, so a key change loses nothing.
TEST(Ratchet, ChangesKeysAtEveryDatagramOnAnyNetwork) {
  const std::uint64_t last = tandem::test::seeds(20);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const RekeyPolicy rule{.packets = 1 + random.below(3)};
    SecureChannel a{test::client_end(seed, rule)}, b{test::server_end(seed, rule)};
    std::deque<Bytes> up, down;
    std::uint64_t delivered = 0;
    const auto deliver = [&](SecureChannel& to, const SecureChannel& from, std::deque<Bytes>& air, Time now) {
      while (!air.empty() && random.below(3) != 0) {
        const std::size_t i = std::min<std::size_t>(random.below(3), air.size() - 1);  // reordered
        const Bytes d = air[i];
        air.erase(air.begin() + static_cast<std::ptrdiff_t>(i));
        if (random.below(10) == 0) continue;  // lost
        if (!hears(to, from, d, now)) {       // two keys behind: too late to act
          ASSERT_LT(read_header(d)->counter, to.stats().newest);
          continue;
        }
        ++delivered;
        if (random.below(10) == 0) {
          ASSERT_EQ(to.open(now, d).error(), DropReason::kDuplicate);
        }
      }
    };
    for (int i = 0; i < 2000; ++i) {
      const Time now = at(i * 1ms);
      up.push_back(sealed(a, now));
      down.push_back(sealed(b, now));
      deliver(b, a, up, now);
      deliver(a, b, down, now);
      if (up.size() > 5) up.pop_front();  // at most 5 ms behind
      if (down.size() > 5) down.pop_front();
    }
    EXPECT_GT(delivered, 2000U);
    EXPECT_GT(a.sending_phase(), 100U);
    EXPECT_LE(b.sending_phase() - a.receiving_phase(), 1U);
  }
}

TEST(Ratchet, SurvivesAnOutageOfAnyLength) {
  const RekeyPolicy rule{.packets = 2};
  SecureChannel a{test::client_end(1, rule)}, b{test::server_end(1, rule)};
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(hears(b, a, sealed(a, at(i * 1ms)), at(i * 1ms)));
    ASSERT_TRUE(hears(a, b, sealed(b, at(i * 1ms)), at(i * 1ms)));
  }
  for (int i = 0; i < 5000; ++i) {  // nothing arrives
    static_cast<void>(sealed(a, at(1s + i * 1ms)));
    static_cast<void>(sealed(b, at(1s + i * 1ms)));
  }
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(hears(b, a, sealed(a, at(10s + i * 1ms)), at(10s + i * 1ms)));
    ASSERT_TRUE(hears(a, b, sealed(b, at(10s + i * 1ms)), at(10s + i * 1ms)));
  }
}

TEST(Ratchet, ChangesKeysWithoutHeap) {
  const RekeyPolicy rule{.packets = 1};
  SecureChannel a{test::client_end(1, rule)}, b{test::server_end(1, rule)};
  std::array<std::byte, 100> d{};
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 600; ++i) {
    for (const auto& [from, to] : {std::pair{&a, &b}, {&b, &a}}) {
      const std::size_t size = from->seal(at(i * 1ms), wire::Type::kState, d, 40);
      const auto opened = to->open(at(i * 1ms), std::span(d).first(size));
      ASSERT_TRUE(opened) << i;
      to->accept(at(i * 1ms), *opened, from->preamble(at(i * 1ms), 0));
    }
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(a.sending_phase(), 256U) << "the phase's byte went round";
}

}  // namespace
}  // namespace tandem::transport
