#include "hal/sim/hand.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/alloc_guard.h"

namespace tandem::hal::sim {
namespace {

constexpr double kTick = 1e-3;

HandSpec spec(HandModel model) {
  HandSpec s;
  s.model = model;
  return s;
}

/// Runs a hand whose tip follows it perfectly and sets the session time at every tick.
struct Player {
  Hand hand;
  Vec3 tip;
  double t = 0;
  HandPull pull;
  double jump_x = 0, jump_f = 0;  ///< largest change of intended position and of force from tick to tick
  bool follows = true;

  explicit Player(const HandSpec& s, Vec3 start = Vec3::Zero(), std::shared_ptr<const RecordedMotion> m = nullptr)
      : hand(s, start, std::move(m)), tip(start) {}
  void idle(double duration) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / kTick)); ++i) pull = hand.advance(tip, kTick);
  }
  void play(double until) {
    while (t < until - 0.5 * kTick) {
      const HandPull before = pull;
      hand.set_session_time(t);
      pull = hand.advance(tip, kTick);
      t += kTick;
      if (before.m > 0) {
        jump_x = std::max(jump_x, (pull.x - before.x).norm());
        jump_f = std::max(jump_f, (force(pull) - force(before)).norm());
      }
      if (follows) tip = pull.x;
    }
  }
  [[nodiscard]] Vec3 force(const HandPull& p) const { return p.k * (p.x - tip) + p.b * p.v + p.force; }
};

TEST(Hand, HoldsItsStartUntilTheSessionEngages) {
  Player p(spec(HandModel::kLeader), {0.01, 0, 0});
  p.idle(1.0);
  EXPECT_EQ(p.pull.k, 300);
  EXPECT_EQ(p.pull.b, 10);
  EXPECT_EQ(p.pull.x, Vec3(0.01, 0, 0));
  EXPECT_EQ(p.pull.v, Vec3(0, 0, 0));
  EXPECT_FALSE(p.hand.time().has_value());
}

TEST(Hand, PullsNothingWithModelNone) {
  Player p(spec(HandModel::kNone));
  p.play(1.0);
  EXPECT_EQ(p.pull.k + p.pull.b + p.pull.m, 0.0);
}

TEST(Hand, FollowsTheTrajectoryFromTheStartAsLeader) {
  Player p(spec(HandModel::kLeader));
  p.idle(0.1);
  p.play(3.0);
  EXPECT_EQ(p.pull.k, 1000);
  EXPECT_EQ(p.pull.b, 10);
  EXPECT_EQ(p.pull.m, 0.1);
  EXPECT_LT((p.pull.x - at(Trajectory{}, 3.0 - 0.5 * kTick).x).norm(), 1e-9);
  EXPECT_LT(p.jump_x, 1.9 * 0.05 * 3.2 * kTick) << "never faster than the circle while its radius grows";
}

TEST(Hand, EngagesWithoutAJumpInEveryModel) {
  for (const auto model :
       {HandModel::kLeader, HandModel::kRelaxed, HandModel::kResting, HandModel::kTremor, HandModel::kKeyboard}) {
    SCOPED_TRACE(static_cast<int>(model));
    HandSpec s = spec(model);
    s.trajectory.center = {0.02, 0.0, -0.01};  // not where the device starts
    Player p(s, {-0.01, 0.0, 0.0});
    p.idle(0.1);
    p.play(2.0);
    EXPECT_LT(p.jump_x, 1e-3);
    EXPECT_LT(p.jump_f, 0.5);
  }
}

TEST(Hand, IntendedVelocityIsTheDerivativeAlsoWhileApproaching) {
  for (const double late : {0.0, 7.3}) {
    SCOPED_TRACE(late);
    HandSpec s = spec(HandModel::kLeader);
    s.trajectory.center = {0.02, 0.0, -0.01};
    Player p(s, {-0.01, 0.0, 0.0});
    p.t = late;
    p.play(late + 0.6);  // the impedance is the leader's own by now; the approach continues until 1 s
    for (int i = 0; i < 600; ++i) {
      const HandPull before = p.pull;
      p.play(p.t + kTick);
      EXPECT_LT(((p.pull.x - before.x) / kTick - 0.5 * (p.pull.v + before.v)).norm(), 1e-4);
    }
  }
}

TEST(Hand, EngagesGentlyAfterALateJoin) {
  Player p(spec(HandModel::kLeader));
  p.idle(0.1);
  p.t = 7.3;  // in the middle of a circle
  p.play(9.0);
  EXPECT_LT(p.jump_x, 1e-3);
  EXPECT_LT((p.pull.x - at(Trajectory{}, 9.0 - 0.5 * kTick).x).norm(), 1e-9);
}

TEST(Hand, PrefersAGivenImpedance) {
  HandSpec s = spec(HandModel::kResting);
  s.k = 80, s.b = 3, s.m = 0.3;
  Player p(s);
  p.play(1.0);
  EXPECT_EQ(p.pull.k, 80);
  EXPECT_EQ(p.pull.b, 3);
  EXPECT_EQ(p.pull.m, 0.3);
}

TEST(Hand, RestsWhereItEngaged) {
  Player p(spec(HandModel::kResting));
  p.follows = false;
  p.tip = {0.004, 0, 0};  // sagged to there before
  p.play(2.0);
  EXPECT_EQ(p.pull.k, 50);
  EXPECT_LT((p.pull.x - p.tip).norm(), 1e-12);
}

TEST(Hand, ReleasesAtItsReleaseTime) {
  HandSpec s = spec(HandModel::kLettingGo);
  s.release_at = 2.0;
  s.drags = {-3, 0, 0.5};
  Player p(s);
  p.play(1.999);
  EXPECT_EQ(p.pull.k, 1000);
  EXPECT_EQ(p.pull.force, Vec3::Zero());
  p.play(2.01);
  EXPECT_EQ(p.pull.k, 0);
  EXPECT_EQ(p.pull.b, 0);
  EXPECT_EQ(p.pull.m, 0);
  EXPECT_EQ(p.pull.force, Vec3(-3, 0, 0.5));
}

TEST(Hand, AddsTremorAroundTheTrajectory) {
  HandSpec s = spec(HandModel::kTremor);
  s.trajectory.radius = 0;
  Player p(s);
  p.play(1.0);
  Vec3 low = Vec3::Constant(1), high = Vec3::Constant(-1);
  for (int i = 0; i < 1000; ++i) {
    p.play(p.t + kTick);
    low = low.cwiseMin(p.pull.x);
    high = high.cwiseMax(p.pull.x);
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(high[i], 0.002, 2e-5);
    EXPECT_NEAR(low[i], -0.002, 2e-5);
  }
  EXPECT_GT((p.pull.x.maxCoeff() - p.pull.x.minCoeff()), 1e-4) << "axes shake on different phases";
}

TEST(Hand, MovesOverGentlyAfterRelaxedUntil) {
  HandSpec s = spec(HandModel::kLeader);
  s.from = 2.0;
  s.trajectory.kind = Trajectory::Kind::kWaypoints;
  s.trajectory.waypoints = {{0, {0.05, 0, 0}}};
  Player p(s);
  p.follows = false;
  p.tip = {0.01, 0, 0};  // moved there by the other participants
  p.play(1.9);
  EXPECT_EQ(p.pull.k, 0);
  EXPECT_EQ(p.pull.b, 2);
  EXPECT_EQ(p.pull.v, Vec3(0, 0, 0));
  p.play(2.002);
  EXPECT_LT(p.pull.k * (p.pull.x - p.tip).norm(), 1e-3);
  p.follows = true;
  p.jump_x = 0;  // while k was 0 the intended position had no effect
  p.play(2.6);
  EXPECT_EQ(p.pull.k, 1000);
  EXPECT_NEAR(p.pull.x[0], 0.05, 1e-12);
  EXPECT_LT(p.jump_x, 1.9 * 0.04 / 0.5 * kTick) << "minimum jerk";
}

TEST(Hand, RelaxesAgainFromUntil) {
  HandSpec s = spec(HandModel::kLeader);
  s.until = 2.0;
  s.relaxed_b = 6;
  Player p(s);
  p.play(2.0);
  EXPECT_EQ(p.pull.k, 1000);
  p.play(2.25);
  EXPECT_NEAR(p.pull.k, 500, 10);
  p.play(2.6);
  EXPECT_EQ(p.pull.k, 0);
  EXPECT_EQ(p.pull.b, 6);
  EXPECT_EQ(p.pull.v, Vec3(0, 0, 0));
}

TEST(Hand, FadesDeviationsInAndOut) {
  HandSpec s = spec(HandModel::kRelaxed);
  s.deviations = {{1.0, 1.0, {2.0, 0, 0}}};
  Player p(s);
  p.follows = false;
  p.play(1.0);
  EXPECT_EQ(p.pull.force[0], 0);
  p.play(1.5);
  EXPECT_EQ(p.pull.force[0], 2.0);
  p.play(2.1);
  EXPECT_EQ(p.pull.force[0], 0);
  EXPECT_LT(p.jump_f, 2.0 * 1.9 * kTick / 0.1);
}

TEST(Hand, IgnoresSceneRelaxationForAKeyboard) {
  for (const HandModel model : {HandModel::kKeyboard, HandModel::kRecorded}) {
    HandSpec s = spec(model);
    s.from = 1;
    s.until = 3;
    Player p(s);
    for (const double t : {0.9, 3.6, 20.0}) {
      p.play(t);
      EXPECT_EQ(p.pull.k, impedance_of(model).k) << t << " s";
    }
  }
}

TEST(Hand, KeyboardIsLimitedInSpeed) {
  Player p(spec(HandModel::kKeyboard));
  p.play(1.0);
  p.hand.keyboard()->set({0.03, 0.0, 0.0});
  p.play(1.05);
  EXPECT_NEAR(p.pull.x[0], 0.015, 1e-9);
  EXPECT_NEAR(p.pull.v[0], 0.3, 1e-9);
  p.play(1.2);
  EXPECT_NEAR(p.pull.x[0], 0.03, 1e-12);
  EXPECT_EQ(p.pull.v[0], 0.0);
  p.hand.keyboard()->set({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  p.play(1.3);
  EXPECT_NEAR(p.pull.x[0], 0.03, 1e-12);
}

TEST(Hand, StaysWhereItIsWhenTheSessionEnds) {
  Player p(spec(HandModel::kLeader));
  p.play(3.3);
  const Vec3 here = p.tip;
  p.hand.set_session_time(std::nullopt);
  p.pull = p.hand.advance(p.tip, kTick);
  EXPECT_EQ(p.pull.x, here);
  EXPECT_EQ(p.pull.k, 300);
}

TEST(Hand, KicksNothingUnderAJitteryClock) {
  Player p(spec(HandModel::kLeader));
  p.play(2.0);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    p.t += kTick;
    p.hand.set_session_time(p.t + (i % 7 == 0 ? 0.008 : 0.0));
    const HandPull next = p.hand.advance(p.tip, kTick);
    worst = std::max(worst, (next.x - p.pull.x).norm());
    p.pull = next;
  }
  EXPECT_LT(worst, 2 * 0.05 * 3.2 * kTick);
}

TEST(Hand, RunsWithoutHeap) {
  HandSpec s = spec(HandModel::kTremor);
  s.deviations = {{0.1, 1.0, {1, 0, 0}}};
  Player p(s);
  const test::AllocGuard guard;
  p.play(1.0);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::hal::sim
