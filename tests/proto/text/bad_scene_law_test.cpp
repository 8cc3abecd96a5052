// Rules of laws, ports and slave models.
#include "tests/proto/text/bad_scene.h"

namespace tandem {
namespace {

using namespace bad_scene;

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

TEST(BadScene, SpringAbovePassivityLimitNeedsUnsafeGains) {
  const std::string law = "channel { law: SET_POSITION }\n";  // REPLICA only requests a stiffness, see below
  expect_one(with("400", "@401") + law, "device_coupling.k_c_n_m", "passivity limit b / (T/2) = 400 N/m");
  EXPECT_TRUE(errors_of(with("400", "401") + "unsafe_gains: true\n").empty());
  expect_one(with("name: \"tool\" slave", "name: \"tool\" k_s_n_m: @750 slave"), "tool[0].k_s_n_m",
             "unsafe_gains: true");
  // A device with more damping, or a faster tick, allows more stiffness.
  EXPECT_TRUE(errors_of(with("400", "800") + "tick_hz: 2000\n").empty());
  expect_one(mark(with("role: TRAINEE", "role: TRAINEE device { damping_n_s_m: 0.1 }"), "400") + law,
             "device_coupling.k_c_n_m", "200 N/m of the device of seat \"trainee\"");
}

// Law REPLICA gives each hand the stiffness its device renders, at any rate; only a device without any is an error.
TEST(BadScene, RejectsOnlyDevicesWithoutStiffnessForLawReplica) {
  const std::string replica = "channel { law: REPLICA }\n";
  EXPECT_TRUE(errors_of(with("400", "900") + replica).empty());
  const auto errors = errors_of(with("role: TRAINEE", "role: TRAINEE device { damping_n_s_m: 0.0001 }") + replica);
  ASSERT_EQ(errors.size(), 1u) << to_text(errors);
  EXPECT_EQ(errors[0].key, "device_coupling.k_c_n_m");
  EXPECT_NE(errors[0].message.find("at least 1 N/m are needed"), std::string::npos) << errors[0].message;
}

TEST(BadScene, PassivityLimitAppliesToDefaultsToo) {
  const auto errors = errors_of(with("{ k_c_n_m: 400 }", "{ }") + "tick_hz: 500\nchannel { law: SET_POSITION }\n");
  ASSERT_EQ(errors.size(), 2u) << to_text(errors);
  EXPECT_EQ(errors[0].key, "device_coupling.k_c_n_m");
  EXPECT_EQ(errors[0].value, "400");
  EXPECT_EQ(errors[0].line, 3) << "of the message around it";
  EXPECT_EQ(errors[1].key, "tool[0].k_s_n_m");
}

}  // namespace
}  // namespace tandem
