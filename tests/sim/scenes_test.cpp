// Every shipped scene runs to its end and keeps every invariant; also other numbers of seats and tools than two hands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "netsim/system/simulated_handshake.h"
#include "proto/text/scenes_embedded.h"
#include "server/report/trace_csv.h"
#include "tests/support/alloc_guard.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using test::delayed;
using test::run;
using test::shipped;

using namespace std::chrono_literals;

class ShippedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, RunsToItsEndAndPasses) {
  SceneSpec scene = shipped(GetParam());
  scene.duration = std::min(scene.duration, 60.0);  // scenes for users run for hours, without events of their own
  const auto r = run(scene);
  EXPECT_TRUE(r.trouble.empty()) << r.trouble;
  EXPECT_TRUE(r.report.passed);
  EXPECT_TRUE(r.report.violations.empty());
  EXPECT_NEAR(r.report.duration_s, scene.duration, 0.01);
  EXPECT_EQ(r.report.trace_hash.size(), 64u);
  for (const auto& s : r.report.seats) {
    EXPECT_TRUE(s.last.engaged) << s.name;
    EXPECT_EQ(s.gate_trips, 0u) << s.name;
    EXPECT_TRUE(std::isfinite(s.metrics.tracking_rms_m)) << s.name;
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& s : shipped_scenes()) all.emplace_back(s.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, ShippedScene, ::testing::ValuesIn(names()),
                         [](const auto& scene) { return scene.param; });

/// Returns n hands on m tools; hand i leads tool i mod m and follows the same tool.
SceneSpec crowd(std::size_t n, std::size_t m) {
  SceneSpec scene = shipped("free_motion");
  const SeatSpec leader = scene.seats[0];
  scene.seats.clear();
  scene.timeline.clear();
  scene.phases = {{"run", 1, 8, false}};
  scene.duration = 8;
  for (std::size_t i = 0; i < n; ++i) {
    SeatSpec s = leader;
    s.name = "hand" + std::to_string(i);
    s.hand.deviations.clear();
    s.hand.until = 1e6;
    s.hand.trajectory.radius = 0.02 + 0.002 * static_cast<double>(i);
    if (i >= m) s.hand.model = HandModel::kRelaxed, s.hand.k = s.hand.b = s.hand.m = 0;
    scene.seats.push_back(s);
  }
  const ToolSpec tool = scene.tools[0];
  scene.tools.clear();
  scene.authority.clear();
  scene.follow = {};
  for (std::size_t j = 0; j < m; ++j) {
    scene.tools.push_back(tool);
    scene.tools.back().name = "tool" + std::to_string(j);
    AuthorityRow row;
    row.tool = j;
    std::size_t sharers = 0;
    for (std::size_t i = j; i < n; i += m) ++sharers;
    for (std::size_t i = j; i < n; i += m) row.alpha[i] = 1.0 / static_cast<double>(sharers);
    scene.authority.push_back(row);
  }
  for (std::size_t i = 0; i < n; ++i) scene.follow[i][i % m] = 1;
  return scene;
}

TEST(ManyHands, AnyNumberOnAnyNumberOfToolsKeepsTheInvariants) {
  for (const auto& [n, m] : {std::pair{3, 1}, std::pair{2, 2}, std::pair{8, 1}, std::pair{8, 4}, std::pair{16, 8}})
    for (const double ms : {0.0, 30.0}) {
      const auto r = run(crowd(static_cast<std::size_t>(n), static_cast<std::size_t>(m)), delayed(ms, 5, 5));
      EXPECT_TRUE(r.report.passed) << n << " on " << m << " at " << ms;
      EXPECT_TRUE(r.trouble.empty()) << r.trouble;
      EXPECT_LE(r.authority_error_max, 1e-12);
      EXPECT_LE(r.hand_speed_max, 0.6) << n << " on " << m << " at " << ms;
    }
}

TEST(Simulation, TakesNoHeapBelowATickOnEitherSide) {
  auto made = netsim::Simulation::make({shipped("free_motion"), netsim::link_from(delayed(20, 5, 5)), 1, {}});
  ASSERT_TRUE(made);
  netsim::Simulation& simulation = **made;
  for (int k = 0; k < 3000; ++k) ASSERT_TRUE(simulation.step());
  test::AllocGuard guard;
  for (int k = 0; k < 10'000; ++k) simulation.step();
  EXPECT_EQ(guard.count(), 0u);
}

TEST(Simulation, SeatsAreRefusedWhenTakenOrUnknown) {
  const SceneSpec scene = shipped("one_axis");
  AxisArray scale;
  scale.fill(1);
  std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
  slaves.push_back(std::move(*hal::sim::SimDevice::make({scene.tools[0].slave, {}, {}, nullptr, Time{}})));
  server::Session session{scene, std::move(slaves), scale};
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 1;
  caps.simulated = true;
  const auto ask = [&](const std::string& seat, Duration at, bool same_owner = false) {
    static std::uint64_t attempts = 0;
    const auto number = session.seat_catalogue().seat_named(seat);
    const auto joined =
        netsim::simulate_join(session, Time{} + at, number.value_or(99), caps, RandomKey{1}, ++attempts, same_owner);
    return joined ? server::JoinResult::kAccepted : joined.error();
  };
  EXPECT_EQ(ask("trainer", 5ms), server::JoinResult::kAccepted);
  EXPECT_EQ(ask("trainer", 6ms), server::JoinResult::kSeatTaken);
  EXPECT_EQ(ask("trainer", 7ms, true), server::JoinResult::kAccepted) << "the same owner, again";
  EXPECT_EQ(ask("trainer", 2007ms), server::JoinResult::kSeatTaken);
  EXPECT_EQ(ask("trainer", 2008ms), server::JoinResult::kAccepted) << "its owner was silent for two seconds";
  EXPECT_EQ(ask("absent", 5ms), server::JoinResult::kNoSuchSeat);
  EXPECT_EQ(session.seat_catalogue().seat_names(), "trainer");
  caps.joints = caps.tip_axes = 0;
  EXPECT_EQ(ask("trainer", 3000ms), server::JoinResult::kDeviceUnfit);
  session.participants().end(wire::CloseReason::kDone);
  caps.joints = caps.tip_axes = 1;
  EXPECT_EQ(ask("trainer", 3000ms), server::JoinResult::kSessionOver);
}

TEST(Simulation, GivesNoAuthorityToAnEvaluator) {
  SceneSpec scene = shipped("eight_seats");
  scene.seats[0].role = Role::kInstructor;  // the instructor may move alpha, but not onto an evaluator
  scene.duration = 4;
  scene.phases = {{"work", 1, 4, false}};
  bool asked = false, asked_by_evaluator = false;
  const auto r = run(scene, {}, 1, [&](netsim::Simulation& w) {
    if (w.session().clock().time() < 2 || w.session().clock().time() > 3.9) return;
    std::array<double, 8> alpha{};
    alpha[3] = 1;
    asked |= w.seat(0)->requests().change_authority(0, alpha);
    asked_by_evaluator |= w.seat(3)->requests().change_authority(0, alpha);
    EXPECT_EQ(w.session().tool(0).authority.alpha(3), 0);
    EXPECT_EQ(w.session().tool(0).authority.alpha(0), 1);
  });
  EXPECT_TRUE(r.report.passed);
  EXPECT_TRUE(asked);
  EXPECT_FALSE(asked_by_evaluator) << "a client refuses already";
}

TEST(Simulation, LetsAnInstructorMoveAuthorityFromTheSeat) {
  SceneSpec scene = shipped("free_motion");
  scene.timeline.clear();
  scene.duration = 6;
  scene.phases = {{"run", 1, 6, false}};
  double at_three = 1, at_end = 1;
  const auto r = run(scene, delayed(20, 5, 20), 1, [&](netsim::Simulation& w) {
    const double t = w.session().clock().time();
    if (t >= 3 && t < 3.0015) {
      const std::array<double, 2> half{0.5, 0.5};
      EXPECT_TRUE(w.seat(0)->requests().change_authority(0, half));
      EXPECT_TRUE(w.seat(1)->requests().change_authority(0, std::array{0.0, 1.0}))
          << "a trainee may ask, and only to give back: the server decides";
      at_three = w.session().tool(0).authority.alpha(0);
    }
    if (w.record().running) at_end = w.session().tool(0).authority.alpha(0);
  });
  EXPECT_TRUE(r.report.passed);
  EXPECT_EQ(at_three, 1);
  EXPECT_NEAR(at_end, 0.5, 1e-9) << "lost datagrams are asked again until the server shows the version";
}

TEST(Simulation, RandomBytesOnThePortChangeNothing) {
  const auto trace_with_noise = [](bool noise) {
    auto made = netsim::Simulation::make({shipped("one_axis"), {}, 1, {}});
    netsim::Simulation& simulation = **made;
    server::TraceCsv csv{simulation.scene()};
    RandomStream random{99};
    std::string trace;
    std::array<std::byte, 1300> bytes{};
    while (simulation.step()) {
      if (noise && simulation.session().clock().time() < 2) {
        for (int i = 0; i < 20; ++i) {
          const std::size_t size = random.below(bytes.size());
          for (std::size_t b = 0; b < size; ++b) bytes[b] = static_cast<std::byte>(random.bits());
          if (size > 1 && i % 2 == 0)
            bytes[0] = static_cast<std::byte>(0x10 | (1 + i % 9)), bytes[2] = bytes[3] = std::byte{0};
          server::PeerAddress from;
          from.bytes[0] = static_cast<std::byte>(random.below(3));
          from.size = 1;
          const_cast<server::Session&>(simulation.session())
              .on_datagram(simulation.now(), from, std::span{bytes}.first(size));
        }
      }
      if (simulation.record().running) csv.append(simulation.record(), trace);
    }
    return trace;
  };
  EXPECT_EQ(trace_with_noise(true), trace_with_noise(false));
}

}  // namespace
}  // namespace tandem
