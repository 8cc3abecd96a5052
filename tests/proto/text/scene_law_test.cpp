// Rules of a scene that depend on its control law.
#include "tests/proto/text/bad_scene.h"

namespace tandem {
namespace {

TEST(BadScene, NamesTheNeedsOfLawReplicaAndVirtualTools) {
  const std::string replica = "channel { law: REPLICA } device_coupling";
  EXPECT_EQ(to_text(errors_of(with("device_coupling", replica))), "");
  EXPECT_EQ(to_text(errors_of(with("slave { model: TOUCH }",
                                   "slave { model: VIRTUAL start_m { x: 0.01 } environment { wall { at_m: 0 } } }"))),
            "");
  expect_one(with("device_coupling", "port: JOINT channel { law: @REPLICA } device_coupling"), "channel.law",
             "needs port: TIP");
  expect_one(with("device_coupling", "channel { law: REPLICA mfs: @SEED } device_coupling"), "channel.mfs",
             "use OPEN or TANK");
  expect_one(with("slave { model: TOUCH }", "slave { model: @VIRTUAL friction_n: 0.1 }"), "tool[0].slave.model",
             "all but start_m and environment");
  expect_one(with("slave { model: TOUCH }", "@slave { friction_n: 0.1 }"), "tool[0].slave.model",
             "name model: TOUCH or LINEAR");
  expect_one(with("device_coupling", "dof: 1 device_coupling")
                 .replace(with("device_coupling", "dof: 1 device_coupling").find("slave { model: TOUCH }"), 22,
                          "slave { @start_m { y: 0.01 } }"),
             "tool[0].slave.start_m", "along x only");
  EXPECT_EQ(to_text(errors_of(
                with("slave { model: TOUCH }",
                     "slave { model: VIRTUAL environment { wall { friction: 0.4 } tissue { friction: 2 } } }"))),
            "");
  expect_one(with("slave { model: TOUCH }", "slave { model: TOUCH environment { wall { friction: @0.4 } } }"),
             "tool[0].slave.environment.wall.friction", "only a VIRTUAL slave");
  expect_one(with("slave { model: TOUCH }", "slave { model: VIRTUAL environment { tissue { friction: @2.1 } } }"),
             "tool[0].slave.environment.tissue.friction", "2");
  expect_one(with("hand { model: RELAXED }", "device { model: @VIRTUAL }"), "seat[1].device.model",
             "a hand holds a device");
}

/// A scene without law and slave model is rejected where the defaults are impossible. The error gives the names to use.
TEST(BadScene, AJointPortNamesALawAndASlaveModel) {
  expect_one(with("device_coupling", "port: @JOINT device_coupling"), "port", "name law: SET_POSITION");
  expect_one(with("device_coupling", "port: @JOINT channel { k_n_m: 900 } device_coupling"), "port",
             "name law: SET_POSITION");
  const std::string law = "port: JOINT channel { law: SET_POSITION } device_coupling";
  EXPECT_EQ(to_text(errors_of(with("device_coupling", law))), "");
  std::string bare = with("device_coupling", law);
  bare.replace(bare.find("slave { model: TOUCH }"), 22, "@slave { }");
  expect_one(bare, "tool[0].slave.model", "name model: TOUCH or LINEAR");
}

TEST(BadScene, DefaultsToLawReplicaAndToNoSlaveDevice) {
  const auto bare = parse_scene(with("slave { model: TOUCH }", "slave { start_m { x: 0.01 } }"), "s");
  ASSERT_TRUE(bare.has_value());
  EXPECT_EQ(bare->channel.law, LawKind::kReplica);
  EXPECT_EQ(bare->channel.e0, 0.05);
  EXPECT_TRUE(bare->tools[0].is_virtual);
  EXPECT_EQ(bare->tools[0].m_s, kVirtualToolMass);
  EXPECT_EQ(bare->tools[0].slave.start.x, 0.01);
  const auto robot = parse_scene(good(), "s");
  EXPECT_FALSE(robot->tools[0].is_virtual);
  EXPECT_EQ(robot->tools[0].m_s, kDeviceToolMass);
  const auto springs = parse_scene(with("device_coupling", "channel { law: SET_POSITION } device_coupling"), "s");
  EXPECT_EQ(springs->channel.law, LawKind::kSetPosition);
  EXPECT_NEAR(springs->channel.e0, 3.3 * 3.3 / 120, 1e-12);
}

/// A scene that changes to another law gets the initial energy that the parser would have given it.
TEST(BadScene, UsesTheLawsInitialEnergyUnlessTheSceneSetsMore) {
  const double spring = 3.3 * 3.3 / 120;
  SceneSpec bare = *parse_scene(good(), "s");
  choose_law(bare, LawKind::kSetPosition);
  EXPECT_NEAR(bare.channel.e0, spring, 1e-12);
  choose_law(bare, LawKind::kReplica);
  EXPECT_EQ(bare.channel.e0, 0.05);
  SceneSpec named = *parse_scene(good() + "channel { e0_j: 0.07 }", "s");
  choose_law(named, LawKind::kSetPosition);
  EXPECT_NEAR(named.channel.e0, spring, 1e-12);
  SceneSpec more = *parse_scene(good() + "channel { e0_j: 0.7 }", "s");
  choose_law(more, LawKind::kRaw);
  EXPECT_EQ(more.channel.e0, 0.7);
  SceneSpec strong = *parse_scene(good() + "gate { force_max_n: 40 }", "s");
  EXPECT_FALSE(law_problem(strong));
  choose_law(strong, LawKind::kSetPosition);
  ASSERT_TRUE(law_problem(strong));
  EXPECT_EQ(law_problem(strong)->key, "gate.force_max_n");
}

}  // namespace
}  // namespace tandem
