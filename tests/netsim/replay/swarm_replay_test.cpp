// Random sessions with faults replay bit for bit: restarts, kills, floods, liars, hostile clients, bad networks.
#include <gtest/gtest.h>

#include <set>

#include "netsim/system/swarm.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/replay/recorded_session.h"

namespace tandem::netsim {
namespace {

using test::RecordedSession;

constexpr double kFaultPhase = 20;  // longest fault phase [s]

TEST(SwarmReplay, GivesAllOutputsAndRecordsBitForBit) {
  const std::uint64_t count = tandem::test::seeds(10);
  std::set<Fault::Kind> faults;
  std::uint64_t equal = 0, ticks = 0, datagrams = 0, outputs = 0, sessions = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SwarmCase which =
        generate_swarm_case(seed, kFaultPhase, seed % 2 == 0 ? LawKind::kReplica : LawKind::kSetPosition);
    for (const Fault& fault : which.setup.faults) faults.insert(fault.kind);
    RecordedSession recorded;
    which.setup.journal = &recorded.journal;
    const SwarmResult result =
        run_swarm_case(which, [&](Simulation& simulation) { recorded.take(simulation.session()); });
    EXPECT_TRUE(result.trouble.empty()) << result.trouble;
    EXPECT_EQ(recorded.journal.dropped(), 0u);
    const auto outcome = recorded.replay(which.setup.scene);
    EXPECT_EQ(outcome.words(), "");
    EXPECT_EQ(outcome.compared, recorded.ticks());
    EXPECT_EQ(outcome.rest, 0u);
    EXPECT_GT(outcome.counts.outputs, 1000u);
    equal += outcome.words().empty() ? 1 : 0;
    ticks += outcome.counts.ticks;
    datagrams += outcome.counts.datagrams;
    outputs += outcome.counts.outputs;
    sessions += outcome.counts.sessions;
  }
  std::printf(
      "[  figures ] %llu of %llu swarms bit for bit: %llu ticks of %llu servers, %llu datagrams, %llu outputs, %zu "
      "kinds of faults\n",
      static_cast<unsigned long long>(equal), static_cast<unsigned long long>(count),
      static_cast<unsigned long long>(ticks), static_cast<unsigned long long>(sessions),
      static_cast<unsigned long long>(datagrams), static_cast<unsigned long long>(outputs), faults.size());
  EXPECT_GT(faults.size(), 5u);
}

}  // namespace
}  // namespace tandem::netsim
