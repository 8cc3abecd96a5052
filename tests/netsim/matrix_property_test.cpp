// Rows of the validation matrix that hold for every model, order and combination of them: floor, order, conservation.
#include <gtest/gtest.h>

#include <map>

#include "netsim/submit.h"
#include "tests/base/counts.h"
#include "tests/netsim/random_spec.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Calls `body(spec, random)` for random paths of both orders.
template <typename Body>
void for_random_paths(std::uint64_t reduced, Body body) {
  const std::uint64_t seeds = tandem::test::seeds(reduced);
  for (std::uint64_t seed = 1; seed <= seeds && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    RandomStream random{seed};
    const PathSpec spec = random_path(random, seed % 3 == 0 ? Order::kFree : Order::kFifo);
    const auto wrong = problems(spec);
    ASSERT_TRUE(wrong.empty()) << wrong.front().key << ": " << wrong.front().message;
    body(spec, seed, random);
  }
}

TEST(Matrix, NothingIsEverFasterThanTheFloor) {
  for_random_paths(300, [](const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
    Path path = path_of(spec, seed);
    std::vector<Time> sent;
    Time now{};
    for (int i = 0; i < 3000; ++i) {
      now += Duration{static_cast<std::int64_t>(random.below(2'000'000))};
      sent.push_back(now);
      const Verdict v = path.send(now, 20 + random.below(400));
      if (!dropped(v.outcome)) {
        ASSERT_GE(v.at - now, spec.floor) << i;
      }
      for (const Release& r : v.released) ASSERT_GE(r.at - sent[r.index], spec.floor) << r.index;
    }
  });
}

TEST(Matrix, FifoNeverLetsOneOvertakeAnother) {
  std::size_t checked = 0;
  for_random_paths(300, [&](const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
    if (spec.order != Order::kFifo) return;
    Path path = path_of(spec, seed);
    Time now{}, last{};
    for (int i = 0; i < 3000; ++i) {
      now += Duration{static_cast<std::int64_t>(random.below(2'000'000))};
      const Verdict v = path.send(now, 20 + random.below(400));
      if (v.outcome != Outcome::kDeliver) continue;  // what is held back to be reordered is the exception asked for
      ASSERT_GE(v.at, last) << i;
      last = v.at;
      ++checked;
    }
  });
  EXPECT_GT(checked, 50'000U);
}

// in + copies = out + dropped by cause + what the store really holds, counted apart: after every single call.
TEST(Matrix, DatagramsAreConservedAtEveryInstant) {
  std::map<Outcome, std::uint64_t> met;
  for_random_paths(200, [&](const PathSpec& spec, std::uint64_t seed, RandomStream& random) {
    Path path = path_of(spec, seed);
    DelayQueue queue{120};  // small, so that it overflows too
    PathCounters counters;
    std::uint64_t in = 0, out = 0;
    Time now{};
    const auto balanced = [&] {
      return counters.in == in && counters.out == out && counters.in_flight() == queue.size() &&
             counters.in + counters.copies == counters.out + counters.dropped() + queue.size();
    };
    const auto drain = [&] {
      while (const auto item = queue.take(now)) {
        // Now and then nobody is there any more to receive it.
        const Outcome end = random.below(50) != 0 ? Outcome::kDeliver : random.below(2) == 0 ? Outcome::kOldAddress : Outcome::kClientGone;
        leave(*item, queue.bytes(*item).size(), end, counters, {});
        queue.recycle(item->slot);
        out += dropped(end) ? 0 : 1;
        ++met[end];
        ASSERT_TRUE(balanced()) << "taking at " << out;
      }
    };
    for (int i = 0; i < 3000; ++i) {
      now += Duration{static_cast<std::int64_t>(random.below(2'000'000))};
      const std::size_t size = random.below(200) == 0 ? kSlotBytes + 1 : 20 + random.below(400);
      ++met[submit(path.send(now, size), queue, counters, {}, {.now = now}, datagram(random.bits(), size))];
      ++in;
      ASSERT_TRUE(balanced()) << "sending " << i;
      if (random.below(20) == 0) {
        ASSERT_NO_FATAL_FAILURE(drain());
      }
    }
    now += 1h;
    ASSERT_NO_FATAL_FAILURE(drain());
    ASSERT_EQ(queue.size(), 0U);
    ASSERT_EQ(counters.in_flight(), 0U);
  });
  for (std::size_t i = 0; i < kOutcomes; ++i)
    EXPECT_GT(met[static_cast<Outcome>(i)], 0U) << "no path ever met " << name(static_cast<Outcome>(i));
}

}  // namespace
}  // namespace tandem::netsim
