#include <gtest/gtest.h>

#include "proto/text/scene_text.h"

namespace tandem {
namespace {

SceneSpec scene(LawKind law, PortSpace port, MfsMode mfs) {
  SceneSpec s;
  s.channel.law = law;
  s.channel.mfs = mfs;
  s.port = port;
  return s;
}

TEST(LawProblem, RejectsJointPortsAndVelocityGatesForLawReplica) {
  for (const MfsMode mfs : {MfsMode::kOpen, MfsMode::kTank}) {
    EXPECT_FALSE(law_problem(scene(LawKind::kReplica, PortSpace::kTip, mfs)));
    const auto joints = law_problem(scene(LawKind::kReplica, PortSpace::kJoint, mfs));
    ASSERT_TRUE(joints);
    EXPECT_EQ(joints->key, "channel.law");
    EXPECT_NE(joints->words.find("port: TIP"), std::string::npos) << joints->words;
  }
  for (const MfsMode mfs : {MfsMode::kSeed, MfsMode::kSeedSigned}) {
    const auto cut = law_problem(scene(LawKind::kReplica, PortSpace::kTip, mfs));
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->key, "channel.mfs");
    EXPECT_NE(cut->words.find("use OPEN or TANK"), std::string::npos) << cut->words;
  }
}

TEST(LawProblem, AcceptsEveryOtherLaw) {
  for (const LawKind law : {LawKind::kSetPosition, LawKind::kRaw})
    for (const PortSpace port : {PortSpace::kTip, PortSpace::kJoint})
      for (const MfsMode mfs : {MfsMode::kOpen, MfsMode::kTank, MfsMode::kSeed, MfsMode::kSeedSigned})
        EXPECT_FALSE(law_problem(scene(law, port, mfs)));
}

// A scene file gets the same error, with its position.
TEST(LawProblem, NamesTheKeyAndLineInASceneFile) {
  const auto errors = parse_scene(
      "version: 1\nport: JOINT\nchannel { law: REPLICA }\nseat { name: \"a\" role: TRAINEE }\ntool { name: \"t\" slave "
      "{ model: TOUCH } }\nauthority { tool: \"t\" seat: \"a\" alpha: 1 }\n",
      "s");
  ASSERT_FALSE(errors);
  ASSERT_EQ(errors.error().size(), 1u) << to_text(errors.error());
  EXPECT_EQ(errors.error()[0].key, "channel.law");
  EXPECT_EQ(errors.error()[0].line, 3);
}

}  // namespace
}  // namespace tandem
