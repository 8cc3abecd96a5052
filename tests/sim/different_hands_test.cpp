// Hands that differ: scaled motion, devices whose weight is calibrated, and forces separated from weight and friction,
// in whole sessions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/base/rng.h"
#include "netsim/system/simulation.h"
#include "proto/text/scene_text.h"
#include "tests/common/base/counts.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using test::delayed;
using test::run;
using test::RunResult;
using test::shipped;

void expect_no_breach(const RunResult& r) {
  EXPECT_TRUE(r.trouble.empty()) << r.trouble;
  for (const auto& v : r.report.violations)
    EXPECT_TRUE(v.expected) << v.invariant << " at " << v.seat << ", first at " << v.at_s << " s";
}

/// The hand's circle of 30 mm moves the tool on a circle of 30 s mm.
TEST(ScaledHand, LeadsTheToolByItsScaleUnderEveryLaw) {
  for (std::size_t law = 0; law < kLaws; ++law)
    for (const double s : {0.3, 2.0}) {
      SCOPED_TRACE(std::to_string(law) + ", s " + std::to_string(s));
      SceneSpec scene = shipped("free_motion");
      choose_law(scene, static_cast<LawKind>(law));
      scene.duration = 6;
      scene.seats[0].motion_scale = s;
      scene.seats[0].hand.trajectory.radius = 0.03;
      double hand = 0, tool = 0;
      const RunResult r = run(scene, {}, 1, [&](netsim::Simulation& simulation) {
        if (simulation.session().clock().time() < 2) return;
        hand = std::max(hand, simulation.device(0).ground_truth().x.norm());
        tool = std::max(tool, std::hypot(simulation.session().tool(0).x(0), simulation.session().tool(0).x(2)));
      });
      expect_no_breach(r);
      EXPECT_GT(hand, 0.025);
      EXPECT_NEAR(tool / hand, s, 0.25 * s);
      if (static_cast<LawKind>(law) == LawKind::kReplica) {
        EXPECT_NEAR(tool / hand, s, 0.02 * s);
        EXPECT_LT(r.seat("trainer").metrics.tracking_rms_m, 0.0005 * std::max(1.0, s)) << "judged at the tool";
      }
    }
}

/// The hand presses 10 mm beyond the wall with 1000 N/m. Its device's spring, s^2 times the wall and the hand in series
/// give the force at the hand; the tool presses with 1 / s of it.
TEST(ScaledHand, PressesWithTheForceOfTheTransformer) {
  for (const double s : {0.5, 2.0}) {
    SCOPED_TRACE(s);
    SceneSpec scene = shipped("contact");
    scene.seats[0].motion_scale = s;
    scene.duration = 10;
    scene.phases.clear();
    double hand = 0, tool = 0;
    const RunResult r = run(scene, delayed(20), 1, [&](netsim::Simulation& simulation) {
      if (simulation.session().clock().time() > 9) return;  // then the session ends
      if (simulation.seat(0) != nullptr) hand = simulation.seat(0)->effort()[0];
      tool = simulation.session().tool(0).body()->surface_force()[0];
    });
    expect_no_breach(r);
    const double k_c = 372, expected = 0.01 / (1 / 1000.0 + 1 / k_c + 1 / (s * s * 20000));
    EXPECT_NEAR(-hand, expected, 0.12) << "friction of the device holds up to 0.1 N";
    EXPECT_NEAR(tool, hand / s, 0.02 * std::abs(hand / s)) << "the trainee's relaxed hand holds a little";
  }
}

/// Energy books of both ends, work of the motors on hands, and all other invariants, for any scales, laws and networks.
TEST(ScaledHand, KeepsAllInvariantsForAnyScaleLawAndNetwork) {
  for (std::uint64_t seed = 1, last = test::seeds(8); seed <= last; ++seed) {
    RandomStream r(seed);
    SceneSpec scene = shipped(std::array{"free_motion", "contact", "guidance", "two_by_two"}[seed % 4]);
    const auto law = seed % 2 == 0 ? LawKind::kReplica : static_cast<LawKind>(seed / 2 % kLaws);
    if (scene.tools.size() == 1) choose_law(scene, law);
    scene.duration = 6;
    scene.phases.clear();
    std::erase_if(scene.timeline, [](const TimedAuthority& change) { return change.at > 5; });
    for (SeatSpec& seat : scene.seats) seat.motion_scale = std::exp(r.uniform(std::log(0.1), std::log(4.0)));
    const double delay = r.uniform(0, 150);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", law " + std::to_string(static_cast<int>(scene.channel.law)) +
                 ", scales " + std::to_string(scene.seats[0].motion_scale) + " and " +
                 std::to_string(scene.seats[1].motion_scale) + ", delay " + std::to_string(delay));
    const RunResult result = run(scene, delayed(delay, r.uniform(0, 20), r.uniform(0, 10)), seed);
    expect_no_breach(result);
    if (scene.channel.law == LawKind::kRaw) continue;  // it may diverge
    EXPECT_LE(result.hand_speed_max, 2.0);
  }
}

/// The scene of the paper's free motion with Touch arms that carry 0.1 kg.
SceneSpec loaded(bool compensate, bool calibrate) {
  SceneSpec scene = shipped("seed_free_motion");
  scene.duration = 10;
  scene.phases = {{"all", 2, 10, false}};
  scene.timeline.clear();
  for (SeatSpec& seat : scene.seats) {
    seat.device.load = 0.1;
    seat.device.gravity_compensation = compensate;
    seat.device.calibrate = calibrate;
  }
  scene.tools[0].slave = scene.seats[0].device;
  return scene;
}

TEST(WeightCompensation, LevelsTheErrorsOfJointOneAndTwo) {
  const auto ratio = [](const RunResult& r) {
    const auto& joints = r.phase("all", "trainer").joint_rms_rad;
    std::printf("[  joints  ] %.4f %.4f %.4f rad\n", joints[0], joints[1], joints[2]);
    return joints[1] / joints[0];
  };
  const RunResult on = run(loaded(true, true)), off = run(loaded(false, true)), model = run(loaded(true, false));
  EXPECT_LE(ratio(on), 1.5);
  EXPECT_GT(ratio(off), 1.5) << "switched off";
  EXPECT_GT(ratio(model), 1.1 * ratio(on)) << "the built-in model does not contain the load";
}

/// A relaxed hand whose device has friction and carries a load shares the tool with a hand that leads slowly.
SceneSpec shared(double friction, double load, bool separate) {
  SceneSpec scene = shipped("guidance");
  scene.duration = 8;
  scene.seats[0].device.friction = 0.05;
  SeatSpec& trainee = scene.seats[1];
  trainee.hand = {};
  trainee.hand.model = HandModel::kRelaxed;
  trainee.hand.b = 2;
  trainee.hand.m = 0.1;
  trainee.device.friction = friction;
  trainee.device.load = load;
  trainee.device.gravity_compensation = false;
  trainee.device.calibrate = true;
  trainee.force_separation = separate;
  scene.phases.clear();
  return scene;
}

/// Mean force that the trainer feels after 3 s [N].
double felt(const SceneSpec& scene, double delay, std::uint64_t seed) {
  double sum = 0;
  std::size_t ticks = 0;
  const RunResult r = run(scene, delayed(delay, 0.2 * delay, 1), seed, [&](netsim::Simulation& simulation) {
    if (simulation.session().clock().time() < 3 || simulation.seat(0) == nullptr) return;
    const AxisArray& f = simulation.seat(0)->effort();
    sum += std::hypot(f[0], f[1], f[2]);
    ++ticks;
  });
  expect_no_breach(r);
  EXPECT_LE(r.hand_speed_max, 1.0);
  return sum / static_cast<double>(std::max<std::size_t>(1, ticks));
}

/// The same with the trainee's device as ideal: without load, with its weight balanced, and hardly any friction.
double felt_without_device(double delay) {
  SceneSpec scene = shared(0.01, 0, false);
  scene.seats[1].device.gravity_compensation = true;
  return felt(scene, delay, 1);
}

TEST(ForceSeparation, TakesWeightAndFrictionOutOfTheForceThatOthersFeel) {
  const double ideal = felt_without_device(0);
  for (const auto& [friction, load] : {std::pair{0.1, 0.0}, std::pair{0.5, 0.0}, std::pair{0.3, 0.1}}) {
    SCOPED_TRACE(std::to_string(friction) + " N, " + std::to_string(load) + " kg");
    const double on = felt(shared(friction, load, true), 0, 1), off = felt(shared(friction, load, false), 0, 1);
    std::printf("[  felt    ] %.1f N friction, %.1f kg: separated %.3f N, else %.3f N, ideal device %.3f N\n", friction,
                load, on, off, ideal);
    EXPECT_LT(on - ideal, 0.8 * (off - ideal));
  }
}

TEST(ForceSeparation, TakesNearlyAllOutAtAnyDelayWhereMotorsBalanceWhatWasMeasured) {
  for (const double delay : {0.0, 30.0}) {
    const double ideal = felt_without_device(delay);
    for (const auto& [friction, load] : {std::pair{0.1, 0.0}, std::pair{0.5, 0.0}, std::pair{0.3, 0.1}}) {
      SCOPED_TRACE(std::to_string(friction) + " N, " + std::to_string(load) + " kg, " + std::to_string(delay) + " ms");
      SceneSpec balanced = shared(friction, load, true);
      balanced.seats[1].device.gravity_compensation = balanced.seats[1].device.friction_feedforward = true;
      const double on = felt(balanced, delay, 1), off = felt(shared(friction, load, false), delay, 1);
      std::printf(
          "[  felt    ] %.1f N friction, %.1f kg, %2.0f ms: balanced %.3f N, else %.3f N, ideal device %.3f N\n",
          friction, load, delay, on, off, ideal);
      EXPECT_LT(on - ideal, 0.4 * (off - ideal));
    }
  }
}

/// No passivity is lost: the energy oracle at each hand and all other invariants hold, under the laws that separate.
TEST(ForceSeparation, KeepsAllInvariantsForAnyFrictionLoadAndNetwork) {
  constexpr std::array kSeparating{LawKind::kReplica, LawKind::kSetPosition, LawKind::kPd};
  for (std::uint64_t seed = 1, last = test::seeds(6); seed <= last; ++seed) {
    RandomStream r(seed);
    SceneSpec scene = shipped(seed % 2 == 0 ? "contact" : "guidance");
    choose_law(scene, kSeparating[seed % 3]);
    scene.duration = 8;
    scene.phases.clear();
    for (SeatSpec& seat : scene.seats) {
      seat.device.friction = r.uniform(0.1, 0.5);
      seat.device.load = r.uniform(0, 0.2);
      seat.device.gravity_compensation = r.uniform() < 0.5;
      seat.device.friction_feedforward = r.uniform() < 0.5;
      seat.device.calibrate = seat.force_separation = true;
    }
    const double delay = r.uniform(0, 100);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", law " + std::to_string(static_cast<int>(scene.channel.law)) +
                 ", delay " + std::to_string(delay));
    const RunResult result = run(scene, delayed(delay, r.uniform(0, 20), r.uniform(0, 10)), seed);
    expect_no_breach(result);
    EXPECT_LE(result.hand_speed_max, 1.5);
  }
}

}  // namespace
}  // namespace tandem
