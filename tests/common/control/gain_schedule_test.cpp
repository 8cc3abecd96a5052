#include "common/control/gain_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"

namespace tandem::control {
namespace {

GainSchedule settled(double age, const GainScheduleParams& p = {}) {
  GainSchedule s(p);
  s.settle(age);
  return s;
}

TEST(GainSchedule, ReducesStiffnessWithTheAge) {
  EXPECT_EQ(settled(0).stiffness(), 1000);
  EXPECT_EQ(settled(0.001).stiffness(), 1000);
  EXPECT_NEAR(settled(0.02).stiffness(), 250, 1e-9);
  EXPECT_NEAR(settled(0.05).stiffness(), 100, 1e-9);
  EXPECT_EQ(settled(0.2).stiffness(), 60);
  EXPECT_EQ(settled(10).stiffness(), 60);
  double last = 1e9;
  for (double d = 0; d <= 10; d = d * 1.05 + 1e-4) {
    const double k = settled(d).stiffness();
    EXPECT_LE(k, last) << d;
    EXPECT_LE(k * d, std::max(5.0, 60 * d) + 1e-12) << d;
    last = k;
  }
}

TEST(GainSchedule, AddsDampingWithStiffnessTimesDelay) {
  EXPECT_EQ(settled(0).damping(), 0);
  EXPECT_NEAR(settled(0.002).damping(), 0.25 * 1000 * 0.002, 1e-12);
  EXPECT_NEAR(settled(0.05).damping(), 1.25, 1e-12);
  EXPECT_LE(settled(10).damping(), 0.25 * 1.5 * 5 + 1e-12);  // stays bounded
}

TEST(GainSchedule, LooksAheadByTheAgeButNotPastItsLimit) {
  const GainSchedule s = settled(0.05);
  EXPECT_EQ(s.lead(0), 0);
  EXPECT_NEAR(s.lead(0.04), 0.04, 1e-15);
  EXPECT_EQ(s.lead(3), 0.1);
  double last = 0;
  for (double age = 0; age < 0.5; age += 0.0005) {
    EXPECT_GE(s.lead(age), last);
    EXPECT_LE(s.lead(age), age);
    last = s.lead(age);
  }
}

TEST(GainSchedule, ChangesNoFasterThanItsSlew) {
  RandomStream random{3};
  const GainScheduleParams p;
  GainSchedule s(p);
  for (int i = 0; i < 20000; ++i) {
    const double before = s.stiffness(), age = i % 500 == 0 ? random.uniform(0, 10) : random.uniform(0, 0.3);
    s.step(age, 0.001);
    ASSERT_LE(s.stiffness() - before, p.k_rise * 0.001 + 1e-9);
    ASSERT_LE(before - s.stiffness(), p.k_fall * 0.001 + 1e-9);
    ASSERT_GE(s.stiffness(), p.k_min - 1e-9);
    ASSERT_LE(s.stiffness(), p.k + 1e-9);
    ASSERT_TRUE(std::isfinite(s.damping()) && s.damping() >= 0);
  }
}

TEST(GainSchedule, FollowsAWorseDelayQuicklyAndABetterOneSlowly) {
  GainSchedule worse(GainScheduleParams{}), better = settled(0.1);
  for (int i = 0; i < 300; ++i) {
    worse.step(0.1, 0.001);
    better.step(0, 0.001);
  }
  EXPECT_GT(worse.delay(), 0.09);
  EXPECT_GT(better.delay(), 0.07);
  for (int i = 0; i < 20000; ++i) better.step(0, 0.001);
  EXPECT_NEAR(better.stiffness(), 1000, 1e-6);
}

TEST(GainSchedule, SettlesAtTheLimitOfItsSteps) {
  for (const double age : {0.0, 0.003, 0.05, 10.0}) {
    GainSchedule s(GainScheduleParams{});
    for (int i = 0; i < 30000; ++i) s.step(age, 0.001);
    EXPECT_NEAR(s.stiffness(), settled(age).stiffness(), 1e-3) << age;
    EXPECT_NEAR(s.delay(), age, 1e-6) << age;
  }
}

TEST(GainSchedule, KeepsAScenesSoftSpringSoft) {
  GainScheduleParams p;
  p.k = 30;  // below k_min
  EXPECT_EQ(settled(0, p).stiffness(), 30);
  EXPECT_EQ(settled(10, p).stiffness(), 30);
}

}  // namespace
}  // namespace tandem::control
