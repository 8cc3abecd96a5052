#include <gtest/gtest.h>

#include "proto/scene_spec.h"

namespace tandem {
namespace {

// How long a hand may be given force without news: under law REPLICA a hand that leads alone at least 250 ms and others at least 100 ms, at most
// what the scene says for each; none less than the scene's silence limit. The other laws give all the same.
TEST(SilenceLimits, AreThoseOfTheRoleUnderLawReplica) {
  GateSpec gate;
  gate.local_hold = 0.4;
  gate.follow_hold = 0.3;
  for (const double leads : {1.0, kLeadsAlone}) {
    EXPECT_EQ(silence_limits(gate, LawKind::kReplica, leads).least, 0.25);
    EXPECT_EQ(silence_limits(gate, LawKind::kReplica, leads).most, 0.4);
  }
  for (const double shares : {0.97, 0.0}) {
    EXPECT_EQ(silence_limits(gate, LawKind::kReplica, shares).least, 0.1);
    EXPECT_EQ(silence_limits(gate, LawKind::kReplica, shares).most, 0.3);
  }
  for (const LawKind law : {LawKind::kSetPosition, LawKind::kRaw})
    for (const double authority : {0.0, 1.0}) {
      EXPECT_EQ(silence_limits(gate, law, authority).least, gate.silence_limit);
      EXPECT_EQ(silence_limits(gate, law, authority).most, gate.silence_limit);
    }
}

TEST(SilenceLimits, AreNeverMoreThanTheScenesHoldNorLessThanItsSilenceLimit) {
  GateSpec gate;
  gate.local_hold = gate.follow_hold = 0.06;
  for (const double authority : {0.0, 1.0}) {
    EXPECT_EQ(silence_limits(gate, LawKind::kReplica, authority).least, 0.06);
    EXPECT_EQ(silence_limits(gate, LawKind::kReplica, authority).most, 0.06);
  }
  gate.silence_limit = 0.2;
  EXPECT_EQ(silence_limits(gate, LawKind::kReplica, 0).most, 0.2);
}

}  // namespace
}  // namespace tandem
