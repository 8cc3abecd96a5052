// Detects motors that are too hot, from synthetic samples.
#include "common/control/overtemperature_guard.h"

#include <gtest/gtest.h>

#include <limits>

namespace tandem::control {
namespace {

void look(OvertemperatureGuard& guard, std::optional<double> heat, int samples = 1, bool active = true) {
  for (int i = 0; i < samples; ++i) guard.update(heat, active);
}

TEST(OvertemperatureGuard, TripsAtTheThirdConsecutiveSample) {
  OvertemperatureGuard guard;
  for (int n = 0; n < 100; ++n) {
    look(guard, 1.0, 2);
    look(guard, 0.99);
  }
  EXPECT_FALSE(guard.inhibits());
  look(guard, 1.0, 2);
  EXPECT_FALSE(guard.inhibits());
  look(guard, 1.0);
  EXPECT_TRUE(guard.inhibits());
  EXPECT_EQ(guard.trips(), 1u);
  look(guard, 5, 10000, false);
  EXPECT_EQ(guard.trips(), 1u) << "once for each time it became hot";
}

TEST(OvertemperatureGuard, InhibitsUntilTheMotorsAreBelowTheLowerLimit) {
  OvertemperatureGuard guard;
  look(guard, 1.2, 3);
  look(guard, 0.9, 1000, false);
  EXPECT_TRUE(guard.inhibits());
  look(guard, 0.899, 1, false);
  EXPECT_FALSE(guard.inhibits());
}

TEST(OvertemperatureGuard, LatchesAtTheThirdTripUntilTheButton) {
  OvertemperatureGuard guard;
  for (int n = 0; n < 3; ++n) {
    EXPECT_FALSE(guard.inhibits()) << n;
    look(guard, 1, 3);
    look(guard, 0.5, 100, false);
  }
  EXPECT_FALSE(guard.hot());
  EXPECT_TRUE(guard.latched());
  EXPECT_TRUE(guard.inhibits()) << "cool, and yet";
  guard.reset();
  EXPECT_FALSE(guard.inhibits());
  EXPECT_EQ(guard.trips_total(), 3u);
  look(guard, 1, 3);
  guard.reset();
  EXPECT_TRUE(guard.inhibits()) << "no button cools a motor";
}

TEST(OvertemperatureGuard, IgnoresAMissingReadingAndTreatsNanAsHot) {
  OvertemperatureGuard guard;
  look(guard, std::nullopt, 10000);
  EXPECT_FALSE(guard.inhibits());
  EXPECT_EQ(guard.trips_total(), 0u);
  for (const double no_number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    look(guard, no_number, 3);
    EXPECT_TRUE(guard.inhibits());
    look(guard, 0.1);
    EXPECT_FALSE(guard.inhibits());
  }
  OvertemperatureGuard word;
  look(word, 1, 3);
  EXPECT_TRUE(word.inhibits());
  look(word, std::nullopt);
  EXPECT_FALSE(word.inhibits()) << "a library's word that is not said again";
}

TEST(OvertemperatureGuard, CountsNoTripWhileNoForceIsGiven) {
  OvertemperatureGuard guard;
  look(guard, 1.1, 100, false);
  EXPECT_TRUE(guard.inhibits());
  EXPECT_EQ(guard.trips(), 0u);
}

}  // namespace
}  // namespace tandem::control
