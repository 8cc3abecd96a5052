#include <gtest/gtest.h>

#include "netsim/quality/gap_meter.h"
#include "netsim/quality/pause_tracker.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;

TEST(PauseTracker, FindsTheOldestAndTheNewestResumeInAnInterval) {
  PauseTracker pauses;
  EXPECT_EQ(pauses.first_in(Time::min(), Time{9s}), nullptr);
  for (const Duration at : {1s, 2s, 3s, 4s}) pauses.add({Time{at}, Time{at - 200ms}});
  EXPECT_EQ(pauses.first_in(Time{1s}, Time{3s})->at, Time{2s}) << "after the begin, up to the end";
  EXPECT_EQ(pauses.last_in(Time{1s}, Time{3s})->at, Time{3s});
  EXPECT_EQ(pauses.last_in(Time{1s}, Time{3s})->last_before, Time{2800ms});
  EXPECT_EQ(pauses.first_in(Time::min(), Time{9s})->at, Time{1s});
  EXPECT_EQ(pauses.last_in(Time{4s}, Time{9s}), nullptr);
  EXPECT_EQ(pauses.first_in(Time{2s}, Time{2900ms}), nullptr);
}

TEST(PauseTracker, RemembersTheNewest64) {
  PauseTracker pauses;
  for (int n = 0; n < 100; ++n) pauses.add({Time{n * 1s}, Time{}});
  EXPECT_EQ(pauses.first_in(Time::min(), Time{1h})->at, Time{36s});
  EXPECT_EQ(pauses.last_in(Time::min(), Time{1h})->at, Time{99s});
}

TEST(GapMeter, CountsAGapWhileItLasts) {
  GapMeter gaps;
  const auto sent_until = [](Duration at) {
    GapMeter::Step step;
    step.talked = true;
    step.last_sent = Time{at};
    return step;
  };
  EXPECT_EQ(gaps.close(sent_until(10ms), 1ms).length, 0ms) << "no arrival yet, no gap";
  GapMeter::Step arrival = sent_until(20ms);
  arrival.heard = true;
  arrival.last_heard = Time{15ms};
  arrival.gap = 3ms;
  EXPECT_EQ(gaps.close(arrival, 1ms).length, 5ms) << "longer than the gap that ended";
  const GapMeter::Gap open = gaps.close(sent_until(30ms), 1ms);
  EXPECT_EQ(open.length, 15ms);
  EXPECT_EQ(open.since, Time{15ms});
  EXPECT_EQ(gaps.close({}, 1ms).length, 15ms) << "the sender sends no more: the gap does not grow";
  GapMeter::Step resumed = sent_until(530ms);
  resumed.resumed = true;
  resumed.resume = Time{500ms};
  EXPECT_EQ(gaps.close(resumed, 10ms).length, 20ms) << "due 10 ms after the sender resumed";
}

}  // namespace
}  // namespace tandem::netsim
