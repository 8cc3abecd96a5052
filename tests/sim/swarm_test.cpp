// The generator of random sessions: a seed always gives the same session, and only that. The swarm itself runs as a
// program (Swarm.*).
#include "netsim/system/swarm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/base/heap_count.h"

namespace tandem {
namespace {

TEST(SwarmCases, AreValidAndCoverAllScenesAndFaults) {
  std::set<std::size_t> masters, tools;
  std::set<netsim::Fault::Kind> faults;
  std::size_t remote = 0, joint = 0, one_axis = 0, evaluators = 0, scripted = 0, clocks = 0;
  constexpr double kReplicaFault = 10;  // longest fault phase [s]
  std::size_t stepped = 0, held = 0, rated = 0, scaled = 0, separated = 0;
  constexpr std::uint64_t kCases = 1000;
  for (std::uint64_t seed = 1; seed <= kCases; ++seed) {
    const netsim::SwarmCase c = netsim::generate_swarm_case(seed);  // throws if its scene is not valid
    const SceneSpec& scene = c.setup.scene;
    masters.insert(scene.masters());
    tools.insert(scene.tools.size());
    for (const auto& f : c.setup.faults) {
      faults.insert(f.kind);
      EXPECT_LE(f.at + f.length, c.recovery_start) << seed;
    }
    for (const auto& e : c.setup.events) {
      EXPECT_TRUE(problems(e).empty()) << seed;
      EXPECT_LE(e.at + (e.outage ? e.outage->length : Duration{}), c.recovery_start) << seed;
    }
    remote += scene.seats.size() > scene.masters();
    joint += scene.port == PortSpace::kJoint;
    one_axis += scene.dof == 1;
    for (const auto& s : scene.seats) evaluators += s.role == Role::kEvaluator;
    scripted += c.setup.events.size() > 1;
    clocks += !c.setup.endpoints.empty();
    held += scene.send.dead_band.has_value();
    rated += scene.send.rate > 0;
    for (const auto& s : scene.seats) {
      scaled += s.motion_scale != 1;
      separated += s.force_separation;
    }
  }
  EXPECT_EQ(masters, (std::set<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(tools, (std::set<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(faults.size(), netsim::kFaultNames.size()) << "a kind of fault never comes";
  for (const std::size_t n : {remote, joint, one_axis, evaluators, scripted, clocks, held, rated, scaled, separated})
    EXPECT_GT(n, kCases / 20);
  for (std::uint64_t seed = 1; seed <= kCases; ++seed)  // only law REPLICA simulates every tool
    stepped += netsim::generate_swarm_case(seed, kReplicaFault, LawKind::kReplica).setup.scene.numerics.substeps > 1;
  EXPECT_GT(stepped, kCases / 20);
}

TEST(SwarmCases, AreTheSameSessionEveryTime) {
  for (const std::uint64_t seed : {3, 8}) {
    const auto once = netsim::run_swarm_case(netsim::generate_swarm_case(seed, 6));
    const auto again = netsim::run_swarm_case(netsim::generate_swarm_case(seed, 6));
    EXPECT_TRUE(once.passed()) << once.trouble;
    EXPECT_EQ(once.fingerprint, again.fingerprint);
    EXPECT_EQ(once.lived_s, again.lived_s);
  }
  EXPECT_NE(netsim::run_swarm_case(netsim::generate_swarm_case(3, 6)).fingerprint,
            netsim::run_swarm_case(netsim::generate_swarm_case(4, 6)).fingerprint);
}

std::uint64_t always_more() noexcept {
  static std::uint64_t taken = 0;
  return ++taken;
}

TEST(SwarmCases, TakeNoHeapBelowATick) {
  for (const std::uint64_t seed :
       {3, 8, 25, 44}) {  // the last two with lying clients, whose attacker allocates nothing either
    netsim::SwarmCase which = netsim::generate_swarm_case(seed, 6);
    which.setup.heap_count = heap_allocations;
    EXPECT_TRUE(netsim::run_swarm_case(which).passed()) << seed;
    which.setup.heap_count = always_more;  // as if every tick allocated memory
    const auto result = netsim::run_swarm_case(which);
    const auto of = [&](const std::string& whom) {
      return std::ranges::any_of(result.violations,
                                 [&](const auto& v) { return v.invariant == "heap" && v.seat == whom; });
    };
    EXPECT_TRUE(of("")) << seed << ": the server's";
    EXPECT_TRUE(of(which.setup.scene.seats[0].name)) << seed;
  }
}

}  // namespace
}  // namespace tandem
