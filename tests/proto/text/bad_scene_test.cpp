#include "tests/proto/text/bad_scene.h"

namespace tandem {
namespace {

using namespace bad_scene;

TEST(BadScene, AcceptsTheUnmodifiedScene) { EXPECT_EQ(to_text(errors_of(good())), ""); }

TEST(BadScene, RejectsAnUnknownKeyAndSuggestsTheNearest) {
  expect_one(with("duration_s", "@duraton_s"), "duraton_s", "did you mean duration_s?");
  expect_one(with("{ k_c_n_m: 400 }", "{ @k_c_nm: 400 }"), "device_coupling.k_c_nm", "did you mean k_c_n_m?");
  expect_one(with("alpha: 1 }\n", "alpha: 1 @weight { a: [1, 2] b { } } }\n"), "authority[0].weight", "unknown key");
}

TEST(BadScene, RejectsAnEmptyScene) {
  for (const char* text : {"@", "@\n\n", "@# nothing but a comment\n"}) expect_one(text, "", "no key is set");
}

TEST(BadScene, RequiresVersionOne) {
  expect_one(with("version: 1\n", "\n"), "version", "is missing");
  expect_one(with("version: 1", "version: @2"), "version", "must be in [1, 1]");
  expect_one(with("version: 1", "version: @-1"), "version", "whole number");
}

TEST(BadScene, RowsOfAuthorityMustSumToOne) {
  expect_one(with("alpha: 1 }\n", "alpha: @0.9 }\n"), "authority[0].alpha",
             "the authorities over tool \"tool\" sum to 0.9 (trainer 0.9); they must sum to 1");
  expect_one(with("\"trainee\" alpha: 1", "\"trainee\" alpha: @0.5"), "timeline[0].authority[0].alpha", "sum to 0.5");
  EXPECT_TRUE(
      errors_of(with("alpha: 1 }\n", "alpha: 0.3 } authority { tool: \"tool\" seat: \"trainee\" alpha: 0.7 }\n"))
          .empty());
}

TEST(BadScene, RowsOfFollowingMustSumToOne) {
  expect_one(good() + "follow { seat: \"trainee\" tool: \"tool\" weight: @0.5 }\n", "follow[0].weight",
             "must sum to 1");
}

TEST(BadScene, NegativeStiffnessNamesItsRange) {
  expect_one(with("{ model: RELAXED }", "{ model: RELAXED k_n_m: @-5 }"), "seat[1].hand.k_n_m",
             "scene.textproto:5:80: seat[1].hand.k_n_m = -5: must be in [0, 1e5] N/m");
  expect_one(with("k_c_n_m: 400", "k_c_n_m: @-400"), "device_coupling.k_c_n_m", "must be in (0, 1e5] N/m");
  expect_one(good() + "channel { k_n_m: @0 }\n", "channel.k_n_m", "must be in (0, 1e5] N/m");
}

TEST(BadScene, ReportsATickRateOutOfRangeAlone) {
  for (const char* hz : {"0", "-1000", "5e-324", "1e-300", "0.5", "99.9", "10000.1", "1e300"}) {
    SCOPED_TRACE(hz);
    expect_one(with("duration_s: 18", std::string("duration_s: 18 tick_hz: @") + hz), "tick_hz",
               "must be in [100, 10000] Hz");
  }
  expect_one(with("duration_s: 18", "duration_s: 3e6 tick_hz: @1e-300"), "tick_hz", "must be in [100, 10000] Hz");
}

TEST(BadScene, NumbersMustBeFinite) {
  for (const char* value : {"nan", "-nan", "inf", "-inf", "infinity", "1e400", "-1e400"}) {
    SCOPED_TRACE(value);
    expect_one(with("duration_s: 18", std::string("duration_s: @") + value), "duration_s", "finite number");
  }
  // A number too small for a double cannot be intended either.
  expect_one(with("duration_s: 18", "duration_s: @1e-400"), "duration_s", "finite number");
}

TEST(BadScene, NumbersMustBeNumbers) {
  expect_one(with("duration_s: 18", "duration_s: @\"18\""), "duration_s", "must be a number");
  expect_one(with("duration_s: 18", "duration_s: @0x12"), "duration_s", "decimal");
  expect_one(with("duration_s: 18", "@duration_s { }"), "duration_s", "colon");
  expect_one(with("duration_s: 18", "@duration_s:"), "duration_s", "has no value");
}

TEST(BadScene, NamesAreUniqueAndLegal) {
  expect_one(with("\"tool\" slave", "@\"trainer\" slave { } } tool { name: \"tool\" slave") +
                 "authority { tool: \"trainer\" seat: \"trainer\" alpha: 1 }\n",
             "tool[0].name", "taken by seat[0].name");
  const auto errors = errors_of(with("name: \"trainee\"", "name: \"trainer\""));
  ASSERT_EQ(errors.size(), 2u) << to_text(errors);
  EXPECT_EQ(errors[0].line, 5);
  EXPECT_EQ(errors[0].column, 14);
  EXPECT_NE(errors[0].message.find("taken by seat[0].name"), std::string::npos);
  EXPECT_EQ(errors[1].key, "timeline[0].authority[0].seat");
  expect_one(good() + "seat { name: @\"a b\" role: OBSERVER }", "seat[2].name", "1 to 32 characters");
  expect_one(good() + "seat { name: @\"" + std::string(33, 'x') + "\" role: OBSERVER }", "seat[2].name", "1 to 32");
  expect_one(good() + "@seat { role: OBSERVER }", "seat[2].name", "is missing");
}

TEST(BadScene, KeysAreWrittenOnce) {
  expect_one(with("duration_s: 18", "duration_s: 18 @duration_s: 19"), "duration_s", "twice, first in line 2");
  expect_one(good() + "@device_coupling { }\n", "device_coupling", "twice, first in line 3");
}

TEST(BadScene, NamesMustResolve) {
  expect_one(with("seat: \"trainer\" alpha", "seat: @\"trainr\" alpha"), "authority[0].seat", "did you mean trainer?");
  expect_one(with("tool: \"tool\" seat: \"trainee\"", "tool: @\"tol\" seat: \"trainee\""),
             "timeline[0].authority[0].tool", "did you mean tool?");
}

TEST(BadScene, RejectsAuthorityForAnEvaluator) {
  expect_one(mark(with("role: TRAINEE", "role: EVALUATOR"), "1 } }\n"), "timeline[0].authority[0].alpha",
             "EVALUATOR never has authority");
}

TEST(BadScene, TimelineAscendsWithinTheDuration) {
  const std::string step = "timeline { at_s: @11 authority { tool: \"tool\" seat: \"trainee\" alpha: 1 } }\n";
  expect_one(good() + step, "timeline[1].at_s", "must ascend; before it comes 11.5");
  expect_one(with("at_s: 11.5", "at_s: @18"), "timeline[0].at_s", "before the end");
}

TEST(BadScene, EveryToolHasOneSlave) {
  const std::string seat = "seat { name: \"slave\" kind: SLAVE tool: \"tool\" }\n";
  expect_one(mark(good() + seat, "\"tool\" }\n"), "seat[2].tool", "has a slave of its own");
  expect_one(mark(with(" slave { model: TOUCH }", ""), "tool {"), "tool[0]", "nothing serves this tool");
  EXPECT_TRUE(errors_of(with(" slave { model: TOUCH }", "") + seat).empty());
  expect_one(with(" slave { model: TOUCH }", "") + seat + "seat { name: \"second\" kind: SLAVE tool: @\"tool\" }\n",
             "seat[3].tool", "served by seat[2] already");
}

TEST(BadScene, ScalesMotionAndSeparatesForcesOnlyForMastersAtTheTip) {
  const auto seat = [](const std::string& keys) {
    return with("hand { model: RELAXED } }", "hand { model: RELAXED } " + keys + " }");
  };
  const auto scene =
      parse_scene(seat("motion_scale: 0.5 device { load_kg: 0.1 calibrate: true } force_separation: true"), "s");
  ASSERT_TRUE(scene) << to_text(scene.error());
  EXPECT_EQ(scene->seats[0].motion_scale, 1) << "none by default";
  EXPECT_EQ(scene->seats[1].motion_scale, 0.5);
  EXPECT_EQ(scene->seats[1].device.load, 0.1);
  EXPECT_TRUE(scene->seats[1].device.calibrate);
  EXPECT_TRUE(scene->seats[1].force_separation);
  const std::string listing = effective_scene_text(*scene);
  for (const char* key :
       {"seat[1].motion_scale", "seat[1].device.load_kg", "seat[1].device.calibrate", "seat[1].force_separation"})
    EXPECT_NE(listing.find(key), std::string::npos) << key;
  expect_one(seat("motion_scale: @0.09"), "seat[1].motion_scale", "must be in [0.1, 4]");
  expect_one(seat("motion_scale: @4.1"), "seat[1].motion_scale", "must be in [0.1, 4]");
  expect_one(seat("device { load_kg: @0.6 }"), "seat[1].device.load_kg", "must be in [0, 0.5] kg");
  expect_one(seat("force_separation: @true"), "seat[1].force_separation", "needs device { calibrate: true }");
  expect_one(seat("device { calibrate: true } force_separation: @true") + "channel { law: WAVE }\n",
             "seat[1].force_separation", "a law that sends positions");
  const std::string joints = "port: JOINT channel { law: SET_POSITION }\n";
  expect_one(seat("motion_scale: @0.5") + joints, "seat[1].motion_scale", "needs port: TIP");
  const auto slave = [](const std::string& keys) {
    return with(" slave { model: TOUCH }", "") + "seat { name: \"slave\" kind: SLAVE tool: \"tool\" " + keys + " }\n";
  };
  expect_one(slave("motion_scale: @2"), "seat[2].motion_scale", "is for MASTER seats");
  expect_one(slave("device { calibrate: true } force_separation: @true"), "seat[2].force_separation", "is for MASTER");
}

TEST(BadScene, AllowsAnAssistOnlyForMastersOfLawReplica) {
  const auto assisted = [](const std::string& assist) {
    return with("hand { model: RELAXED } }", "hand { model: RELAXED } " + assist + " }");
  };
  const auto scene = parse_scene(assisted("assist { force_n: 1.5 in_contact: true }"), "s");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->seats[1].assist.force, 1.5);
  EXPECT_TRUE(scene->seats[1].assist.in_contact);
  EXPECT_EQ(scene->seats[0].assist.force, 0) << "none by default";
  EXPECT_NE(effective_scene_text(*scene).find("seat[1].assist.force_n"), std::string::npos);
  expect_one(assisted("assist { force_n: @3.1 }"), "seat[1].assist.force_n", "must be in [0, 3] N");
  expect_one(assisted("assist { force_n: @-1 }"), "seat[1].assist.force_n", "must be in [0, 3] N");
  expect_one(assisted("@assist { in_contact: true }"), "seat[1].assist.force_n", "is missing");
  expect_one(assisted("@assist { force_n: 1 }") + "channel { law: SET_POSITION }\n", "seat[1].assist",
             "needs channel { law: REPLICA }");
  const std::string slave = "seat { name: \"slave\" kind: SLAVE tool: \"tool\" @assist { force_n: 1 } }\n";
  expect_one(with(" slave { model: TOUCH }", "") + slave, "seat[2].assist", "is for MASTER seats");
}

TEST(BadScene, AllowsContactsOnlyForToolsOfASlaveSeat) {
  const std::string seat = "seat { name: \"slave\" kind: SLAVE tool: \"tool\" }\n", law = "channel { law: REPLICA }\n";
  const auto remote = [&](const std::string& contacts) { return with(" slave { model: TOUCH }", contacts) + seat; };
  EXPECT_EQ(parse_scene(remote("") + law, "s")->tools[0].contacts, ContactsMode::kEstimated) << "the default";
  EXPECT_EQ(parse_scene(remote(" contacts: NONE") + law, "s")->tools[0].contacts, ContactsMode::kNone);
  EXPECT_EQ(parse_scene(remote(" contacts: ESTIMATED") + law, "s")->tools[0].contacts, ContactsMode::kEstimated);
  expect_one(remote(" contacts: @ESTIMATED") + "channel { law: SET_POSITION }\n", "tool[0].contacts",
             "needs channel { law: REPLICA }");
  EXPECT_EQ(to_text(errors_of(remote(" contacts: NONE") + "channel { law: SET_POSITION }\n")), "");
  expect_one(with("slave { model: TOUCH }", "contacts: @NONE slave { model: VIRTUAL }") + law, "tool[0].contacts",
             "is for tools that a SLAVE seat serves");
}

TEST(BadScene, DevicesFitTheAxes) {
  expect_one(with("model: TOUCH", "model: @LINEAR"), "tool[0].slave.model", "LINEAR device has 1 axis, but dof is 3");
  EXPECT_EQ(errors_of(good() + "dof: 2\n").size(), 3u);
  EXPECT_TRUE(errors_of(with("model: TOUCH", "") + "dof: 1\n").empty());
  expect_one(with("{ model: TOUCH }", "{ environment { wall { axis: @Y } } }") + "dof: 1\n",
             "tool[0].slave.environment.wall.axis", "no such axis");
}

TEST(BadScene, ChecksGateAndLedgerBounds) {
  expect_one(good() + "gate { silence_limit_ms: @301 }", "gate.silence_limit_ms", "must be in (0, 300] ms");
  expect_one(good() + "gate { silence_limit_ms: @1 }", "gate.silence_limit_ms", "two ticks = 2 ms");
  const std::string springs = good() + "channel { law: SET_POSITION ";
  expect_one(springs + "e0_j: @0.05 }", "channel.e0_j", "0.09075 J");
  expect_one(springs + "} gate { force_max_n: @40 }", "gate.force_max_n", "13.3333333333 J must be at most 10 J");
  expect_one(springs + "k_min_n_m: @0.5 }", "channel.k_min_n_m", "10.89 J must be at most 10 J");
  EXPECT_EQ(to_text(errors_of(good() + "channel { e0_j: 0.05 } gate { force_max_n: 40 }")), "")
      << "law REPLICA has no such spring";
  EXPECT_TRUE(errors_of(good() + "gate { loop_age_max_ms: 2500 latch: false }").empty());
}

TEST(BadScene, RejectsContradictoryHands) {
  expect_one(with("{ model: RELAXED }", "{ model: RELAXED @trajectory { circle { } } }"), "seat[1].hand.trajectory",
             "LEADER");
  expect_one(with("{ model: LEADER }", "{ model: LEADER trajectory { waypoint { at_s: 2 } waypoint { at_s: @2 } } }"),
             "seat[0].hand.trajectory.waypoint[1].at_s", "order of time");
  expect_one(with("{ model: LEADER }", "{ model: LEADER from_s: 5 until_s: @5 }"), "seat[0].hand.until_s",
             "after from_s = 5");
}

TEST(BadScene, RejectsTimedRelaxationOfAnOperatorsHand) {
  for (const char* model : {"KEYBOARD", "RECORDED"})
    for (const char* key : {"from_s", "until_s"}) {
      const std::string text =
          with("hand { model: LEADER }", std::string("hand { model: ") + model + " " + key + ": @11.5 }");
      expect_one(text, std::string("seat[0].hand.") + key, "never relaxed by the scene");
    }
}

TEST(BadScene, AcceptsAnyTimeWithoutADuration) {
  EXPECT_EQ(to_text(errors_of(with("duration_s: 18\n", ""))), "");
  expect_one(with("duration_s: 18", "clock_runs_while_stopped: @1"), "clock_runs_while_stopped", "true or false");
  EXPECT_TRUE(parse_scene(with("duration_s: 18", "clock_runs_while_stopped: true"), "s")->clock_runs_while_stopped);
}

TEST(BadScene, RejectsTooManySeats) {
  std::string text = good();
  for (int i = 0; i < 15; ++i) text += "seat { name: \"s" + std::to_string(i) + "\" role: OBSERVER }\n";
  expect_one(mark(text, "seat { name: \"s14"), "seat[16]", "at most 16 MASTER seats");
}

TEST(BadScene, ListsEveryMistakeInFileOrder) {
  const auto errors = errors_of(
      "version: 1\n"
      "colour: \"red\"\n"
      "channel { k_n_m: -5 law: SET_POSITON }\n"
      "device_coupling { k_c_n_m: -900 k_c_n_m: 3 }\n"
      "gate { silence_limit_ms: nan loop_age_max_ms: 1e400 }\n"
      "seat { name: \"a\" hand { model: LEADER k_n_m: -2 } }\n"
      "seat { name: \"a\" }\n"
      "tool { name: \"t\" slave { } }\n"
      "authority { tool: \"t\" seat: \"a\" alpha: 0.5 }\n"
      "]\n"
      "tick_hz: 1e3 }\n"
      "dof: 3.5\n"
      "phase { name: \"p\" from_s: 4 to_s: 4\n");
  const std::vector<std::pair<int, std::string>> expected{{2, "colour"},
                                                          {3, "channel.k_n_m"},
                                                          {3, "channel.law"},
                                                          {4, "device_coupling.k_c_n_m"},
                                                          {4, "device_coupling.k_c_n_m"},
                                                          {5, "gate.silence_limit_ms"},
                                                          {5, "gate.loop_age_max_ms"},
                                                          {6, "seat[0].hand.k_n_m"},
                                                          {7, "seat[1].name"},
                                                          {9, "authority[0].alpha"},
                                                          {10, ""},
                                                          {11, ""},
                                                          {12, "dof"},
                                                          {13, "phase[0]"},
                                                          {13, "phase[0].to_s"}};
  ASSERT_EQ(errors.size(), expected.size()) << to_text(errors);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(errors[i].line, expected[i].first) << to_text(errors[i]);
    EXPECT_EQ(errors[i].key, expected[i].second) << to_text(errors[i]);
  }
}

TEST(BadScene, NamesTheKeyPathInJson) {
  const auto unknown = errors_of(R"({"version": 1, "seat": [{"name": "a", "hnd": 3}]})", "scene.json");
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_NE(unknown[0].message.find("seat[0]"), std::string::npos) << unknown[0].message;
  EXPECT_NE(unknown[0].message.find("hnd"), std::string::npos);
  const auto nan =
      errors_of(R"({"version": 1, "duration_s": "NaN", "seat": [{"name": "a"}], "tool": [{"name": "t", "slave": {}}],
                                 "authority": [{"tool": "t", "seat": "a", "alpha": 1}]})",
                "scene.json");
  ASSERT_EQ(nan.size(), 1u) << to_text(nan);
  EXPECT_EQ(nan[0].key, "duration_s");
  EXPECT_NE(nan[0].message.find("finite"), std::string::npos) << nan[0].message;
  for (const char* text : {"", "{", "[]", "{}", "null", R"({"duration_s": 1e400})", "version: 1"}) {
    EXPECT_FALSE(errors_of(text, "scene.json").empty()) << text;
  }
}

}  // namespace
}  // namespace tandem
