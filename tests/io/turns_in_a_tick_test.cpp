// Sessions of one tick thread get their turn one after another; each acts on what arrived until its own turn.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <map>

#include "tests/bench/hosted_shard.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

/// Returns the time of each recorded tick of a session since its first one [ns], by the number of the tick.
std::map<std::uint32_t, std::int64_t> times_of(server::TickQueue& records) {
  std::map<std::uint32_t, std::int64_t> times;
  for (const server::TickRecord* record = nullptr; (record = records.front()) != nullptr; records.pop())
    times[record->tick] = record->time_ns;
  return times;
}

TEST(TurnsInATick, HaveATimeOfTheirOwn) {
  const SceneSpec scene = test::shipped("contact_remote");
  HostedShard host{scene, 20, true};  // 60 hands: the datagrams of 10 sessions fill half a batch
  host.run(500ms);
  ASSERT_TRUE(host.settled());
  const auto first = times_of(host.records(0)), last = times_of(host.records(19));
  int common = 0, later = 0;
  for (const auto& [tick, time] : first) {
    const auto same = last.find(tick);
    if (same == last.end()) continue;
    ++common;
    later += same->second != time ? 1 : 0;
  }
  ASSERT_GT(common, 10);
  EXPECT_GT(later, common / 2) << "the last session has the time of the first one";
}

}  // namespace
}  // namespace tandem::bench
