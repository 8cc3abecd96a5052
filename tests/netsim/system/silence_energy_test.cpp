// The bound of the energy that a motor gives after the last fresh datagram. All numbers can be computed by hand: 3.3 N
// on a hand that moves along at 1.35 m/s are 4.455 W, which is 8.91 mJ per tick of 2 ms.
#include "netsim/system/silence_energy.h"

#include <gtest/gtest.h>

namespace tandem::netsim {
namespace {

constexpr SilenceEnergy::Bound kBound{.tank = 0.020, .step_max = 0.006};
constexpr double kPower = 3.3 * 1.35;  // [W]

/// A program that has woken up in time so far, and received a fresh datagram at its last wake-up.
SilenceEnergy fresh_and_in_time() {
  SilenceEnergy energy;
  EXPECT_TRUE(energy.wake_up(0.002, kBound));
  energy.restart();
  return energy;
}

bool step(SilenceEnergy& energy, double length, double power = kPower) {
  energy.add(length * power);
  return energy.wake_up(length, kBound);
}

TEST(SilenceEnergy, AllowsTheTankAndOneMillijouleInSilence) {
  for (const double more : {-1e-6, 1e-6}) {
    SilenceEnergy energy = fresh_and_in_time();
    EXPECT_TRUE(step(energy, 0.002));
    EXPECT_TRUE(step(energy, 0.002)) << "17.82 mJ";
    energy.add(0.021 - 0.01782 + more);
    EXPECT_EQ(energy.wake_up(0.002, kBound), more < 0);
  }
}

TEST(SilenceEnergy, AllowsWhatAnEffortGivesWhileTheProgramSleepsAfterAFreshDatagram) {
  SilenceEnergy energy = fresh_and_in_time();
  EXPECT_TRUE(step(energy, 0.006)) << "26.73 mJ: no program could limit them";
  SilenceEnergy braking = energy, pushing = energy;
  EXPECT_TRUE(step(braking, 0.002, -kPower));
  EXPECT_FALSE(step(pushing, 0.002)) << "the tank is empty";
  energy.restart();
  EXPECT_TRUE(step(energy, 0.006)) << "the next fresh datagram permits the same again";
}

TEST(SilenceEnergy, ReportsAStepThatTheGateHadToPredict) {
  SilenceEnergy energy = fresh_and_in_time();
  EXPECT_TRUE(step(energy, 0.006, 0)) << "the gate knows such steps now";
  energy.restart();
  EXPECT_TRUE(step(energy, 0.002));
  EXPECT_FALSE(step(energy, 0.005)) << "31.2 mJ of 20: in silence, and shorter than the longest recent step";
}

TEST(SilenceEnergy, AllowsALongerStepThanAnyRecentOne) {
  SilenceEnergy energy = fresh_and_in_time();
  EXPECT_TRUE(step(energy, 0.002));
  EXPECT_TRUE(step(energy, 0.005)) << "31.2 mJ: the gate counted on 2 ms";
  EXPECT_FALSE(step(energy, 0.002)) << "but its tank is empty now";
}

TEST(SilenceEnergy, ExpectsTheGateToForgetALongStepWithinSeconds) {
  SilenceEnergy energy = fresh_and_in_time();
  EXPECT_TRUE(step(energy, 0.006, 0));
  for (int i = 0; i < 1500; ++i) EXPECT_TRUE(step(energy, 0.002, 0));
  energy.restart();
  EXPECT_TRUE(step(energy, 0.002));
  EXPECT_TRUE(step(energy, 0.005)) << "the gate counts on 2 ms again";
}

TEST(SilenceEnergy, DoesNotTakeARoundingErrorForALongerStep) {
  SilenceEnergy energy = fresh_and_in_time();
  EXPECT_TRUE(step(energy, 0.002));
  EXPECT_TRUE(step(energy, 0.002000001));
  EXPECT_FALSE(step(energy, 0.002000002));
}

}  // namespace
}  // namespace tandem::netsim
