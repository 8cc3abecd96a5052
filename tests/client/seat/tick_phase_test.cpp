#include "client/seat/tick_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <utility>

#include "common/base/rng.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTick = 1ms;

/// Feeds waits until the first measurement is complete. @return sum of the shifts that follow, and the largest
std::pair<Duration, Duration> shift_after(Duration waited, Duration tick = kTick) {
  TickPhase phase{tick};
  Duration sum{}, largest{};
  for (int n = 0; n < 100; ++n) {
    EXPECT_EQ(phase.next_shift(), Duration{}) << "the measurement is not complete";
    phase.record(waited, tick);
  }
  for (int n = 0; n < 100; ++n) {
    const Duration shift = phase.next_shift();
    sum += shift;
    largest = std::max(largest, std::chrono::abs(shift));
  }
  return {sum, largest};
}

TEST(TickPhase, ShiftsByTheDifferenceToASixthOfATick) {
  // Later from 0.5; from 0, 0.7 and 0.9 the nearest sixth is the other way round.
  EXPECT_NEAR(seconds(shift_after(500us).first) * 1e9, 333'333, 1);
  EXPECT_NEAR(seconds(shift_after(0us).first) * 1e9, -166'667, 1);
  EXPECT_NEAR(seconds(shift_after(700us).first) * 1e9, -466'667, 1);
  EXPECT_NEAR(seconds(shift_after(900us).first) * 1e9, -266'667, 1);
  EXPECT_EQ(shift_after(190us).first, Duration{}) << "within 5 % of a tick";
  EXPECT_NEAR(seconds(shift_after(5ms, 10ms).first) * 1e9, 3'333'333, 1);
}

TEST(TickPhase, ShiftsNoTickByMoreThanOnePercent) {
  EXPECT_EQ(shift_after(600us).second, 10us);
  EXPECT_EQ(shift_after(7ms, 10ms).second, 100us);
}

TEST(TickPhase, CountsOnlyTheRestOfWholeTicks) {
  EXPECT_EQ(shift_after(5700us).first, shift_after(700us).first) << "a seat that does not send at every tick";
}

/// A client and a server whose ticks have one rate but for `drift`, on a network with a delay.
struct Loop {
  Duration offset{};       ///< of the client's first tick to the server's
  Duration delay = 100us;  ///< one way
  Duration jitter{};       ///< of the way to the server, evenly spread
  double drift = 0;        ///< of the client's clock [1]
  std::uint64_t seed = 1;
  int moves_at = 0;         ///< tick from which on the session's turn within the server's tick is later
  Duration moves_by{};      ///< by this; negative: earlier
  Duration kept_waiting{};  ///< mean wait over the last second
  Duration shifted{};       ///< sum of the shifts without their signs
  int away = 0;  ///< ticks after the move until every later STATE waits for a sixth of a tick, within 0.06 ticks

  void run(int ticks) {
    TickPhase phase{kTick};
    RandomStream random{RandomKey{seed}};
    std::deque<std::pair<Time, Duration>> answers;  // arrival, wait
    Time now{offset + 1s};
    double sum = 0;
    int counted = 0;
    for (int n = 0; n < ticks; ++n) {
      while (!answers.empty() && answers.front().first <= now) {
        phase.record(answers.front().second, 2 * delay + answers.front().second);
        answers.pop_front();
      }
      const Time arrives = now + delay + from_seconds(random.uniform() * seconds(jitter));
      const Duration turn = n < moves_at ? Duration{} : moves_by;
      const Duration wait = (kTick - (arrives.time_since_epoch() - turn) % kTick) % kTick;
      if (n >= moves_at && std::abs(seconds(wait) / seconds(kTick) - 1.0 / 6) > 0.06) away = n - moves_at + 1;
      answers.emplace_back(arrives + wait + delay, wait);
      if (n >= ticks - 1000) sum += seconds(wait), ++counted;
      const Duration shift = phase.next_shift();
      shifted += std::chrono::abs(shift);
      now += from_seconds(seconds(kTick) * (1 + drift)) + shift;
    }
    kept_waiting = from_seconds(sum / counted);
  }
};

TEST(TickPhase, ReachesItsWaitFromEveryPhaseAndThenStays) {
  for (int twentieth = 0; twentieth < 20; ++twentieth) {
    Loop loop{.offset = twentieth * 50us};
    loop.run(3000);
    EXPECT_NEAR(seconds(loop.kept_waiting), 1e-3 / 6, 0.05e-3) << twentieth;
    EXPECT_LE(loop.shifted, 550us) << twentieth << ": at most half a tick";
  }
}

TEST(TickPhase, DoesNotOscillateWithALongDelay) {
  for (const Duration delay : {10ms, 100ms, 400ms}) {
    Loop loop{.offset = 430us, .delay = delay};
    loop.run(10'000);
    EXPECT_NEAR(seconds(loop.kept_waiting), 1e-3 / 6, 0.05e-3);
    EXPECT_LE(loop.shifted, 550us);
  }
}

TEST(TickPhase, FollowsTheDifferenceOfTheClocks) {
  for (const double drift : {-200e-6, 200e-6}) {
    Loop loop{.offset = 430us, .drift = drift};
    loop.run(20'000);  // 4 ms apart without shifts
    EXPECT_NEAR(seconds(loop.kept_waiting), 1e-3 / 6, 0.1e-3) << drift;
  }
}

/// Sessions that begin or end move the turns of all sessions after them within the server's tick. A measurement in
/// progress may mix both turns: then a second one, of 100 FORCE again, shifts by the rest.
TEST(TickPhase, ReturnsToItsWaitWithin350TicksOfAMovedTurn) {
  int most = 0;
  for (int part = -10; part <= 10; ++part)
    for (int moves_at = 2000; moves_at < 2100; moves_at += 10) {
      Loop loop{.moves_at = moves_at, .moves_by = part * 50us};
      loop.run(4000);
      EXPECT_NEAR(seconds(loop.kept_waiting), 1e-3 / 6, 0.05e-3) << part;
      EXPECT_LE(loop.away, 350) << part << ", " << moves_at;
      most = std::max(most, loop.away);
    }
  EXPECT_GT(most, 100) << "no turn moved";
}

TEST(TickPhase, WaitsLongerOnAPathWhoseDelayVaries) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Loop loop{.offset = 50us, .jitter = 400us, .seed = seed};  // sigma 115 us
    loop.run(5000);
    EXPECT_NEAR(seconds(loop.kept_waiting), 0.35e-3, 0.08e-3) << seed;
  }
}

TEST(TickPhase, LeavesTheTicksAloneIfTheDelayVariesByAWholeTick) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Loop loop{.jitter = 1ms, .seed = seed};
    loop.run(5000);
    EXPECT_EQ(loop.shifted, Duration{}) << seed;
  }
}

TEST(TickPhase, ForgetsTheServerBefore) {
  TickPhase phase{kTick};
  for (int n = 0; n < 100; ++n) phase.record(700us, kTick);
  phase.restart();
  EXPECT_EQ(phase.next_shift(), Duration{});
}

TEST(TickPhase, SurvivesAnyNumbers) {
  for (const Duration waited : {Duration::max(), Duration::min(), Duration{-1}, Duration{24h}}) {
    TickPhase phase{kTick};
    for (int n = 0; n < 1000; ++n) {
      phase.record(waited, waited);
      EXPECT_LE(std::chrono::abs(phase.next_shift()), 10us);
    }
  }
}

}  // namespace
}  // namespace tandem::client
