// Steps of the wall clock that a server reports.
#include "server/app/monitor/clock_watch.h"

#include <gtest/gtest.h>

namespace tandem::server {
namespace {

using std::chrono::seconds;

constexpr std::int64_t kDay = 86400, kNow = 1'795'750'000;

TEST(ClockWatch, ReportsAStepOnceWithItsDirectionAndSize) {
  ClockWatch watch;
  EXPECT_EQ(watch.update(kNow, Time{seconds(100)}), "") << "the first reading has nothing before it";
  const std::string forward = watch.update(kNow + 365 * kDay + 1, Time{seconds(101)});
  EXPECT_NE(forward.find("was set 365 days forward"), std::string::npos) << forward;
  EXPECT_EQ(watch.update(kNow + 365 * kDay + 2, Time{seconds(102)}), "");
  const std::string back = watch.update(kNow + 365 * kDay + 3 - 3 * 3600, Time{seconds(103)});
  EXPECT_NE(back.find("was set 3 h back"), std::string::npos) << back;
}

TEST(ClockWatch, IsSilentForASuspendedMachineAndForSmallSteps) {
  ClockWatch watch;
  EXPECT_EQ(watch.update(kNow, Time{seconds(100)}), "");
  EXPECT_EQ(watch.update(kNow + 2 * kDay, Time{seconds(100 + 2 * kDay)}), "") << "CLOCK_BOOTTIME counts a suspension";
  EXPECT_EQ(watch.update(kNow + 2 * kDay + 60, Time{seconds(100 + 2 * kDay)}), "") << "60 s are not reported";
  EXPECT_NE(watch.update(kNow + 2 * kDay + 121, Time{seconds(100 + 2 * kDay)}), "") << "61 s are";
}

}  // namespace
}  // namespace tandem::server
