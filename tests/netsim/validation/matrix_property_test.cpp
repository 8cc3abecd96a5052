// Rows of the validation matrix that hold for every combination of models and order: floor, order, conservation.
#include <gtest/gtest.h>

#include <map>

#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/models/random_spec.h"

namespace tandem::netsim {
namespace {

using namespace test;

constexpr int kDatagrams = 3000;
std::array<std::byte, kSlotBytes> buffer;

/// Calls `body(spec, seed, random)` for random paths of both orders.
template <typename Body>
void for_random_paths(std::uint64_t reduced, Body body) {
  const std::uint64_t seeds = tandem::test::seeds(reduced);
  for (std::uint64_t seed = 1; seed <= seeds && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    RandomStream random{seed};
    const PathSpec spec = random_path(random, seed % 3 == 0 ? ArrivalOrder::kFree : ArrivalOrder::kFifo);
    const auto wrong = problems(spec);
    ASSERT_TRUE(wrong.empty()) << wrong.front().key << ": " << wrong.front().message;
    body(spec, seed, random);
  }
}

/// Returns the decisions on 3 s of uneven traffic, in the order of sending.
std::vector<Decision> decisions(const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
  Network network{seed};
  network.add_link({spec, {}});
  DecisionLog log{3 * kDatagrams};
  network.log_to(&log);
  Time now{};
  for (int i = 0; i < kDatagrams; ++i) {
    now += Duration{static_cast<std::int64_t>(random.below(2'000'000))};
    network.send(now, 0, Direction::kUp, std::span{buffer}.first(20 + random.below(400)));
    while (random.below(4) == 0 && network.poll_any(now, buffer)) {
    }
  }
  while (network.poll_any(now + 1h, buffer)) {
  }
  EXPECT_EQ(log.missed(), 0U);
  return log.sorted();
}

TEST(Matrix, DeliversNothingBeforeTheFloor) {
  std::size_t checked = 0;
  for_random_paths(300, [&](const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
    for (const Decision& row : decisions(spec, seed, random)) {
      if (dropped(row.outcome)) continue;
      ASSERT_GE(row.out - row.in, spec.floor) << row.index;
      ++checked;
    }
  });
  EXPECT_GT(checked, 100'000U);
}

TEST(Matrix, KeepsOrderWithFifo) {
  std::size_t checked = 0;
  for_random_paths(300, [&](const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
    if (spec.order != ArrivalOrder::kFifo) return;
    Time last{};
    for (const Decision& row : decisions(spec, seed, random)) {
      if (row.outcome != Outcome::kDeliver || row.copy) continue;  // datagrams held back for reordering are exempt
      ASSERT_GE(row.out, last) << row.index;
      last = row.out;
      ++checked;
    }
  });
  EXPECT_GT(checked, 50'000U);
}

/// Sink that counts the datagrams in flight of a network.
class Waiting final : public DecisionSink {
 public:
  void decided(const Decision& decision) noexcept override { count_ += decision.in_flight ? 1 : 0; }
  std::uint64_t count(const Network& network) {
    count_ = 0;
    network.log_in_flight();
    return count_;
  }

 private:
  std::uint64_t count_ = 0;
};

// After every call: in + copies = out + dropped by cause + the stored datagrams, counted one by one.
TEST(Matrix, ConservesDatagramsAtEveryInstant) {
  std::array<std::uint64_t, kOutcomes> met{};
  for_random_paths(150, [&](const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
    Network network{seed};
    network.add_link({spec, {}});
    Waiting waiting;
    network.log_to(&waiting);
    std::uint64_t in = 0, out = 0;
    Time now{};
    const PathCounters& counters = network.counters(0, Direction::kUp);
    const auto balanced = [&] {
      const std::uint64_t inside = waiting.count(network);
      return counters.in == in && counters.out == out && counters.in_flight() == inside &&
             counters.in + counters.copies == counters.out + counters.dropped() + inside;
    };
    const auto drain = [&] {
      while (network.poll_any(now, buffer)) {
        ++out;
        ASSERT_TRUE(balanced()) << "taking at " << out;
      }
      ASSERT_TRUE(balanced()) << "nothing left after " << out;
    };
    for (int i = 0; i < 1500; ++i) {
      now += Duration{static_cast<std::int64_t>(random.below(4'000'000))};
      if (random.below(200) == 0) {
        network.send(now, 0, Direction::kUp, std::vector<std::byte>(kSlotBytes + 1));
      } else {
        network.send(now, 0, Direction::kUp, std::span{buffer}.first(20 + random.below(400)));
      }
      ++in;
      ASSERT_TRUE(balanced()) << "sending " << i;
      if (random.below(500) == 0) network.rebind(now, 0, {.dead_after = 5ms});
      if (random.below(20) == 0) {
        ASSERT_NO_FATAL_FAILURE(drain());
      }
    }
    if (seed % 10 == 0) {  // more than any store holds
      for (int i = 0; i < 15'000; ++i, ++in) network.send(now, 0, Direction::kUp, std::span{buffer}.first(1));
      ASSERT_TRUE(balanced());
    }
    now += 1h;
    while (network.poll_any(now, buffer)) ++out;
    ASSERT_TRUE(balanced());
    ASSERT_EQ(counters.in_flight(), 0U);
    for (std::size_t i = 0; i < kOutcomes; ++i) met[i] += counters.by_outcome[i];
  });
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    const auto outcome = static_cast<Outcome>(i);
    if (outcome == Outcome::kWaiting || outcome == Outcome::kClientGone || outcome == Outcome::kOldAddress)
      continue;  // never counted; does not occur here; down only
    EXPECT_GT(met[i], 0U) << "no path ever met " << name(outcome);
  }
}

}  // namespace
}  // namespace tandem::netsim
