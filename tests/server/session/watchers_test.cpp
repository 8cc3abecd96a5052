// Consoles that watch a session, in virtual time: rates, values, slots, silence, overload; and that no hand notices.
#include "server/session/watchers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "client/diagnostics/session_watch.h"
#include "netsim/system/simulated_handshake.h"
#include "tests/server/session/session_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace test;
using client::SessionWatch;

void endless(SceneSpec& scene) { scene.duration = 3600; }

/// A session with watchers at the addresses 200, 201, ...
struct Watched : SessionFixture {
  explicit Watched(const std::string& scene_name = "free_motion") : SessionFixture(scene_name, 3, {}, 0, endless) {}

  struct Watcher {
    std::unique_ptr<SessionWatch> watch;
    std::uint8_t at = 0;
    std::uint32_t cid = 0;  ///< at the session
    bool speaks = true;
    int telemetry = 0, datagrams = 0;  ///< received
  };
  Watcher& add(bool recorder = false) {
    const auto n = static_cast<std::uint8_t>(watchers.size());
    const auto joined = netsim::simulate_watch_join(*session, now, RandomKey{77}, n + std::uint64_t{1}, recorder);
    EXPECT_TRUE(joined);
    watchers.push_back(std::make_unique<Watcher>());
    watchers.back()->watch = std::make_unique<SessionWatch>(telemetry_layout(scene), session->seat_catalogue().tick(),
                                                            joined->channel_params);
    watchers.back()->at = static_cast<std::uint8_t>(200 + n);
    watchers.back()->cid = joined->channel_params.peer_cid;
    return *watchers.back();
  }
  void step() {
    tick([this] {
      std::array<std::byte, transport::kDatagramMax> buffer;
      for (auto& w : watchers)
        while (const auto size = w->watch->poll_transmit(now, buffer))
          if (w->speaks) session->on_datagram(now, address(w->at), std::span{buffer}.first(*size));
    });
    for (const auto& [to, bytes] : others)
      for (auto& w : watchers)
        if (to == w->at) {
          ++w->datagrams;
          w->telemetry += w->watch->on_datagram(now, bytes) ? 1 : 0;
        }
  }
  void steps(int n) {
    for (int i = 0; i < n; ++i) step();
  }
  std::vector<std::unique_ptr<Watcher>> watchers;
};

TEST(Watchers, ReceiveSixtyPerSecondAndRecordersEveryTick) {
  Watched s;
  Watched::Watcher &console = s.add(), &recorder = s.add(true);
  s.steps(200);
  console.telemetry = recorder.telemetry = 0;
  s.steps(1700);
  EXPECT_EQ(console.telemetry, 100) << "every 17th tick of 1 ms";
  EXPECT_EQ(recorder.telemetry, 1700);
  EXPECT_EQ(console.watch->statistics().lost(), 0u);
}

TEST(Watchers, OfOneSessionReceiveAtTheSameTickAndOfOthersAtAnotherOne) {
  Watched s, other;
  s.session->watchers().set_phase(100);
  other.session->watchers().set_phase(101);
  Watched::Watcher& first = s.add();
  s.steps(5);
  Watched::Watcher& second = s.add();
  Watched::Watcher& elsewhere = other.add();
  other.steps(5);
  for (int n = 0; n < 200; ++n) {
    s.step();
    other.step();
  }
  first.telemetry = second.telemetry = elsewhere.telemetry = 0;
  for (int n = 0; n < 340; ++n) {
    const int before = first.telemetry, before_elsewhere = elsewhere.telemetry;
    s.step();
    other.step();
    ASSERT_EQ(first.telemetry, second.telemetry) << n;
    EXPECT_FALSE(first.telemetry > before && elsewhere.telemetry > before_elsewhere) << n;
  }
  EXPECT_EQ(first.telemetry, 20);
  EXPECT_EQ(elsewhere.telemetry, 20);
}

TEST(Watchers, ReceiveTheValuesOfTheRecord) {
  Watched s("lesson");
  Watched::Watcher& recorder = s.add(true);
  s.steps(3000);
  const auto single = [](double v) { return static_cast<double>(static_cast<float>(v)); };
  bool engaged = false;
  for (int n = 0; n < 200; ++n) {
    s.step();
    const TickRecord& record = s.session->record();
    const wire::SessionTelemetry& seen = *recorder.watch->newest();
    ASSERT_EQ(seen.session_tick, record.tick);
    EXPECT_EQ(seen.state, s.session->state());
    for (std::size_t i = 0; i < s.scene.masters(); ++i) {
      EXPECT_TRUE(seen.seats[i].taken && seen.seats[i].heard);
      EXPECT_EQ(seen.seats[i].engaged, record.seats[i].engaged);
      EXPECT_EQ(seen.seats[i].gate, record.seats[i].gate);
      engaged |= seen.seats[i].engaged;
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(seen.seats[i].x[k], single(record.seats[i].x[k]));
        EXPECT_EQ(seen.seats[i].f[k], single(record.seats[i].f_out[k]));
      }
    }
    for (std::size_t j = 0; j < s.scene.tools.size(); ++j)
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(seen.tools[j].x[k], single(record.tools[j].x[k]));
        EXPECT_EQ(seen.tools[j].f[k], single(record.tools[j].f_env[k]));
      }
  }
  EXPECT_TRUE(engaged) << "else there is nothing to compare";
  for (std::size_t i = 0; i < s.scene.seats.size(); ++i) {
    const wire::WatchedLink& link = recorder.watch->link_of(i);
    EXPECT_EQ(link.loss_up_percent, 0) << i;
    EXPECT_TRUE(std::isfinite(link.rtt_p50_ms) && std::isfinite(link.margin_min_j)) << i;
  }
  double sum = 0;
  for (std::size_t k = 0; k < s.scene.masters(); ++k) {
    EXPECT_EQ(recorder.watch->authority_over(0).applied[k], single(s.session->tool(0).authority.alpha(k)));
    sum += recorder.watch->authority_over(0).wanted[k];
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(Watchers, SeeAnAnnouncedTransferWithItsOrigin) {
  Watched s;
  Watched::Watcher& recorder = s.add(true);
  s.steps(1500);
  wire::AuthorityMessage wish{
      .version = s.session->authority().version(), .tool = 0, .masters = 2, .alpha = {0.25, 0.75}};
  ASSERT_EQ(s.session->authority().request(s.now, {AccessRole::kInstructor}, wish), CommandResult::kDone);
  s.step();
  const wire::WatchedAuthority& seen = recorder.watch->authority_over(0);
  EXPECT_EQ(seen.transfer_by, wire::TransferParties::kOperator) << "no seat asked";
  EXPECT_GT(seen.transfer_ticks, 0u);
  EXPECT_LE(seen.transfer_ticks, wire::kTransferNoticeTicks);
  EXPECT_EQ(seen.wanted[1], 0.75);
  EXPECT_NE(seen.applied[1], 0.75) << "not yet in force";
  s.steps(3000);
  EXPECT_EQ(recorder.watch->authority_over(0).transfer_ticks, 0u);
  EXPECT_NEAR(recorder.watch->authority_over(0).applied[1], 0.75, 1e-6);
}

TEST(Watchers, ChangeNothingForAnyHand) {
  for (const char* scene : {"free_motion", "lesson", "two_by_two"}) {
    SCOPED_TRACE(scene);
    Watched alone(scene), watched(scene);
    for (int n = 0; n < 3; ++n) watched.add(n == 0);
    for (int n = 0; n < 3000; ++n) {
      alone.step();
      watched.step();
      if (n % 100 == 0) {
        ASSERT_EQ(alone.state_hash(), watched.state_hash()) << n;
      }
    }
    EXPECT_GT(watched.watchers[0]->telemetry, 2000);
  }
}

TEST(Watchers, AreTheFirstThatAnOverloadedServerSheds) {
  const SceneSpec scene = *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto");
  const CloseOut open;
  const Watchers watchers(scene, open);
  EXPECT_EQ(watchers.interval(true, ShedLevel::kNone), 1u);
  EXPECT_EQ(watchers.interval(false, ShedLevel::kNone), 17u);
  EXPECT_EQ(watchers.interval(true, ShedLevel::kTelemetry), 10u);
  EXPECT_EQ(watchers.interval(false, ShedLevel::kTelemetry), 68u);
  for (const ShedLevel level : {ShedLevel::kObservers20Hz, ShedLevel::kNewJoins})
    for (const bool recorder : {false, true}) EXPECT_EQ(watchers.interval(recorder, level), 500u);

  Watched s;
  Watched::Watcher& recorder = s.add(true);
  s.steps(200);
  s.session->lifecycle().set_load_state({ShedLevel::kTelemetry, false});
  s.steps(20);
  EXPECT_EQ(recorder.watch->newest()->shed_level, 1u);
  recorder.telemetry = 0;
  s.steps(1000);
  EXPECT_EQ(recorder.telemetry, 100);
}

TEST(Watchers, GetNothingFromTheirAddressUntilItIsValidated) {
  Watched s;
  Watched::Watcher& liar = s.add(true);
  std::array<std::byte, transport::kDatagramMax> buffer;
  std::size_t sent = 0, got = 0;
  for (int n = 0; n < 1500; ++n) {  // sends WATCH, and does not answer the challenge
    s.tick([&] {
      const auto size = liar.watch->poll_transmit(s.now, buffer);
      if (!size) return;
      sent += *size;
      s.session->on_datagram(s.now, address(liar.at), std::span{buffer}.first(*size));
    });
    for (const auto& [to, bytes] : s.others) {
      got += bytes.size();
      EXPECT_EQ(transport::read_header(bytes)->type, wire::Type::kPathChallenge);
    }
  }
  EXPECT_GT(got, 0u);
  EXPECT_LE(got, sent) << "the server never sends more to such an address than it received from it";
}

TEST(Watchers, LoseTheirSlotAfterTwoSecondsOfSilence) {
  Watched s;
  Watched::Watcher& one = s.add();
  s.steps(500);
  ASSERT_GT(one.telemetry, 0);
  one.speaks = false;
  s.steps(2200);
  one.datagrams = 0;
  s.steps(500);
  EXPECT_EQ(one.datagrams, 0);
  EXPECT_EQ(s.session->watchers().slots().places_free(s.now), Watchers::kMax);
  EXPECT_FALSE(s.session->watchers().any());
}

/// A watcher that sends nothing for 2.5 s, as if its datagrams were lost.
Watched::Watcher& silent_one(Watched& s, bool recorder = false) {
  Watched::Watcher& one = s.add(recorder);
  s.steps(500);
  one.speaks = false;
  s.steps(2500);
  EXPECT_FALSE(s.session->watchers().any());
  one.speaks = true;
  one.telemetry = 0;
  return one;
}

TEST(Watchers, ReceiveAgainAfterASilence) {
  for (const bool recorder : {false, true}) {
    Watched s;
    Watched::Watcher& one = silent_one(s, recorder);
    for (std::size_t n = 1; n < Watchers::kMax; ++n) s.add();
    s.steps(1000);
    EXPECT_GT(one.telemetry, recorder ? 500 : 30) << "seven others leave its slot to it";
  }
}

TEST(Watchers, DoNotReturnOnceAnotherHasTheirSlot) {
  Watched s;
  const Watched::Watcher& one = silent_one(s);
  for (std::size_t n = 0; n < Watchers::kMax; ++n) s.add();
  s.steps(1000);
  EXPECT_EQ(one.telemetry, 0);
  for (std::size_t n = 1; n <= Watchers::kMax; ++n) EXPECT_GT(s.watchers[n]->telemetry, 30) << n;
}

TEST(Watchers, DoNotReturnOnceTheyAreRemoved) {
  Watched s;
  const Watched::Watcher& one = silent_one(s);
  EXPECT_TRUE(s.session->watchers().slots().remove(0, one.cid, wire::CloseReason::kRevoked));
  s.steps(1000);
  EXPECT_EQ(one.telemetry, 0);
  EXPECT_FALSE(s.session->watchers().any());
}

TEST(Watchers, DoNotReturnByBytesThatAreNotTheirs) {
  Watched s;
  const Watched::Watcher& one = silent_one(s);
  std::array<std::byte, transport::kDatagramMax> buffer;
  const auto size = one.watch->poll_transmit(s.now, buffer);
  ASSERT_TRUE(size);
  for (std::size_t i = 0; i < *size; ++i) {
    buffer[i] ^= std::byte{1};
    s.session->on_datagram(s.now, address(one.at), std::span{buffer}.first(*size));
    EXPECT_FALSE(s.session->watchers().any()) << i;
    buffer[i] ^= std::byte{1};
  }
  s.session->on_datagram(s.now, address(one.at), std::span{buffer}.first(*size));
  EXPECT_TRUE(s.session->watchers().any());
}

TEST(Watchers, FillEightSlotsAndAreRefusedThen) {
  Watched s;
  for (std::size_t n = 0; n < Watchers::kMax; ++n) s.add();
  const auto ninth = netsim::simulate_watch_join(*s.session, s.now, RandomKey{78}, 1);
  ASSERT_FALSE(ninth);
  EXPECT_EQ(ninth.error(), JoinResult::kSeatTaken);
  s.steps(300);
  s.watchers[3]->watch->leave();
  s.steps(5);
  EXPECT_EQ(s.session->watchers().slots().places_free(s.now), 1u) << "CLOSE frees the slot at once";
  EXPECT_TRUE(netsim::simulate_watch_join(*s.session, s.now, RandomKey{78}, 2));
}

TEST(Watchers, ReceiveTheReasonWhyTheWatchEnds) {
  Watched s;
  Watched::Watcher &console = s.add(), &revoked = s.add();
  s.steps(300);
  EXPECT_FALSE(s.session->watchers().slots().remove(1, 12345, wire::CloseReason::kRevoked)) << "another connection";
  const std::uint32_t cid = netsim::simulate_watch_join(*s.session, s.now, RandomKey{78}, 9)->channel_params.peer_cid;
  EXPECT_TRUE(s.session->watchers().slots().remove(2, cid, wire::CloseReason::kRevoked));
  EXPECT_FALSE(revoked.watch->closed());
  s.session->participants().end(wire::CloseReason::kServerStops);
  s.steps(400);
  for (const Watched::Watcher* w : {&console, &revoked}) EXPECT_EQ(w->watch->closed(), wire::CloseReason::kServerStops);
  EXPECT_FALSE(netsim::simulate_watch_join(*s.session, s.now, RandomKey{78}, 3)) << "the session is over";
}

TEST(Watchers, TakeNoHeap) {
  Watched s("lesson");
  s.add();
  s.add(true);
  s.steps(500);
  std::array<std::byte, transport::kDatagramMax> buffer;
  std::size_t sent = 0;
  const tandem::test::AllocGuard guard;
  for (int n = 0; n < 40; ++n) {
    s.now += 1ms;
    s.session->on_tick(s.now, 0);
    while (s.session->poll_transmit(s.now, buffer)) ++sent;
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(sent, 80u);
}

TEST(Watchers, SeeASeatThatHasSentNothingAsUnknown) {
  Watched s;
  Watched::Watcher& recorder = s.add(true);
  s.seats.clear();  // joined, but none sends a datagram
  s.steps(500);
  const wire::SessionTelemetry& seen = *recorder.watch->newest();
  EXPECT_TRUE(seen.seats[0].taken);
  EXPECT_FALSE(seen.seats[0].heard || seen.seats[0].engaged);
  EXPECT_TRUE(std::isnan(seen.seats[0].x[0]) && std::isnan(seen.seats[0].f[0]));
  const wire::WatchedLink& link = recorder.watch->link_of(0);
  EXPECT_TRUE(std::isnan(link.loss_up_percent) && std::isnan(link.rtt_p50_ms) && std::isnan(link.margin_min_j));
}

TEST(Watchers, SeeASeatThatIsFreeAsUnknown) {
  Watched s;
  Watched::Watcher& recorder = s.add(true);
  s.steps(500);
  ASSERT_TRUE(std::isfinite(recorder.watch->newest()->seats[1].x[0]));
  s.seats[1].core->leave();
  int ms = 0;
  while (!s.seats[1].core->closed() && ms < 5000) s.step(), ++ms;
  ASSERT_TRUE(s.seats[1].core->closed());
  s.steps(10);
  const wire::WatchedSeatState& free = recorder.watch->newest()->seats[1];
  EXPECT_FALSE(free.taken || free.heard || free.engaged);
  EXPECT_TRUE(std::isnan(free.x[0]) && std::isnan(free.f[0]));
  EXPECT_TRUE(std::isnan(recorder.watch->link_of(1).rtt_p50_ms)) << "nor is its link that of the past";
}

}  // namespace
}  // namespace tandem::server
