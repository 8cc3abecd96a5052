#include "server/app/process/watchdog_feed.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <atomic>

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

struct Fed {
  std::atomic<std::uint64_t> ticks{0};
  std::atomic<bool> stands{false};
  std::atomic<int> count{0};
  std::atomic<Duration> time{1h};
  WatchdogFeed feed{[this] {
                      if (!stands) ++ticks;
                      return std::vector<std::optional<std::uint64_t>>{ticks};
                    },
                    [this] { ++count; }, [this] { return Time{time.load()}; }};

  /// Waits until the watchdog was fed `more` times, or for some intervals.
  bool fed(int more) {
    const int until = count + more;
    for (int i = 0; i < 200 && count < until; ++i) poll(nullptr, 0, 25);
    return count >= until;
  }
};

TEST(WatchdogFeed, FeedsWhileTheMainLoopWaits) {
  Fed f;
  EXPECT_TRUE(f.fed(3)) << "the main loop has not come round since the start";
}

TEST(WatchdogFeed, FeedsNoMoreWhenTicksStop) {
  Fed f;
  ASSERT_TRUE(f.fed(1));
  f.stands = true;
  poll(nullptr, 0, 300);  // the interval in progress
  const int before = f.count;
  poll(nullptr, 0, 600);
  EXPECT_LE(f.count, before + 1);
  f.stands = false;
  EXPECT_TRUE(f.fed(1));
}

TEST(WatchdogFeed, FeedsNoMoreWhenTheMainLoopIsStuck) {
  Fed f;
  ASSERT_TRUE(f.fed(1));
  f.time = Duration{1h} + WatchdogFeed::kMainLoopMax;
  poll(nullptr, 0, 300);
  const int before = f.count;
  poll(nullptr, 0, 600);
  EXPECT_EQ(f.count, before);
  f.feed.main_loop_ran();
  EXPECT_TRUE(f.fed(1));
}

}  // namespace
}  // namespace tandem::server
