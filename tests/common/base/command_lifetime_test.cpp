#include "common/base/command_lifetime.h"

#include <gtest/gtest.h>

namespace tandem {
namespace {

using namespace std::chrono_literals;

TEST(CommandLifetime, IsThreeTicksBetweenFiveAndThirtyMilliseconds) {
  EXPECT_EQ(command_lifetime(10ms), 30ms);  // 100 Hz
  EXPECT_EQ(command_lifetime(5ms), 15ms);
  EXPECT_EQ(command_lifetime(2ms), 6ms);
  EXPECT_EQ(command_lifetime(1ms), 5ms);
  EXPECT_EQ(command_lifetime(100us), 5ms);  // 10 kHz
}

TEST(CommandLifetime, HasACeilingForAnyTick) {
  EXPECT_EQ(command_lifetime(1h), kCommandLifetimeMax);
  EXPECT_EQ(command_lifetime(0ms), kCommandLifetimeMin);
}

}  // namespace
}  // namespace tandem
