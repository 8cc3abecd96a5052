// A link-test peer and a server core over a simulated network with exact delays, in virtual time. The findings must
// equal the simulated impairments.
#include "client/diagnostics/link_test.h"

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <memory>

#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/session/session.h"
#include "tests/support/alloc_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

struct Flying {
  Time due;
  std::vector<std::byte> bytes;
};
/// Returns the transit time of the n-th datagram of a direction; nullopt: lost.
using Way = std::function<std::optional<Duration>(std::uint64_t n, Time now)>;

Way steady(Duration delay) {
  return [delay](std::uint64_t, Time) { return delay; };
}

std::unique_ptr<server::Session> session_of(const SceneSpec& scene) {
  AxisArray scale;
  scale.fill(1);
  std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
  slaves.push_back(std::move(*hal::sim::SimDevice::make({scene.tools[0].slave, {}, {}, nullptr, Time{}})));
  return std::make_unique<server::Session>(scene, std::move(slaves), scale);
}

SceneSpec one_axis() { return *parse_scene(find_shipped_scene("one_axis")->text, "one_axis.textproto"); }

server::PeerAddress address(std::uint8_t n) {
  server::PeerAddress at;
  at.bytes[0] = std::byte{n};
  at.size = 1;
  return at;
}

struct Rig {
  explicit Rig(Time start = Time{} + 1h) : scene(one_axis()), session(session_of(scene)), now(start) {}

  [[nodiscard]] auto visit(std::uint64_t number) {
    return netsim::simulate_link_test_join(*session, now, RandomKey{5}, number);
  }

  void sit() {
    const auto visitor = visit(1);
    ASSERT_TRUE(visitor);
    test = std::make_unique<LinkTest>(visitor->setup, visitor->channel_params);
  }

  void fly(std::deque<Flying>& air, const Way& way, std::uint64_t& n, std::span<const std::byte> bytes) {
    const auto delay = way(n++, now);
    if (delay) air.push_back({now + *delay, {bytes.begin(), bytes.end()}});
  }

  /// Advances in steps of 0.5 ms. The server ticks at whole milliseconds and the peer in between, so that a
  /// datagram without network delay arrives after 0.5 ms.
  void run(Duration time, const std::function<void()>& every_tick = {}) {
    std::array<std::byte, transport::kDatagramMax> buffer{};
    for (const Time end = now + time; now < end; now += 500us) {
      for (auto* air : {&up_air, &down_air}) {
        for (auto i = air->begin(); i != air->end();) {
          if (i->due > now) {
            ++i;
            continue;
          }
          if (air == &up_air) {
            session->on_datagram(i->due, address(1), i->bytes);
          } else if (test) {
            test->on_datagram(i->due, i->bytes);
          }
          i = air->erase(i);
        }
      }
      if (now.time_since_epoch() % 1ms == 0ms) {
        session->on_tick(now, 0);
        while (const auto out = session->poll_transmit(now, buffer)) {
          ++server_sent;
          fly(down_air, down, down_n, std::span{buffer}.first(out->size));
        }
      } else if (test) {
        test->on_tick(now, wake_late, 0, wall_offset);
        while (const auto size = test->poll_transmit(now, buffer))
          fly(up_air, up, up_n, std::span{buffer}.first(*size));
        if (every_tick) every_tick();
      }
    }
  }
  LinkTestResult finish() {
    test->stop_sending(now);
    run(1s);
    test->leave();
    run(1s);
    return test->findings(now);
  }

  SceneSpec scene;
  std::unique_ptr<server::Session> session;
  std::unique_ptr<LinkTest> test;
  Time now;
  Way up = steady(0ms), down = steady(0ms);
  std::deque<Flying> up_air, down_air;
  std::uint64_t up_n = 0, down_n = 0, server_sent = 0;
  Duration wake_late{}, wall_offset{1000s};
};

TEST(LinkTest, MeasuresTheConfiguredDelay) {
  Rig rig;
  rig.sit();
  rig.up = steady(12ms);
  rig.down = steady(8ms);
  rig.run(5s);
  const LinkTestResult f = rig.finish();
  // The time for which a STATE waits for the server's tick is subtracted, because the network does not cause it.
  EXPECT_NEAR(*f.rtt_min, 0.020, 1e-6);
  EXPECT_NEAR(*f.rtt_p50, 0.020, 0.020 / 32);
  EXPECT_NEAR(*f.rtt_max, 0.020, 1e-6);
  EXPECT_NEAR(*f.jitter, 0, 1e-6);
  EXPECT_EQ(f.up->lost + f.down->lost + f.up->reordered + f.down->reordered + f.duplicates + f.refused, 0u);
  EXPECT_EQ(f.up->sent, 5000u);
  EXPECT_NEAR(f.down->longest_gap, 0.001, 1e-9);
  EXPECT_LE(f.up->longest_gap, 0.001);
  EXPECT_EQ(f.pauses, 0u);
  EXPECT_NEAR(f.seconds, 5, 0.01);
}

TEST(LinkTest, CountsLossOfEachDirectionExactly) {
  Rig rig;
  rig.sit();
  rig.up = [](std::uint64_t n, Time) { return n % 10 == 3 ? std::nullopt : std::optional<Duration>{2ms}; };
  rig.down = [](std::uint64_t n, Time) { return n % 50 == 7 ? std::nullopt : std::optional<Duration>{2ms}; };
  rig.run(4s);
  const LinkTestResult f = rig.finish();
  EXPECT_EQ(f.up->sent, 4000u);
  EXPECT_EQ(f.up->lost, 400u);
  EXPECT_NEAR(f.down->loss_percent(), 2, 0.05);
  EXPECT_EQ(f.up->reordered, 0u);
}

TEST(LinkTest, DistinguishesReorderedFromLost) {
  Rig rig;
  rig.sit();
  rig.run(10ms);
  rig.up = [](std::uint64_t n, Time) { return std::optional<Duration>{n % 20 == 5 ? 5ms : 2ms}; };
  rig.down = [](std::uint64_t n, Time) { return std::optional<Duration>{n % 40 == 5 ? 5ms : 2ms}; };
  rig.run(4s);
  const LinkTestResult f = rig.finish();
  EXPECT_EQ(f.up->lost, 0u);
  EXPECT_EQ(f.down->lost, 0u);
  EXPECT_NEAR(static_cast<double>(f.up->reordered), 200, 1);
  EXPECT_NEAR(static_cast<double>(f.down->reordered), 125, 1)
      << "FORCE goes on for the second in which what is under way may come";
}

TEST(LinkTest, FindsTheLongestGapOfEachDirection) {
  for (const bool upwards : {true, false}) {
    SCOPED_TRACE(upwards);
    Rig rig;
    rig.sit();
    const Time begin = rig.now;
    const Way broken = [begin](std::uint64_t, Time now) {
      return now - begin > 2s && now - begin < 2s + 150ms ? std::nullopt : std::optional<Duration>{1ms};
    };
    (upwards ? rig.up : rig.down) = broken;
    rig.run(5s);
    const LinkTestResult f = rig.finish();
    EXPECT_NEAR((upwards ? f.up : f.down)->longest_gap, 0.150, 0.003);
    EXPECT_LT((upwards ? f.down : f.up)->longest_gap, 0.003);
    EXPECT_EQ(f.pauses, upwards ? 0u : 1u);
  }
}

TEST(LinkTest, DetectsClockAndRouteChange) {
  Rig rig;
  rig.sit();
  rig.run(3s);
  rig.wall_offset += 250ms;
  rig.down = steady(30ms);
  rig.run(3s);
  const LinkTestResult f = rig.finish();
  EXPECT_NEAR(*f.clock_step, 0.250, 1e-9);
  EXPECT_NEAR(*f.transit_step, 0.030, 0.001);
}

TEST(LinkTest, CountsDuplicatesAndForgedDatagrams) {
  Rig rig;
  rig.sit();
  rig.run(100ms);
  const auto before = rig.test->findings(rig.now);
  std::vector<std::byte> kept;
  rig.down = [](std::uint64_t, Time) { return std::optional<Duration>{10ms}; };
  rig.run(5ms);
  ASSERT_FALSE(rig.down_air.empty());
  kept = rig.down_air.front().bytes;
  rig.run(20ms);
  rig.test->on_datagram(rig.now, kept);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    auto damaged = kept;
    damaged[i] ^= std::byte{1};
    rig.test->on_datagram(rig.now, damaged);
  }
  const auto f = rig.test->findings(rig.now);
  EXPECT_EQ(f.duplicates - before.duplicates, 1u);
  EXPECT_EQ(f.refused - before.refused, kept.size()) << "a flipped bit anywhere is never accepted";
}

TEST(LinkTest, JudgesTheLocalMachineSeparatelyFromTheNetwork) {
  Rig rig;
  rig.sit();
  rig.run(1s);
  rig.wake_late = 3ms;
  rig.run(1s);
  const LinkTestResult f = rig.finish();
  EXPECT_EQ(f.ticks, 2000u);
  EXPECT_EQ(f.late_ticks, 1000u);
  EXPECT_NEAR(f.wake_max, 0.003, 1e-9);
}

TEST(LinkTest, RunsWithoutHeapOnceStarted) {
  Rig rig;
  rig.sit();
  rig.run(100ms);
  std::vector<std::vector<std::byte>> waiting;
  rig.down = steady(1h);
  rig.run(50ms);
  std::array<std::byte, transport::kDatagramMax> buffer{};
  const test::AllocGuard guard;
  for (const Flying& f : rig.down_air) {
    rig.test->on_datagram(rig.now, f.bytes);
    rig.test->on_tick(rig.now, 0ms, 0, rig.wall_offset);
    EXPECT_TRUE(rig.test->poll_transmit(rig.now, buffer));
  }
  EXPECT_EQ(guard.count(), 0u);
}

TEST(LinkTestPeers, AreRemovedWhenTheyLeaveOrFallSilent) {
  Rig rig;
  rig.sit();
  rig.run(1s);
  const std::uint64_t with = rig.server_sent;
  EXPECT_GT(with, 900u);
  rig.test->stop_sending(rig.now);
  rig.run(4s);
  EXPECT_NEAR(static_cast<double>(rig.server_sent - with), 2000, 10)
      << "a visitor that says nothing for 2 s hears no more";
  const std::uint64_t after = rig.server_sent;
  rig.run(1s);
  EXPECT_EQ(rig.server_sent, after);
}

TEST(LinkTestPeers, ReceiveOnlyChallengesBeforeAddressValidation) {
  Rig rig;
  rig.sit();
  const std::unique_ptr<LinkTest> held = std::move(rig.test);
  rig.run(100ms);
  EXPECT_EQ(rig.server_sent, 0u) << "a peer that sent nothing receives nothing";
  std::array<std::byte, transport::kDatagramMax> buffer{};
  held->on_tick(rig.now, 0ms, 0, 0s);
  const auto size = held->poll_transmit(rig.now, buffer);
  rig.session->on_datagram(rig.now, address(9),
                           std::span{buffer}.first(*size));  // a copy that arrives before the original
  rig.run(400ms);
  EXPECT_EQ(rig.server_sent, 1U)
      << "the other address is asked once for the one datagram from there, and cannot answer";
  rig.session->on_datagram(rig.now, address(1), std::span{buffer}.first(*size));
  rig.run(100ms);
  EXPECT_EQ(rig.server_sent, 1U) << "the original came late: it acts no more";
}

TEST(LinkTestPeers, AreBoundedAndAffectNoSeat) {
  Rig rig;
  for (std::uint64_t i = 0; i < server::LinkTestPeers::kMax; ++i) EXPECT_TRUE(rig.visit(i));
  EXPECT_EQ(rig.visit(77).error(), server::JoinResult::kSeatTaken);
  for (std::size_t i = 0; i < rig.scene.seats.size(); ++i) EXPECT_FALSE(rig.session->seat(i).taken());
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 1;
  caps.simulated = true;
  EXPECT_TRUE(netsim::simulate_join(*rig.session, rig.now, 0, caps, RandomKey{5}, 5));
  rig.run(2001ms);
  EXPECT_TRUE(rig.visit(78)) << "a silent peer holds no place longer than 2 s";
}

TEST(LinkTestPeers, AreNotifiedWhenTheServerEnds) {
  Rig rig;
  rig.sit();
  rig.run(100ms);
  rig.session->participants().end(wire::CloseReason::kServerStops);
  rig.run(500ms);
  EXPECT_TRUE(rig.test->closed());
}

}  // namespace
}  // namespace tandem::client
