#include "hal/sim/sim_device.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "common/base/rng.h"
#include "hal/core/port_map.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal::sim {
namespace {

using namespace std::chrono_literals;

std::unique_ptr<SimDevice> made(const SimSetup& setup) {
  auto d = SimDevice::make(setup);
  EXPECT_TRUE(d.has_value()) << (d ? "" : d.error().message);
  return d ? std::move(*d) : nullptr;
}
SimSetup free_device() { return {}; }
SimSetup held(HandModel model) {
  SimSetup s;
  s.hand.model = model;
  return s;
}
/// Returns a command with a force at the tip and a late expiry.
Command push(const State& state, const Vec3& force) {
  Command c;
  c.seq = state.seq + 1;
  c.kind = CommandKind::kJointEffort;
  c.expires = state.sampled_at + 1h;
  c.effort = PortMap(PortSpace::kTip, 3, 3).joint_effort(state, {force[0], force[1], force[2]});
  return c;
}
void run(SimDevice& d, const Vec3& force, double duration) {
  for (int i = 0; i < static_cast<int>(std::lround(duration * 1000)); ++i) d.advance(push(d.state(), force), 1ms);
}

TEST(SimDevice, DeclaresWhatItIs) {
  const auto touch = made(free_device());
  EXPECT_EQ(touch->caps().joints, 3u);
  EXPECT_TRUE(touch->caps().simulated);
  EXPECT_EQ(touch->caps().gravity, GravityCompensation::kHost);
  EXPECT_EQ(touch->caps().damping, 0.2);
  EXPECT_EQ(touch->caps().latency, 0);
  EXPECT_EQ(touch->caps().axis[2].peak, 3.3);
  EXPECT_GT(*touch->caps().mass, 0.02);
  EXPECT_LT(*touch->caps().mass, 0.2);
  SimSetup s;
  s.device.model = DeviceModel::kLinear;
  const auto linear = made(s);
  EXPECT_EQ(linear->caps().tip_axes, 1u);
  EXPECT_TRUE(linear->caps().prismatic);
  EXPECT_EQ(linear->caps().mass, 0.1);
  EXPECT_FALSE(linear->caps().axis[1].peak.has_value());
}

TEST(SimDevice, RejectsInvalidParametersWithAReason) {
  SimSetup s;
  s.device.start = {0.4, 0, 0};
  EXPECT_NE(SimDevice::make(s).error().message.find("out of reach"), std::string::npos);
  s = {};
  s.device.friction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(SimDevice::make(s).error().message.find("friction"), std::string::npos);
  s = {};
  s.hand.model = HandModel::kRecorded;
  EXPECT_NE(SimDevice::make(s).error().message.find("recording"), std::string::npos);
}

TEST(SimDevice, RestIsExactlyZero) {
  const auto d = made(held(HandModel::kRelaxed));
  run(*d, {1, 0, 0}, 0.1);
  run(*d, Vec3::Zero(), 20.0);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_TRUE(d->state().dq[j] == 0.0 || std::isnormal(d->state().dq[j])) << "denormal numbers are slow";
    EXPECT_TRUE(d->ground_truth().dq[j] == 0.0 || std::isnormal(d->ground_truth().dq[j]));
  }
}

TEST(SimDevice, QuantisesItsEncoders) {
  const auto d = made(held(HandModel::kLeader));
  d->set_session_time(0.0);
  for (int i = 0; i < 2000; ++i) {
    d->advance({}, 1ms);
    for (std::size_t j = 0; j < 3; ++j) {
      const double counts = d->state().q[j] / 4.1e-4;
      ASSERT_NEAR(counts, std::round(counts), 1e-6);
      ASSERT_LE(std::abs(d->state().q[j] - d->ground_truth().q[j]), 2.1e-4);
    }
    ASSERT_LT((d->state().x - d->ground_truth().x).norm(), 1e-4);
  }
  EXPECT_LT((d->state().dx - d->ground_truth().dx).norm(), 0.04) << "estimate lags 4 ms and ripples by a count";
}

TEST(SimDevice, WithoutEncoderItReportsTheTruth) {
  SimSetup s = held(HandModel::kLeader);
  s.device.encoder = 0;
  const auto d = made(s);
  d->set_session_time(0.0);
  for (int i = 0; i < 500; ++i) d->advance({}, 1ms);
  EXPECT_EQ(d->state().q, d->ground_truth().q);
  EXPECT_LT((d->state().dx - d->ground_truth().dx).norm(), 1e-12);
}

TEST(SimDevice, GravityCompensationHoldsTheTip) {
  SimSetup s;
  const auto with = made(s);
  s.device.gravity_compensation = false;
  const auto without = made(s);
  run(*with, Vec3::Zero(), 2.0);
  run(*without, Vec3::Zero(), 2.0);
  EXPECT_LT(with->ground_truth().x.norm(), 1e-3);
  EXPECT_LT(without->ground_truth().x[2], -0.02);
  EXPECT_EQ(with->state().f_out, Vec3(0, 0, 0)) << "compensation is not a coupling force";
}

TEST(SimDevice, LimitsTheTipForceKeepingItsDirection) {
  const auto d = made(held(HandModel::kLeader));
  d->advance(push(d->state(), {30, 0, 40}), 1ms);
  EXPECT_NEAR(d->state().f_out.norm(), 3.3, 1e-9);
  EXPECT_NEAR(d->state().f_out[2] / d->state().f_out[0], 4.0 / 3.0, 1e-9);
  EXPECT_TRUE(d->state().saturated);
  EXPECT_EQ(d->counts().saturated, 1u);
  d->advance(push(d->state(), {1, 0, 0}), 1ms);
  EXPECT_NEAR(d->state().f_out[0], 1.0, 1e-9);
  EXPECT_FALSE(d->state().saturated);
}

TEST(SimDevice, DropsACommandWhenItExpires) {
  const auto d = made(held(HandModel::kLeader));
  Command c = push(d->state(), {1, 0, 0});
  c.expires = Time{} + 2500us;
  d->advance(c, 1ms);
  EXPECT_NEAR(d->state().f_out[0], 1.0, 1e-9);
  EXPECT_EQ(d->state().echo_command, c.seq);
  d->advance(c, 1ms);
  d->advance(c, 1ms);
  EXPECT_NEAR(d->state().f_out[0], 0.5, 1e-2) << "mean of a half dead period";
  EXPECT_EQ(d->counts().expired, 1u);
  d->advance(c, 1ms);
  EXPECT_EQ(d->state().f_out[0], 0.0);
  EXPECT_EQ(d->state().echo_command, 0u);
  EXPECT_EQ(d->counts().expired, 2u);
  EXPECT_EQ(d->state().sampled_at, Time{} + 4ms);
}

TEST(SimDevice, HasTheStiffnessOfTheHandAtTheTip) {
  SimSetup s = held(HandModel::kLeader);
  s.device.friction = 0;
  s.hand.trajectory.radius = 0;
  const auto d = made(s);
  d->set_session_time(0.0);
  run(*d, {1.0, 0, 0}, 3.0);
  EXPECT_NEAR(d->ground_truth().x[0], 1e-3, 3e-5);
  EXPECT_NEAR(d->ground_truth().f_hand[0], -1.0, 0.02);
}

TEST(SimDevice, FrictionFeedforwardHelpsAndStaysStable) {
  const auto moved = [](bool feedforward, const Vec3& force, double duration) {
    SimSetup s;
    s.device.friction = 0.26;
    s.device.friction_feedforward = feedforward;
    s.device.force_peak = 3.3;
    const auto d = made(s);
    run(*d, force, duration);
    const double far = d->ground_truth().x.norm();
    run(*d, Vec3::Zero(), 2.0);
    EXPECT_LT(d->ground_truth().dx.norm(), 1e-3) << "comes to rest by itself";
    return far;
  };
  EXPECT_GT(moved(true, {0.32, 0, 0}, 0.15), 1.5 * moved(false, {0.32, 0, 0}, 0.15));
  EXPECT_LT(moved(true, {0, 0, 0}, 3.0), 2e-4) << "encoder noise alone moves nothing";
}

TEST(SimDevice, SlaveFeelsItsWall) {
  SimSetup s;
  s.device.friction = 0;
  s.environment.wall = WallSpec{0, 0.0, 2e4, 5, true};
  const auto d = made(s);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 x = d->ground_truth().x;
    d->advance(push(d->state(), Vec3(2.0, -100 * x[1], -100 * x[2])), 1ms);
  }
  EXPECT_NEAR(d->ground_truth().f_environment[0], -2.0, 0.02);
  EXPECT_NEAR(d->ground_truth().penetration, 1e-4, 2e-6);
  EXPECT_EQ(d->state().f_env, d->ground_truth().f_environment);
  EXPECT_EQ(d->state().penetration, d->ground_truth().penetration);
}

TEST(SimDevice, IsTotal) {
  const double values[] = {5e-324, 1e300, std::numeric_limits<double>::max(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()};
  for (const auto model : {DeviceModel::kTouch, DeviceModel::kLinear}) {
    for (const double v : values) {
      SimSetup s = held(HandModel::kRelaxed);
      s.device.model = model;
      const auto d = made(s);
      for (int i = 0; i < 100; ++i) {
        Command c;
        c.kind = CommandKind::kJointEffort;
        c.expires = Time::max();
        c.effort.fill(i % 2 == 0 ? v : -v);
        d->advance(c, 1ms);
        ASSERT_TRUE(d->state().x.allFinite() && d->state().dx.allFinite() && d->state().f_out.allFinite()) << v;
        ASSERT_LE(d->state().f_out.norm(), 3.3 + 1e-9);
      }
      EXPECT_EQ(d->counts().rejected, std::isfinite(v) ? 0u : 100u);
    }
  }
  const auto d = made(free_device());
  d->advance({}, Duration::min());
  d->advance({}, 0ns);
  EXPECT_EQ(d->counts().ticks, 0u);
  d->advance({}, 24h);
  EXPECT_EQ(d->state().sampled_at, Time{} + 1s);
}

TEST(SimDevice, SameInputSameTrace) {
  const auto trace = [] {
    const auto d = made(held(HandModel::kTremor));
    RandomStream r(3);
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
      d->set_session_time(i * 1e-3);
      d->advance(push(d->state(), {r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-3, 3)}), 1ms);
      sum = 0.99 * sum + d->state().x.sum();
    }
    return sum;
  };
  EXPECT_EQ(trace(), trace());
}

TEST(SimDevice, AdvancesWithoutHeap) {
  for (const auto model : {DeviceModel::kTouch, DeviceModel::kLinear}) {
    SimSetup s = held(HandModel::kTremor);
    s.device.model = model;
    s.device.friction_feedforward = true;
    s.environment.wall = WallSpec{};
    s.environment.tissue = TissueSpec{};
    const auto d = made(s);
    const test::AllocGuard guard;
    for (int i = 0; i < 500; ++i) {
      d->set_session_time(i * 1e-3);
      d->advance(push(d->state(), {1, 2, 3}), 1ms);
    }
    EXPECT_EQ(guard.count(), 0u);
  }
}

TEST(SimDevice, PrintsWhatATickCosts) {
  SimSetup wall = free_device();
  wall.environment.wall = WallSpec{};
  SimSetup linear = held(HandModel::kLeader);
  linear.device.model = DeviceModel::kLinear;
  struct Case {
    const char* name;
    SimSetup setup;
  };
  for (const Case& c :
       {Case{"Touch, leader", held(HandModel::kLeader)}, Case{"Touch, relaxed", held(HandModel::kRelaxed)},
        Case{"Touch, slave with wall", wall}, Case{"one axis, leader", linear}}) {
    const auto d = made(c.setup);
    constexpr int kTicks = 20000;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kTicks; ++i) {
      d->set_session_time(i * 1e-3);
      d->advance(push(d->state(), {0.5, 0, 0}), 1ms);
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    std::printf("[ bench    ] SimDevice, 1 ms, %s: %.0f ns\n", c.name, spent.count() / kTicks);
    EXPECT_TRUE(d->state().x.allFinite());
  }
}

}  // namespace
}  // namespace tandem::hal::sim
