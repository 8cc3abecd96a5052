#include <gtest/gtest.h>

#include "proto/scene_spec.h"

namespace tandem {
namespace {

// How long a hand may be given force without news: law REPLICA gives a hand that leads alone the longer hold, others the shorter, and none of them less
// than the scene's silence limit; the other laws give all the same.
TEST(SilenceLimit, IsTheHoldOfTheRoleUnderLawReplica) {
  const GateSpec gate;  // 20, 250 and 100 ms
  EXPECT_EQ(silence_limit(gate, LawKind::kReplica, 1), gate.local_hold);
  EXPECT_EQ(silence_limit(gate, LawKind::kReplica, kLeadsAlone), gate.local_hold);
  EXPECT_EQ(silence_limit(gate, LawKind::kReplica, 0.97), gate.follow_hold);
  EXPECT_EQ(silence_limit(gate, LawKind::kReplica, 0), gate.follow_hold);
  EXPECT_LT(gate.follow_hold, gate.local_hold);
  EXPECT_LT(gate.silence_limit, gate.follow_hold);
  for (const LawKind law : {LawKind::kSetPosition, LawKind::kRaw})
    for (const double authority : {0.0, 1.0}) EXPECT_EQ(silence_limit(gate, law, authority), gate.silence_limit);
}

TEST(SilenceLimit, IsNeverLessThanTheScenesOwn) {
  GateSpec gate;
  gate.silence_limit = 0.2;
  EXPECT_EQ(silence_limit(gate, LawKind::kReplica, 0), 0.2);
  EXPECT_EQ(silence_limit(gate, LawKind::kReplica, 1), gate.local_hold);
}

}  // namespace
}  // namespace tandem
