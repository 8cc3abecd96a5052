// The difference of the wall clock and the monotonic clock, read while the thread pauses.
#include "netsim/proxy/app/wall_clock_lead.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace tandem::netsim {
namespace {

constexpr Duration kLead{1'000'000'000};

/// Two clocks, the wall clock kLead ahead. Each reading takes 0.1 us; before reading k the thread pauses for pauses[k].
struct Clocks {
  std::array<Duration, 9> pauses{};
  std::size_t reading = 0;
  Duration time{};

  Duration lead() {
    const auto read = [this] { return time += Duration{100} + pauses.at(reading++); };
    return wall_clock_lead(read, [&] { return kLead + read(); });
  }
};

TEST(WallClockLead, IsReadOnceWithoutAPause) {
  Clocks clocks;
  EXPECT_EQ(clocks.lead(), kLead - Duration{100}) << "the monotonic clock was read 0.1 us later";
  EXPECT_EQ(clocks.reading, 3u);
}

TEST(WallClockLead, IsOfTheShortestAttempt) {
  Clocks clocks;
  clocks.pauses[1] = Duration{5'000};
  clocks.pauses[5] = Duration{3'000};
  clocks.pauses[7] = Duration{600'000};  // the last attempt, distorted most
  EXPECT_EQ(clocks.lead(), kLead - Duration{3'100});
}

TEST(WallClockLead, NeverMakesAnArrivalEarlier) {
  for (std::size_t paused = 0; paused < 3; ++paused) {
    Clocks clocks;
    for (std::size_t attempt = 0; attempt < 3; ++attempt) clocks.pauses[3 * attempt + paused] = Duration{600'000};
    EXPECT_LE(clocks.lead(), kLead) << "a pause before reading " << paused;
  }
}

}  // namespace
}  // namespace tandem::netsim
