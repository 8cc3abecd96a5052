#include "client/diagnostics/read_pace.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "common/base/rng.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kPeriod = 17ms, kLongest = 50ms;

Time at(Duration d) { return Time{1h} + d; }

/// Result of a reader in virtual time.
struct Reading {
  double delay_ms = 0, delay_max_ms = 0;  ///< from arrival to look: mean, largest
  std::size_t read = 0;
  std::size_t woken = 0;  ///< datagrams for which the sender had to wake the reader
  std::size_t looks = 0;
};

/// Reads ascending arrivals as the gateway's thread does. The first `warm` of them do not count.
Reading read(const std::vector<Time>& arrivals, std::size_t warm = 0) {
  ReadPace pace(kPeriod, kLongest);
  Reading result;
  Time now = arrivals.front() - 30ms;
  for (std::size_t next = 0; next < arrivals.size();) {
    const ReadPace::Wait wait = pace.wait(now);
    Time look = now + wait.longest;
    const bool woken = wait.for_datagram && arrivals[next] <= look;
    if (woken) look = std::max(now, arrivals[next]);
    const bool sender_pays = woken && arrivals[next] > now;
    now = look;
    if (next >= warm) {
      ++result.looks;
      result.woken += sender_pays;
    }
    std::size_t count = 0;
    for (; next < arrivals.size() && arrivals[next] <= now; ++next, ++count) {
      if (next < warm) continue;
      const double delay = 1e3 * seconds(now - arrivals[next]);
      result.delay_ms += delay;
      result.delay_max_ms = std::max(result.delay_max_ms, delay);
      ++result.read;
    }
    if (count > 0) pace.on_arrival(arrivals[next - 1]);
  }
  result.delay_ms /= static_cast<double>(result.read);
  return result;
}

/// Returns `count` arrivals of a sender whose clock runs at `rate`, each later than sent by a draw of `late`.
template <class Late>
std::vector<Time> stream(std::size_t count, double rate, Late late) {
  std::vector<Time> all;
  Time last{};
  for (std::size_t k = 0; k < count; ++k) {
    last = std::max(last, at(from_seconds(seconds(kPeriod) * static_cast<double>(k) / rate) + late(k)));
    all.push_back(last);
  }
  return all;
}

TEST(ReadPace, WaitsInTheSocketUntilADatagramCame) {
  const ReadPace pace(kPeriod, kLongest);
  EXPECT_TRUE(pace.wait(at(0s)).for_datagram);
  EXPECT_EQ(pace.wait(at(0s)).longest, kLongest);
}

TEST(ReadPace, SleepsUntilJustAfterTheNextIsDueThenLooksAgainThenWaitsInTheSocket) {
  ReadPace pace(kPeriod, kLongest);
  pace.on_arrival(at(0ms));
  EXPECT_EQ(pace.wait(at(1ms)).longest, 16ms + ReadPace::kGuard);
  EXPECT_FALSE(pace.wait(at(1ms)).for_datagram);
  const Time due = at(kPeriod + ReadPace::kGuard);
  EXPECT_EQ(pace.wait(due).longest, ReadPace::kAgain);
  EXPECT_FALSE(pace.wait(due).for_datagram);
  EXPECT_FALSE(pace.wait(due + ReadPace::kPatience - 1ns).for_datagram);
  EXPECT_TRUE(pace.wait(due + ReadPace::kPatience).for_datagram);
  EXPECT_EQ(pace.wait(due + ReadPace::kPatience).longest, kLongest);
}

TEST(ReadPace, FollowsAnEarlyDatagramAtOnceAndALateOneByAnEighth) {
  ReadPace pace(kPeriod, kLongest);
  pace.on_arrival(at(0ms));
  pace.on_arrival(at(17ms + 800us));  // predicted for 17 ms
  EXPECT_EQ(pace.wait(at(20ms)).longest, 34ms + 100us + ReadPace::kGuard - 20ms);
  pace.on_arrival(at(33ms));  // 1.1 ms early
  EXPECT_EQ(pace.wait(at(40ms)).longest, 50ms + ReadPace::kGuard - 40ms);
}

TEST(ReadPace, KeepsItsPredictionOverLostDatagrams) {
  ReadPace pace(kPeriod, kLongest);
  pace.on_arrival(at(0ms));
  pace.on_arrival(at(5 * kPeriod + 80us));
  EXPECT_EQ(pace.wait(at(5 * kPeriod + 1ms)).longest, kPeriod + 10us + ReadPace::kGuard - 1ms);
}

TEST(ReadPace, ForgetsArrivalsWithoutATime) {
  ReadPace pace(kPeriod, kLongest);
  pace.on_arrival(at(0ms));
  pace.restart();
  EXPECT_TRUE(pace.wait(at(1ms)).for_datagram);
}

TEST(ReadPace, NeverSleepsLongerThanAsked) {
  ReadPace pace(100ms, kLongest);
  pace.on_arrival(at(0ms));
  EXPECT_EQ(pace.wait(at(1ms)).longest, kLongest);
}

TEST(ReadPace, SparesASenderOfTheSameComputerItsWakeUps) {
  // Late by 0 to 0.2 ms; one in 50 by up to 3 ms more, as on a busy machine.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    const Reading r = read(stream(2000, 1.0,
                                  [&](std::size_t) {
                                    const double late = random.uniform(0, 2e-4);
                                    const bool busy = random.uniform() < 0.02;
                                    return from_seconds(late + random.uniform(0, busy ? 3e-3 : 0));
                                  }),
                           20);
    EXPECT_LE(r.delay_ms, 0.5);
    EXPECT_LE(r.delay_max_ms, 1.5);
    EXPECT_LE(r.woken, 2U);
    EXPECT_LE(r.looks, r.read * 11 / 10);
  }
}

TEST(ReadPace, FollowsTheDriftOfTheSendersClock) {
  for (const double rate : {0.9995, 0.9999, 1.0001, 1.0005}) {
    SCOPED_TRACE(rate);
    const Reading r = read(stream(5000, rate, [](std::size_t) { return 0us; }), 20);
    EXPECT_LE(r.delay_ms, 0.35);
    EXPECT_LE(r.delay_max_ms, 0.35);
    EXPECT_EQ(r.woken, 0U);
  }
}

TEST(ReadPace, DelaysADatagramOfAJitteringNetworkByLessThanAMillisecondOnAverage) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    const Reading r = read(stream(2000, 1.0, [&](std::size_t) { return from_seconds(random.uniform(0, 5e-3)); }), 20);
    EXPECT_LE(r.delay_ms, 1.0);
  }
}

TEST(ReadPace, SeesTheFirstDatagramAfterAGapAtOnce) {
  std::vector<Time> arrivals = stream(50, 1.0, [](std::size_t) { return 0us; });
  const Time back = arrivals.back() + 4s + 5ms;
  arrivals.push_back(back);
  const Reading r = read(arrivals, 50);
  EXPECT_EQ(r.read, 1U);
  EXPECT_EQ(r.delay_max_ms, 0.0);
}

TEST(ReadPace, FindsTheNewTimesOfASenderThatStoodStill) {
  // From the 100th on, all come 8 ms later. The 60 after it do not count.
  const Reading r = read(stream(300, 1.0, [](std::size_t k) { return k < 100 ? 0ms : 8ms; }), 160);
  EXPECT_LE(r.delay_max_ms, 0.35);
  EXPECT_EQ(r.woken, 0U);
}

TEST(ReadPace, ReadsAStreamOfEveryTickOncePerPeriodWithNewValues) {
  std::vector<Time> ticks;
  for (int k = 0; k < 10000; ++k) ticks.push_back(at(k * 1ms));
  const Reading r = read(ticks, 100);
  EXPECT_EQ(r.woken, 0U);
  EXPECT_LE(r.looks, r.read / 15);
}

}  // namespace
}  // namespace tandem::client
