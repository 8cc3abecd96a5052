// Motors that are too hot, by hand-made samples.
#include "client/over_temperature.h"

#include <gtest/gtest.h>

#include <limits>

namespace tandem::client {
namespace {

void look(OverTemperature& guard, std::optional<double> heat, int samples = 1, bool active = true) {
  for (int i = 0; i < samples; ++i) guard.look(heat, active);
}

TEST(OverTemperature, TheThirdSampleOnEndLetsGoAndTwoDoNot) {
  OverTemperature guard;
  for (int n = 0; n < 100; ++n) {
    look(guard, 1.0, 2);
    look(guard, 0.99);
  }
  EXPECT_FALSE(guard.holds_off());
  look(guard, 1.0, 2);
  EXPECT_FALSE(guard.holds_off());
  look(guard, 1.0);
  EXPECT_TRUE(guard.holds_off());
  EXPECT_EQ(guard.trips(), 1u);
  look(guard, 5, 10000, false);
  EXPECT_EQ(guard.trips(), 1u) << "once for each time it became hot";
}

TEST(OverTemperature, HoldsOffUntilTheMotorsAreCoolAndNotOnlyLessHot) {
  OverTemperature guard;
  look(guard, 1.2, 3);
  look(guard, 0.9, 1000, false);
  EXPECT_TRUE(guard.holds_off());
  look(guard, 0.899, 1, false);
  EXPECT_FALSE(guard.holds_off());
}

TEST(OverTemperature, TheThirdTimeIsLatchedUntilThePersonsButton) {
  OverTemperature guard;
  for (int n = 0; n < 3; ++n) {
    EXPECT_FALSE(guard.holds_off()) << n;
    look(guard, 1, 3);
    look(guard, 0.5, 100, false);
  }
  EXPECT_FALSE(guard.hot());
  EXPECT_TRUE(guard.latched());
  EXPECT_TRUE(guard.holds_off()) << "cool, and yet";
  guard.reset();
  EXPECT_FALSE(guard.holds_off());
  EXPECT_EQ(guard.all(), 3u);
  look(guard, 1, 3);
  guard.reset();
  EXPECT_TRUE(guard.holds_off()) << "no button cools a motor";
}

TEST(OverTemperature, NothingToldTripsNothingAndWhatIsNoNumberIsHot) {
  OverTemperature guard;
  look(guard, std::nullopt, 10000);
  EXPECT_FALSE(guard.holds_off());
  EXPECT_EQ(guard.all(), 0u);
  for (const double no_number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    look(guard, no_number, 3);
    EXPECT_TRUE(guard.holds_off());
    look(guard, 0.1);
    EXPECT_FALSE(guard.holds_off());
  }
  OverTemperature word;
  look(word, 1, 3);
  EXPECT_TRUE(word.holds_off());
  look(word, std::nullopt);
  EXPECT_FALSE(word.holds_off()) << "a library's word that is not said again";
}

TEST(OverTemperature, FoundHotNobodyWasLetGo) {
  OverTemperature guard;
  look(guard, 1.1, 100, false);
  EXPECT_TRUE(guard.holds_off());
  EXPECT_EQ(guard.trips(), 0u);
}

}  // namespace
}  // namespace tandem::client
