#include "common/base/command_life.h"

#include <gtest/gtest.h>

namespace tandem {
namespace {

using namespace std::chrono_literals;

TEST(CommandLife, IsThreeTicksBetweenFiveAndThirtyMilliseconds) {
  EXPECT_EQ(command_life(10ms), 30ms);  // 100 Hz
  EXPECT_EQ(command_life(5ms), 15ms);
  EXPECT_EQ(command_life(2ms), 6ms);
  EXPECT_EQ(command_life(1ms), 5ms);
  EXPECT_EQ(command_life(100us), 5ms);  // 10 kHz
}

TEST(CommandLife, HasACeilingWhateverTheTick) {
  EXPECT_EQ(command_life(1h), kCommandLifeMax);
  EXPECT_EQ(command_life(0ms), kCommandLifeMin);
}

}  // namespace
}  // namespace tandem
