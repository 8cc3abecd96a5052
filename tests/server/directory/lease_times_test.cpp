#include "server/directory/lease_times.h"

#include <gtest/gtest.h>

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;

TEST(LeaseTimes, DefaultsHoldAfterTwoThirds) {
  const LeaseTimes times;
  EXPECT_FALSE(times.problem());
  EXPECT_EQ(3 * times.hold_after, 2 * times.ttl);
}

TEST(LeaseTimes, EveryTimeThatCouldGiveTwoOwnersIsNamed) {
  const auto problem = [](auto change) {
    LeaseTimes times;
    change(times);
    return times.problem().value_or("");
  };
  // 3 s x 0.95 / 1.05 - 0.2 s = 2.514 s
  EXPECT_EQ(problem([](LeaseTimes& t) { t.hold_after = 2510ms; }), "");
  EXPECT_NE(problem([](LeaseTimes& t) { t.hold_after = 2520ms; }).find("hold_after: 2.52 s is more than 2.51"),
            std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.ramp = 800ms; }).find("hold_after"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.ramp = 0s; }).find("ramp: 0 s"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.ttl = 2500ms; }).find("ttl: 2.5 s"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.ttl = 1s; }).find("ttl"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.renew_every = 1s; }).find("renew_every"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.answer_limit = 4s; }).find("answer_limit"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.drift = 0.2; }).find("drift"), std::string::npos);
  EXPECT_NE(problem([](LeaseTimes& t) { t.drift = std::numeric_limits<double>::quiet_NaN(); }).find("drift"),
            std::string::npos);
}

}  // namespace
}  // namespace tandem::directory
