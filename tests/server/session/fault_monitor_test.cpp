// One non-finite result is forgiven, the second within a second is a fault.
#include "server/session/fault_monitor.h"

#include <gtest/gtest.h>

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

TEST(FaultMonitor, ReportsTheSecondNonFiniteResultWithinASecond) {
  const Time t{1h};
  FaultMonitor monitor;
  EXPECT_FALSE(monitor.faulty(t, 0));
  EXPECT_FALSE(monitor.faulty(t, 1)) << "the first result";
  EXPECT_FALSE(monitor.faulty(t + 1ms, 1)) << "no new result";
  EXPECT_FALSE(monitor.faulty(t + 1s, 2)) << "a second later is too late";
  EXPECT_TRUE(monitor.faulty(t + 2s - 1ms, 3));
  EXPECT_TRUE(monitor.faulty(t + 2s, 5)) << "each further one";
}

}  // namespace
}  // namespace tandem::server
