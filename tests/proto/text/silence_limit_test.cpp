#include <gtest/gtest.h>

#include "proto/spec/scene_spec.h"

namespace tandem {
namespace {

// Time for which a hand may receive force without a new datagram. Under law REPLICA it is at least 250 ms for a hand
// that leads alone and at least 100 ms for the others. The scene gives the maximum for each; no limit is below the
// scene's silence limit. The other laws use the same limit for all hands.
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

TEST(SilenceLimits, LieBetweenTheScenesSilenceLimitAndItsHold) {
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
