// Rows of the validation matrix about rate, queues and the independence of random streams.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "netsim/engine/network.h"
#include "netsim/engine/replay.h"
#include "netsim/models/link_rate.h"
#include "netsim/profiles/decision_csv.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/models/random_spec.h"
#include "tests/netsim/support.h"
#include "tests/netsim/validation/statistics.h"

namespace tandem::netsim {
namespace {

using namespace test;
__extension__ using Wide = unsigned __int128;

TEST(Matrix, SerialisationIsExactOverAMillionDatagrams) {
  RandomStream random{17};
  for (std::uint64_t round = 1, last = tandem::test::seeds(4); round <= last; ++round) {
    const std::uint64_t rate = 100'000 + random.below(10'000'000'000), size = random.below(1473),
                        overhead = random.below(60);
    SCOPED_TRACE(::testing::Message() << rate << " bit/s, " << size << " + " << overhead << " bytes, round " << round);
    LinkRate link{{.bits_per_s = rate, .overhead_bytes = static_cast<std::uint32_t>(overhead)}};
    const std::uint64_t bits = 8 * (size + overhead);
    for (std::uint64_t i = 1; i <= 1'000'000; ++i) {
      const Wide exact =
          (Wide{i} * bits * 1'000'000'000 + rate - 1) / rate;  // [ns], rounded up once, not a million times
      if (exact >= 3'600'000'000'000) break;                   // no datagram waits longer than an hour
      const auto sent = link.serve(Time{}, size);
      ASSERT_TRUE(sent) << i;
      ASSERT_EQ(static_cast<std::uint64_t>(sent->time_since_epoch().count()), static_cast<std::uint64_t>(exact)) << i;
    }
  }
}

/// Two datagrams of 160 bytes (overhead included) every millisecond at 1.28 Mbit/s, which sends one in exactly 1 ms.
/// Before the two of millisecond t, the queue holds t datagrams, a wait of t ms.
std::size_t first_drop(RateSpec rate) {
  rate.bits_per_s = 1'280'000;
  PathSpec spec;
  spec.rate = rate;
  Path path = path_of(spec);
  for (std::size_t i = 0; i < 10'000; ++i)
    if (path.send(Time{1ms * static_cast<std::int64_t>(i / 2)}, 132).outcome == Outcome::kQueueFull) return i;
  return 0;
}

TEST(Matrix, DropsFirstAtTheComputedDatagram) {
  EXPECT_EQ(first_drop({}), 0U);  // no limit, no drop
  EXPECT_EQ(first_drop({.queue_datagrams = 100}),
            199U);  // at 99 ms 99 wait: the first is the 100th, the second exceeds the limit
  EXPECT_EQ(first_drop({.queue_bytes = 100 * 160}), 199U);      // the same in bytes
  EXPECT_EQ(first_drop({.queue_bytes = 100 * 160 - 1}), 197U);  // at 98 ms the second exceeds the limit
  EXPECT_EQ(first_drop({.queue_wait = 100ms}), 201U);           // at 100 ms the second would wait 101 ms
  EXPECT_EQ(first_drop({.queue_wait = 101ms - 1ns}), 201U);
  EXPECT_EQ(first_drop({.queue_wait = 101ms}), 203U);
}

TEST(Matrix, ExcludesDatagramsUnderWayFromTheQueue) {
  for (const RateSpec& limit :
       {RateSpec{.queue_datagrams = 100}, RateSpec{.queue_bytes = 100 * 156}, RateSpec{.queue_wait = 100ms}}) {
    PathSpec spec;
    spec.rate = limit;
    spec.rate.bits_per_s = 2'000'000;
    spec.floor = 5s;  // 5000 in flight at 1 kHz
    EXPECT_EQ(count_of(decisions(path_of(spec), 20'000), Outcome::kDeliver), 20'000U);
  }
}

/// Returns +1 or -1 for each decision of each purpose, direction and flow with all models enabled; each is a fair coin.
std::map<std::string, std::vector<double>> coins(std::uint64_t seed, std::size_t n) {
  std::map<std::string, std::vector<double>> all;
  for (const std::uint64_t link : {0U, 1U}) {
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      const std::string who = std::to_string(link) + " " + name(direction) + " ";
      const RandomKey key = Path::key_for(seed, link, direction);
      const auto stream = [&](const std::string& purpose, const PathSpec& spec, const auto& outcome) {
        Path path{spec, key};
        auto& bits = all[who + purpose];
        bits.reserve(n);
        for (std::size_t i = 0; i < n; ++i) bits.push_back(outcome(path.send(Time{}, kSize)) ? 1 : -1);
      };
      PathSpec loss, copy, damage, reorder, body;
      loss.loss.probability = copy.duplicate.probability = damage.corruption.probability = 0.5;
      reorder.reorder = {.probability = 0.5, .displacement = 1};
      body.body = {.kind = BodySpec::Kind::kUniform, .high = 1ms};
      body.order = ArrivalOrder::kFree;
      stream("loss", loss, [](const PathDecision& v) { return v.outcome == Outcome::kLost; });
      stream("copy", copy, [](const PathDecision& v) { return v.copied; });
      stream("damage", damage, [](const PathDecision& v) { return v.outcome == Outcome::kCorrupted; });
      stream("reorder", reorder, [](const PathDecision& v) { return v.outcome == Outcome::kHeldBack; });
      stream("delay", body, [](const PathDecision& v) { return v.at < Time{500us}; });
    }
  }
  return all;
}

TEST(Matrix, StreamsOfDirectionsFlowsAndPurposesAreIndependent) {
  const std::size_t n = tandem::test::draws(200'000, 1'000'000, 1'000'000);
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    const auto streams = coins(seed, n);
    ASSERT_EQ(streams.size(), 20U);
    const double most = (seed == 1 ? 4 : 4.9) / std::sqrt(static_cast<double>(n));
    for (auto a = streams.begin(); a != streams.end(); ++a) {
      SCOPED_TRACE(a->first + ", seed " + std::to_string(seed));
      EXPECT_LT(std::abs(autocorrelation(a->second, 1)), most);
      for (auto b = streams.begin(); b != a; ++b) {
        std::array<double, 4> joint{};
        for (std::size_t i = 0; i < n; ++i) ++joint[(a->second[i] > 0 ? 2U : 0U) + (b->second[i] > 0 ? 1U : 0U)];
        EXPECT_GT(chi_square_p(joint, std::array{0.25, 0.25, 0.25, 0.25}), kAlpha) << b->first;
        EXPECT_LT(std::abs((joint[0] + joint[3] - joint[1] - joint[2]) / static_cast<double>(n)), most) << b->first;
      }
    }
  }
}

/// Returns the log of both directions of a link for 3 s of uneven traffic.
std::string log_of(Network& network, std::uint64_t seed) {
  DecisionLog log{100'000};
  network.log_to(&log);
  RandomStream random{RandomKey{seed}.derive(5)};
  std::array<std::byte, kSlotBytes> buffer{};
  for (Time now{}; now < Time{3s};) {
    now += Duration{static_cast<std::int64_t>(random.below(1'500'000))};
    const std::size_t size = 20 + random.below(400);
    for (const Direction direction : {Direction::kUp, Direction::kDown})
      network.send(now, 0, direction, std::span{buffer}.first(size));
    while (network.poll_any(now, buffer)) {
    }
  }
  network.log_in_flight();
  EXPECT_EQ(log.missed(), 0U);
  return decision_csv(log.sorted());
}

// Log, text, reader, recording, network, log: equal bytes.
TEST(Matrix, ReplaysALogToAnIdenticalLog) {
  for (std::uint64_t seed = 1, last = tandem::test::seeds(40); seed <= last && !HasFailure(); ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    RandomStream random{seed};
    LinkSpec spec;
    spec.up = random_path(random, seed % 3 == 0 ? ArrivalOrder::kFree : ArrivalOrder::kFifo);
    spec.down = random_path(random, ArrivalOrder::kFifo);
    Network live{seed}, again{seed + 1};
    live.add_link(spec);
    const std::string log = log_of(live, seed);
    const auto rows = parse_decision_csv(log, "log.csv");
    ASSERT_TRUE(rows) << to_text(rows.error());
    auto replay = Replay::make(*rows);
    ASSERT_TRUE(replay) << replay.error();
    again.add_replay(std::make_shared<const Replay>(std::move(*replay)), 0);
    const std::string second = log_of(again, seed);
    const auto differs = std::ranges::mismatch(log, second);
    EXPECT_TRUE(log == second) << "first difference near: "
                               << log.substr(static_cast<std::size_t>(differs.in1 - log.begin()) / 60 * 60, 120);
    EXPECT_GT(log.size(), 100'000U);
  }
}

}  // namespace
}  // namespace tandem::netsim
