#include "client/app/interruptible_wait.h"

#include <gtest/gtest.h>

#include "common/io/event_fd.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

TEST(InterruptibleWait, EndsWithTheConditionTheLimitOrASignal) {
  io::EventFd signal;
  int asked = 0;
  EXPECT_TRUE(wait_unless_interrupted(60s, signal.get(), [&] { return ++asked == 3; }));
  EXPECT_EQ(asked, 3);
  const Time begin = io::monotonic_now();
  EXPECT_TRUE(wait_unless_interrupted(50ms, signal.get(), [] { return false; }));
  EXPECT_GE(io::monotonic_now() - begin, 50ms);
  signal.signal();
  EXPECT_FALSE(wait_unless_interrupted(60s, signal.get(), [] { return false; }));
  EXPECT_TRUE(wait_unless_interrupted(60s, signal.get(), [] { return true; })) << "the condition counts first";
}

}  // namespace
}  // namespace tandem::client
