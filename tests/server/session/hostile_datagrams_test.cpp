// Unknown senders on the port of a real session: the requirements for datagrams (tests/FAILURES.md). Each test quotes
// its row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/common/base/counts.h"
#include "tests/server/session/session_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace test;

/// Number of repetitions: TANDEM_HOSTILE_COUNTS if set, otherwise TANDEM_COUNTS. `./test --full` runs some tests
/// completely in a sanitizer build, where all others are reduced. It is printed, so that a short run is never mistaken
/// for a long one.
std::size_t many(const char* what, std::size_t reduced, std::size_t full) {
  const char* own = std::getenv("TANDEM_HOSTILE_COUNTS");
  const std::size_t count =
      own != nullptr && std::string_view(own) == "full" ? full : tandem::test::draws(reduced, full, full);
  std::printf("[ hostile  ] %zu %s\n", count, what);
  return count;
}

/// Expects unchanged state and no reply.
void expect_untouched(SessionFixture& rig, std::uint64_t hash, const char* what) {
  EXPECT_TRUE(rig.server_sends().empty()) << what << ": a reply";
  EXPECT_EQ(rig.state_hash(), hash) << what;
}

// "Bit-flip every bit of 1000 valid datagrams: 0 accepted, 0 replies, 0 allocations on the receive thread."
TEST(HostileDatagrams, AreDroppedWithoutReplyOrHeapForEveryFlippedBit) {
  SessionFixture rig("free_motion");
  rig.run(300ms);
  const std::size_t count = many("valid datagrams, every bit of each", 40, 1000);
  std::uint64_t flips = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t seat = n % 2;
    for (Bytes& d : rig.client_tick(seat)) {
      // Sent before the genuine datagram: the session has not seen its counter yet.
      const std::uint64_t hash = rig.state_hash(), accepted = rig.heard(0).accepted + rig.heard(1).accepted;
      const tandem::test::AllocGuard guard;
      for (std::size_t bit = 0; bit < 8 * d.size(); ++bit) {
        d[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        rig.session->on_datagram(rig.now, address(n % 3 == 0 ? 9 : rig.seats[seat].at), d);
        d[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
      }
      ASSERT_EQ(guard.count(), 0U);
      flips += 8 * d.size();
      ASSERT_EQ(rig.heard(0).accepted + rig.heard(1).accepted, accepted);
      expect_untouched(rig, hash, "bit flip");
      rig.session->on_datagram(rig.now, address(rig.seats[seat].at), d);
      ASSERT_EQ(rig.heard(0).accepted + rig.heard(1).accepted, accepted + 1)
          << "the real one must act: else nothing was tried";
    }
    for (const Bytes& d : rig.client_tick(1 - seat))
      rig.session->on_datagram(rig.now, address(rig.seats[1 - seat].at), d);
    rig.to_clients(rig.server_tick());
    rig.now += 1ms;
  }
  std::printf("[ hostile  ] %llu flipped datagrams\n", static_cast<unsigned long long>(flips));
  EXPECT_EQ(rig.challenges[9] + rig.forces[9], 0);
}

// The same towards the client, which accepts no unauthenticated bytes either.
TEST(HostileDatagrams, AreDroppedByAClientForEveryFlippedBitOfAForce) {
  SessionFixture rig("free_motion");
  rig.run(300ms);
  const std::size_t count = many("FORCEs, every bit of each", 20, 1000);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t i = 0; i < 2; ++i)
      for (const Bytes& d : rig.client_tick(i)) rig.session->on_datagram(rig.now, address(rig.seats[i].at), d);
    const auto sent = rig.server_tick();
    for (const auto& [to, bytes] : sent) {
      client::Seat& core = *rig.seats[to - 1U].core;
      const std::uint64_t accepted = core.link().stats().accepted;
      Bytes d = bytes;
      const tandem::test::AllocGuard guard;
      for (std::size_t bit = 0; bit < 8 * d.size(); ++bit) {
        d[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        core.on_datagram(rig.now, d);
        d[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
      }
      ASSERT_EQ(guard.count(), 0U);
      ASSERT_EQ(core.link().stats().accepted, accepted);
      std::array<std::byte, transport::kDatagramMax> buffer;
      ASSERT_FALSE(core.poll_transmit(rig.now, buffer)) << "a reply";
    }
    rig.to_clients(sent);
    rig.now += 1ms;
  }
  EXPECT_EQ(rig.seats[0].core->gate().trips() + rig.seats[1].core->gate().trips(), 0U);
}

// "Random datagrams, sizes 0..2048, 10 M, ASan+UBSan: 0 accepted, 0 crashes." `./test --full` runs all ten million in
// the asan build.
TEST(HostileDatagrams, RandomBytesOfAnySizeAreNeitherAcceptedNorAnswered) {
  SessionFixture rig("free_motion"), twin("free_motion");
  rig.run(300ms);
  twin.run(300ms);
  const std::size_t count = many("random datagrams of 0 to 2048 bytes", 200'000, 10'000'000);
  constexpr std::size_t kEachTick = 2000;
  RandomStream random{5};
  std::array<std::byte, 2048> bytes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t size = random.below(bytes.size() + 1);
    for (std::size_t k = 0; k < size; k += 8) {
      const std::uint64_t drawn = random.bits();
      std::memcpy(&bytes[k], &drawn, std::min<std::size_t>(8, bytes.size() - k));
    }
    // One third is noise from the first byte, one third names a seat, one third is valid up to the tag with a
    // plausible counter.
    const std::size_t seat = random.below(2);
    const transport::Header header{static_cast<wire::Type>(3 + random.below(7)), 0, rig.seats[seat].params.peer_cid,
                                   i % 3 == 2 ? rig.heard(seat).newest + random.below(3) : random.bits()};
    if (i % 3 > 0 && size >= transport::kHeaderSize)
      transport::write_header(header, std::span(bytes).first<transport::kHeaderSize>());
    rig.session->on_datagram(rig.now, address(i % 2 == 0 ? 9 : 1), std::span(bytes).first(size));
    if (i % kEachTick == 0) {
      rig.tick([] {});
      twin.tick([] {});
    }
  }
  EXPECT_GT(rig.refused(transport::DropReason::kTag), count / 20) << "they must get as far as the tag";
  EXPECT_GT(rig.session->unmatched_datagrams(), count / 4);
  rig.run(100ms);
  twin.run(100ms);
  EXPECT_EQ(rig.told.value, twin.told.value) << "the server sent other datagrams than without the attack";
  EXPECT_EQ(rig.state_hash(), twin.state_hash());
}

// "Replay 100 000 captured packets, shuffled, doubled, from same and other address: 0 applied; state hash unchanged."
TEST(HostileDatagrams, ChangeNothingWhenReplayed) {
  SessionFixture rig("one_axis"), twin("one_axis");
  rig.scene.duration = twin.scene.duration = 3600;  // longer than the capture, so that no CLOSE is sent within it
  rig.run(300ms);
  twin.run(300ms);
  const std::size_t count = many("captured datagrams, each played twice", 5'000, 100'000);
  std::vector<Bytes> captured;
  captured.reserve(count);
  while (captured.size() < count) {
    for (SessionFixture* r : {&rig, &twin}) {
      for (const Bytes& d : r->client_tick()) {
        r->session->on_datagram(r->now, address(1), d);
        if (r == &rig) captured.push_back(d);
      }
      r->to_clients(r->server_tick());
      r->now += 1ms;
    }
  }
  std::vector<std::size_t> order(2 * captured.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i / 2;
  RandomStream random{6};
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  const std::uint64_t hash = rig.state_hash(), accepted = rig.heard().accepted;
  for (std::size_t i = 0; i < order.size(); ++i)
    rig.session->on_datagram(rig.now, address(i % 2 == 0 ? 1 : 9), captured[order[i]]);
  EXPECT_EQ(rig.heard().accepted, accepted) << "0 applied";
  expect_untouched(rig, hash, "replay");
  EXPECT_EQ(rig.refused(transport::DropReason::kDuplicate) + rig.refused(transport::DropReason::kTooOld), order.size());
  rig.run(200ms);
  twin.run(200ms);
  EXPECT_EQ(rig.told.value, twin.told.value);
  EXPECT_EQ(rig.challenges[9] + rig.forces[9], 0);
}

// "Reflection (client's own packet sent back): 0 accepted."
TEST(HostileDatagrams, AreRejectedWhenReflected) {
  SessionFixture rig("free_motion");
  rig.run(300ms);
  for (int n = 0; n < 200; ++n) {
    for (std::size_t i = 0; i < 2; ++i)
      for (const Bytes& d : rig.client_tick(i)) {
        rig.session->on_datagram(rig.now, address(rig.seats[i].at), d);
        for (FixtureSeat& s : rig.seats) {
          Bytes back = d;
          for (const std::uint32_t cid :
               {rig.seats[i].params.peer_cid,
                s.params.own_cid}) {  // unchanged, and with the other direction's connection id
            transport::detail::put(&back[4], cid);
            const std::uint64_t accepted = s.core->link().stats().accepted;
            s.core->on_datagram(rig.now, back);
            ASSERT_EQ(s.core->link().stats().accepted, accepted);
          }
        }
      }
    const auto sent = rig.server_tick();
    const std::uint64_t hash = rig.state_hash();
    for (const auto& [to, bytes] : sent) {
      Bytes back = bytes;
      for (const std::uint32_t cid :
           {rig.seats[to - 1U].params.own_cid, rig.seats[0].params.peer_cid, rig.seats[1].params.peer_cid}) {
        transport::detail::put(&back[4], cid);
        rig.session->on_datagram(rig.now, address(to), back);
      }
    }
    expect_untouched(rig, hash, "reflection");
    rig.to_clients(sent);
    rig.now += 1ms;
  }
}

// "Cross-session and cross-role swap of cid, old epoch after failover: 0 accepted." Keys are drawn per join as the
// exporter does it. The exporter binds session, epoch, connection, seat and role (exporter_context_test; the control
// server's exporter in control_server_test).
TEST(HostileDatagrams, AreRejectedFromAnotherSessionSeatOrEpoch) {
  SessionFixture rig("free_motion", 3), other("free_motion", 4), before("free_motion", 5);
  for (SessionFixture* r : {&rig, &other, &before}) r->run(300ms);
  for (int n = 0; n < 200; ++n) {
    std::vector<Bytes> foreign;
    for (SessionFixture* r : {&other, &before})
      for (std::size_t i = 0; i < 2; ++i)
        for (const Bytes& d : r->client_tick(i)) foreign.push_back(d);
    const std::size_t from_outside = foreign.size();
    const auto own = rig.client_tick(0);  // of the instructor's seat: for the trainee's seat it belongs to another role
    foreign.insert(foreign.end(), own.begin(), own.end());
    const std::uint64_t hash = rig.state_hash();
    for (std::size_t k = 0; k < foreign.size(); ++k)
      for (std::size_t seat = k < from_outside ? 0 : 1; seat < 2; ++seat) {
        Bytes d = foreign[k];
        transport::detail::put(&d[4], rig.seats[seat].params.peer_cid);
        for (int newer = 0; newer < 2; ++newer) {
          if (newer == 1) transport::detail::put<std::uint64_t>(&d[8], 1'000'000);
          rig.session->on_datagram(rig.now, address(rig.seats[seat].at), d);
        }
      }
    expect_untouched(rig, hash, "cid swap");
    // Datagrams of the old epoch's server to clients that have moved on.
    for (const auto& [to, bytes] : before.server_tick()) {
      client::Seat& core = *rig.seats[to - 1U].core;
      const std::uint64_t accepted = core.link().stats().accepted;
      Bytes d = bytes;
      core.on_datagram(rig.now, d);
      transport::detail::put(&d[4], rig.seats[to - 1U].params.own_cid);
      core.on_datagram(rig.now, d);
      ASSERT_EQ(core.link().stats().accepted, accepted);
    }
    for (const Bytes& d : own) rig.session->on_datagram(rig.now, address(1), d);
    for (const Bytes& d : rig.client_tick(1)) rig.session->on_datagram(rig.now, address(2), d);
    rig.to_clients(rig.server_tick());
    for (SessionFixture* r : {&rig, &other, &before}) r->now += 1ms;
  }
  EXPECT_GT(rig.refused(transport::DropReason::kTag, 0), 1000U);
  EXPECT_GT(rig.refused(transport::DropReason::kTag, 1), 1000U);
}

}  // namespace
}  // namespace tandem::server
