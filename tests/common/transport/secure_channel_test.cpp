#include "common/transport/secure_channel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/common/transport/secure_channel_pair.h"
#include "tests/support/alloc_guard.h"

namespace tandem::transport {
namespace {

using namespace std::chrono_literals;

using Bytes = std::vector<std::byte>;

constexpr Time at(Duration d) { return Time{1h + d}; }

using test::Pair;

Bytes sealed(SecureChannel& from, Time now = at(0s), std::size_t plain = 40, std::byte fill = std::byte{7}) {
  Bytes d(kHeaderSize + plain + kTagSize, fill);
  EXPECT_EQ(from.seal(now, wire::Type::kState, d, plain), d.size());
  return d;
}

std::uint64_t refused(const SecureChannel& l, DropReason why) {
  return l.stats().dropped[static_cast<std::size_t>(why)];
}

/// Opens the datagram and accepts it if it is newer. @return whether it was accepted
bool acts(SecureChannel& to, const Bytes& d, Time now = at(0s)) {
  const auto opened = to.open(now, d);
  if (!opened || !opened->newer) return false;
  to.accept(now, *opened, {});
  return true;
}

TEST(SecureChannel, CarriesBytesFromOneEndToTheOther) {
  Pair p;
  for (std::size_t size = 1; size <= kDatagramMax - 32; size += 37) {
    const Bytes d = sealed(p.client, at(0s), size, static_cast<std::byte>(size));
    const auto opened = p.server.open(at(0s), d);
    ASSERT_TRUE(opened) << size;
    EXPECT_EQ(opened->type, wire::Type::kState);
    EXPECT_EQ(opened->counter, size / 37);
    EXPECT_TRUE(opened->newer);
    ASSERT_EQ(opened->plaintext.size(), size);
    EXPECT_TRUE(std::ranges::all_of(opened->plaintext, [&](std::byte b) { return b == static_cast<std::byte>(size); }));
    EXPECT_FALSE(std::ranges::equal(std::span(d).subspan(16, size), opened->plaintext) && size > 2) << "sent in clear";
  }
}

/// A session of 16 seats with kept inputs takes at most 4 MB (tests/bench/growth_curves.cpp), 0.6 MB of it links.
TEST(SecureChannel, TakesAtMost40KilobytesAt1kHz) {
  static_assert(sizeof(SecureChannel) + 4096 * sizeof(BriefTime) <= 40'000);
  EXPECT_GE(LinkTiming::kMemory / 1ms, 4000) << "the times that it keeps";
}

TEST(SecureChannel, RefusesEveryFlippedBit) {
  Pair p;
  for (int n = 0; n < 3; ++n) {
    const Bytes d = sealed(p.client, at(0s), 20 + 30 * static_cast<std::size_t>(n));
    for (std::size_t bit = 0; bit < 8 * d.size(); ++bit) {
      Bytes bad = d;
      bad[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
      ASSERT_FALSE(p.server.open(at(0s), bad)) << "bit " << bit;
    }
    ASSERT_TRUE(acts(p.server, d));  // no rejected copy prevents the original
  }
  EXPECT_EQ(p.server.stats().accepted, 3U);
}

TEST(SecureChannel, RejectsEveryPrefixAndEveryExtension) {
  Pair p;
  const Bytes d = sealed(p.client);
  for (std::size_t size = 0; size < d.size(); ++size)
    ASSERT_FALSE(p.server.open(at(0s), std::span(d).first(size))) << size;
  Bytes longer = d;
  while (longer.size() < 1300) {
    longer.push_back(std::byte{0});
    ASSERT_FALSE(p.server.open(at(0s), longer)) << longer.size();
  }
  EXPECT_TRUE(p.server.open(at(0s), d));
}

TEST(SecureChannel, RejectsRandomBytesWithoutEffect) {
  Pair p;
  RandomStream random{1};
  for (int i = 0; i < 20000; ++i) {
    Bytes d(random.below(1300));
    for (std::byte& b : d) b = static_cast<std::byte>(random.bits());
    if (d.size() > 16 && random.below(2) == 0)  // half of them pass the checks of the header
      write_header({wire::Type::kForce, 0, 22, random.bits()}, std::span(d).first<kHeaderSize>());
    ASSERT_FALSE(p.server.open(at(0s), d));
  }
  EXPECT_GT(refused(p.server, DropReason::kTag), 1000U);
  EXPECT_GT(refused(p.server, DropReason::kHeader), 1000U);
  EXPECT_TRUE(acts(p.server, sealed(p.client)));
}

TEST(SecureChannel, RefusesItsOwnDatagramSentBack) {
  Pair p;
  EXPECT_EQ(p.client.open(at(0s), sealed(p.client)).error(), DropReason::kCid);
  SecureChannel mirror{{.outgoing = Direction::kToServer,
                        .own_cid = 5,
                        .peer_cid = 5,
                        .secrets = test::secrets(1)}};  // even where both ids are equal
  EXPECT_EQ(mirror.open(at(0s), sealed(mirror)).error(), DropReason::kTag);
}

TEST(SecureChannel, RefusesDatagramsOfAnotherConnection) {
  Pair p;
  SecureChannel other{{.outgoing = Direction::kToServer, .own_cid = 11, .peer_cid = 23, .secrets = test::secrets(2)}};
  Bytes d = sealed(other);
  EXPECT_EQ(p.server.open(at(0s), d).error(), DropReason::kCid);
  d[4] = std::byte{22};  // with the connection id replaced
  EXPECT_EQ(p.server.open(at(0s), d).error(), DropReason::kTag);
}

TEST(SecureChannel, AcceptsADuplicateOnce) {
  Pair p;
  const Bytes d = sealed(p.client);
  EXPECT_TRUE(acts(p.server, d));
  EXPECT_EQ(p.server.open(at(0s), d).error(), DropReason::kDuplicate);
  EXPECT_EQ(p.server.stats().accepted, 1U);
  EXPECT_EQ(refused(p.server, DropReason::kDuplicate), 1U);
}

TEST(SecureChannel, NeverAcceptsAnOlderDatagram) {
  const std::uint64_t last = tandem::test::seeds(20);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    Pair p;
    std::vector<Bytes> all;
    for (int i = 0; i < 200; ++i) all.push_back(sealed(p.client));
    std::uint64_t newest = 0;
    bool any = false;
    for (int i = 0; i < 600; ++i) {
      const std::uint64_t c = std::min<std::uint64_t>(199, random.below(20) + static_cast<std::uint64_t>(i) / 3);
      const bool acted = acts(p.server, all[c]);
      ASSERT_EQ(acted, !any || c > newest) << c;
      if (acted) newest = c;
      any = true;
    }
    EXPECT_EQ(p.server.stats().newest, newest);
  }
}

TEST(SecureChannel, RejectsDatagramsOlderThanItsWindow) {
  Pair p;
  const Bytes old = sealed(p.client);
  for (int i = 0; i < 1023; ++i) sealed(p.client);
  const Bytes edge = sealed(p.client);  // counter 1024
  ASSERT_TRUE(acts(p.server, edge));
  EXPECT_EQ(p.server.open(at(0s), old).error(), DropReason::kTooOld);
}

TEST(SecureChannel, CountsLossButNotLateness) {
  Pair p;
  std::vector<Bytes> all;
  for (int i = 0; i < 100; ++i) all.push_back(sealed(p.client));
  for (std::size_t i = 10; i < 100; ++i)
    if (i % 10 != 5 && i != 42) acts(p.server, all[i]);  // 9 lost, one late only
  EXPECT_FALSE(acts(p.server, all[42]));
  EXPECT_EQ(p.server.stats().late, 1U);
  EXPECT_EQ(p.server.stats().lost(), 9U);
  EXPECT_DOUBLE_EQ(p.server.stats().loss_percent(), 10.0);
  EXPECT_EQ(p.client.stats().sent, 100U);
  EXPECT_EQ(p.client.stats().loss_percent(), 0);  // received nothing, lost nothing
}

TEST(SecureChannel, KeepsItsLongestGapUntilReset) {
  Pair p;
  acts(p.server, sealed(p.client), at(0ms));
  acts(p.server, sealed(p.client), at(3ms));
  acts(p.server, sealed(p.client), at(40ms));
  acts(p.server, sealed(p.client), at(41ms));
  EXPECT_EQ(p.server.stats().longest_gap, 37ms);
  p.server.tick(at(41ms));
  EXPECT_EQ(p.server.stats().age.count(), 1U);
  p.server.restart_statistics(at(50ms));
  EXPECT_EQ(p.server.stats().accepted, 0U);
  EXPECT_EQ(p.server.stats().age.count(), 0U);
  EXPECT_EQ(p.server.stats().loss_percent(), 0);
  sealed(p.client);  // lost
  const Bytes next = sealed(p.client);
  acts(p.server, next, at(55ms));
  EXPECT_EQ(p.server.stats().loss_percent(), 0);  // counted from the first datagram after the restart
  EXPECT_FALSE(acts(p.server, next));             // the replay window is kept
  acts(p.server, sealed(p.client), at(60ms));
  EXPECT_EQ(p.server.stats().longest_gap, 5ms);
}

TEST(SecureChannel, EchoesTheNewestAcceptedDatagram) {
  Pair p;
  EXPECT_EQ(p.server.preamble(at(0ms), 9).echo_counter, ~std::uint64_t{0});
  sealed(p.client, at(0ms));
  const Bytes d = sealed(p.client, at(1ms));
  ASSERT_TRUE(acts(p.server, d, at(5ms)));
  const auto echo = p.server.preamble(at(8ms), 9);
  EXPECT_EQ(echo.echo_counter, 1U);
  EXPECT_EQ(echo.echo_age_us, 3000U);
  EXPECT_EQ(echo.tick, 9U);
  const auto opened = p.client.open(at(0s), sealed(p.server, at(8ms)));
  ASSERT_TRUE(opened);
  p.client.accept(at(12ms), *opened, echo);
  EXPECT_EQ(p.client.timing().rtt(), 8ms);  // 11 ms less the 3 ms that the server held it
  EXPECT_EQ(p.client.timing().loop_age(at(12ms)), 11ms);
}

TEST(SecureChannel, RejectsPlaintextThatDoesNotFit) {
  Pair p;
  Bytes d(2000);
  EXPECT_EQ(p.client.seal(at(0s), wire::Type::kState, d, 0), 0U);
  EXPECT_EQ(p.client.seal(at(0s), wire::Type::kState, d, kDatagramMax - 31), 0U);
  EXPECT_EQ(p.client.seal(at(0s), wire::Type::kState, std::span(d).first(71), 40), 0U);
  EXPECT_EQ(p.client.seal(at(0s), wire::Type::kState, d, ~std::size_t{0}), 0U);
  EXPECT_EQ(p.client.stats().sent, 0U);
  EXPECT_EQ(p.client.seal(at(0s), wire::Type::kState, d, kDatagramMax - 32), kDatagramMax);
}

TEST(SecureChannel, SealsAndOpensWithoutHeap) {
  Pair p;
  std::array<std::byte, 200> d{};
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 1000; ++i) {
    const std::size_t size = p.client.seal(at(i * 1ms), wire::Type::kState, d, 150);
    const auto opened = p.server.open(at(0s), std::span(d).first(size));
    ASSERT_TRUE(opened);
    p.server.accept(at(i * 1ms), *opened, p.server.preamble(at(i * 1ms), 1));
    p.server.tick(at(i * 1ms));
    d[20] ^= std::byte{1};
    ASSERT_FALSE(p.server.open(at(0s), std::span(d).first(size)));
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::transport
