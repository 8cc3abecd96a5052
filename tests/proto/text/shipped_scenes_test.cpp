#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem {
namespace {

SceneSpec shipped(std::string_view name) {
  const auto* scene = find_shipped_scene(name);
  EXPECT_NE(scene, nullptr) << name;
  if (scene == nullptr) return {};
  const auto spec = parse_scene(scene->text, std::string(scene->name) + ".textproto");
  EXPECT_TRUE(spec.has_value()) << to_text(spec.error());
  return spec.value_or(SceneSpec{});
}

TEST(ShippedScenes, AreSeventeenAndEachIsValidAndSummarised) {
  std::set<std::string_view> names;
  for (const auto& scene : shipped_scenes()) {
    names.insert(scene.name);
    EXPECT_EQ(shipped(scene.name).name, scene.name);
    EXPECT_FALSE(scene.summary.empty()) << scene.name;
    EXPECT_EQ(scene.summary.find('\n'), std::string_view::npos);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"contact", "contact_remote", "cooperative_slave", "demonstration",
                                               "devices", "devices_remote", "eight_evaluators", "eight_seats",
                                               "evaluation", "free_motion", "guidance", "lesson", "one_axis",
                                               "seed_contact", "seed_free_motion", "seven_trainees", "two_by_two"}));
  EXPECT_EQ(find_shipped_scene("contac"), nullptr);
}

/// Tandem's own scenes use law REPLICA. Scenes whose tool is a device, and the paper's scenes, name SET_POSITION and
/// their devices.
TEST(ShippedScenes, UseLawReplicaWhereTheirToolIsVirtual) {
  for (const auto& entry : shipped_scenes()) {
    SCOPED_TRACE(entry.name);
    const auto scene = shipped(entry.name);
    const bool devices = entry.name.starts_with("seed_") || entry.name.ends_with("_remote");
    EXPECT_EQ(scene.channel.law, devices ? LawKind::kSetPosition : LawKind::kReplica);
    for (const ToolSpec& tool : scene.tools) EXPECT_EQ(tool.is_virtual, !devices && entry.name != "cooperative_slave");
  }
}

TEST(ShippedScenes, HaveAuthoritySumsOfOneInEveryRow) {
  for (const auto& entry : shipped_scenes()) {
    SCOPED_TRACE(entry.name);
    const auto scene = shipped(entry.name);
    EXPECT_EQ(scene.authority.size(), scene.tools.size());
    const auto sum = [](const auto& row) {
      double s = 0;
      for (const double w : row) s += w;
      return s;
    };
    for (const auto& row : scene.authority) EXPECT_NEAR(sum(row.alpha), 1, 1e-9);
    for (const auto& step : scene.timeline) EXPECT_NEAR(sum(step.row.alpha), 1, 1e-9);
    for (std::size_t s = 0; s < scene.masters(); ++s) EXPECT_NEAR(sum(scene.follow[s]), 1, 1e-9);
    for (std::size_t s = scene.masters(); s < scene.seats.size(); ++s) EXPECT_EQ(scene.seats[s].kind, SeatKind::kSlave);
  }
}

TEST(ShippedScenes, TransferAuthorityAtElevenAndAHalfInFreeMotion) {
  const auto scene = shipped("free_motion");
  EXPECT_EQ(scene.duration, 18);
  ASSERT_EQ(scene.seats.size(), 2u);
  const auto& trainer = scene.seats[0].hand;
  const auto& trainee = scene.seats[1].hand;
  EXPECT_EQ(trainer.until, 11.5);
  EXPECT_EQ(trainee.from, 11.5);
  EXPECT_TRUE(std::isinf(trainee.until));
  EXPECT_EQ(trainer.k, 1000);
  EXPECT_EQ(trainer.trajectory.radius, 0.05);
  EXPECT_EQ(trainer.trajectory.plane, 'y');
  ASSERT_EQ(trainer.deviations.size(), 1u);
  EXPECT_EQ(trainer.deviations[0].at, 14);
  ASSERT_EQ(trainee.deviations.size(), 1u);
  EXPECT_EQ(trainee.deviations[0].at, 7);
  EXPECT_EQ(trainee.deviations[0].length, 1.5);
  EXPECT_EQ(trainee.deviations[0].force.x, 2);
  ASSERT_EQ(scene.timeline.size(), 1u);
  EXPECT_EQ(scene.timeline[0].at, 11.5);
  EXPECT_EQ(scene.timeline[0].row.alpha[1], 1);
  ASSERT_EQ(scene.phases.size(), 2u);
  EXPECT_EQ(scene.phases[1].from, 12);
  EXPECT_EQ(scene.alpha_slew, 1);
}

TEST(ShippedScenes, StayWithinTheForceOfATouchInContact) {
  const auto scene = shipped("contact");
  const double wall = scene.tools[0].environment.wall->k,
               intended = scene.seats[0].hand.trajectory.waypoints.back().p.x;
  const double peak = intended / (1 / scene.seats[0].hand.k + 1 / scene.coupling.k_c + 1 / wall);
  EXPECT_GT(peak, 2.5);
  EXPECT_LT(peak, 3.0);
  EXPECT_LE(intended - peak / scene.seats[0].hand.k, 0.008) << "the hand itself presses no deeper than 8 mm";
  EXPECT_EQ(scene.seats[1].hand.from, 12);
  EXPECT_EQ(scene.seats[1].hand.trajectory.waypoints.back().p.x, scene.seats[0].hand.trajectory.waypoints.back().p.x);
  ASSERT_TRUE(scene.tools[0].environment.wall.has_value());
  EXPECT_EQ(scene.tools[0].environment.wall->k, 20000);
  EXPECT_EQ(scene.tools[0].slave.start.x, -0.02);
  EXPECT_EQ(scene.gate.loop_age_max, 2.5);
}

TEST(ShippedScenes, MatchContactInRemoteContactExceptForTheSlaveSeat) {
  const auto here = shipped("contact");
  const auto remote = shipped("contact_remote");
  ASSERT_EQ(remote.seats.size(), 3u);
  EXPECT_EQ(remote.masters(), 2u);
  EXPECT_TRUE(remote.tools[0].remote);
  EXPECT_EQ(remote.tools[0].seat, 2u);
  EXPECT_EQ(remote.seats[2].name, "slave");
  EXPECT_EQ(remote.seats[2].environment.wall->k, here.tools[0].environment.wall->k);
  EXPECT_EQ(remote.tools[0].environment.wall->k, here.tools[0].environment.wall->k);
  EXPECT_EQ(remote.channel.law, LawKind::kSetPosition)
      << "three springs lie between its hands and the wall, so they press deeper";
  EXPECT_EQ(remote.seats[0].hand.trajectory.waypoints[1].p.x, here.seats[0].hand.trajectory.waypoints[1].p.x);
}

TEST(ShippedScenes, HaveTheGainsOfThePaperInSeed) {
  for (const char* name : {"seed_free_motion", "seed_contact"}) {
    SCOPED_TRACE(name);
    const auto scene = shipped(name);
    EXPECT_EQ(scene.port, PortSpace::kJoint);
    EXPECT_TRUE(scene.unsafe_gains);
    EXPECT_TRUE(std::isinf(scene.alpha_slew));
    EXPECT_EQ(scene.channel.k, 750);
    EXPECT_EQ(scene.coupling.k_c, 750);
    EXPECT_EQ(scene.tools[0].k_s, 750);
    EXPECT_EQ(scene.coupling.b, 12);
    EXPECT_EQ(scene.tools[0].b_s, 12);
    EXPECT_FALSE(scene.seats[0].device.gravity_compensation);
    EXPECT_EQ(scene.seats[1].hand.relaxed_b, 6);
  }
  EXPECT_TRUE(shipped("seed_contact").commanded_force);
  EXPECT_FALSE(shipped("seed_free_motion").commanded_force);
}

TEST(ShippedScenes, HaveNoEndNoTimelineAndFiveSeatsInLesson) {
  const auto lesson = shipped("lesson");
  EXPECT_TRUE(lesson.endless());
  EXPECT_TRUE(lesson.timeline.empty());
  EXPECT_TRUE(lesson.phases.empty());
  EXPECT_FALSE(lesson.clock_runs_while_stopped);
  ASSERT_EQ(lesson.seats.size(), 5u);
  const std::array<std::pair<Role, bool>, 5> seats{{{Role::kInstructor, true},
                                                    {Role::kTrainee, true},
                                                    {Role::kEvaluator, false},
                                                    {Role::kEvaluator, false},
                                                    {Role::kEvaluator, false}}};
  for (std::size_t i = 0; i < seats.size(); ++i) {
    EXPECT_EQ(lesson.seats[i].role, seats[i].first);
    EXPECT_EQ(lesson.seats[i].required, seats[i].second);
    EXPECT_TRUE(std::isinf(lesson.seats[i].hand.until)) << "no hand is relaxed by the clock";
    EXPECT_EQ(lesson.seats[i].hand.from, 0);
  }
  EXPECT_TRUE(lesson.gate.latch) << "fit for real devices";
  EXPECT_LE(lesson.gate.loop_age_max, 0.3);
  const std::string listing = effective_scene_text(lesson);
  EXPECT_NE(listing.find("duration_s: none given, the session lasts until it is ended"), std::string::npos);
  EXPECT_NE(listing.find("clock_runs_while_stopped"), std::string::npos);
}

TEST(ShippedScenes, HaveTheSeatsOfTheirNames) {
  const auto one = shipped("one_axis");
  EXPECT_EQ(one.dof, 1u);
  EXPECT_EQ(one.seats[0].device.model, DeviceModel::kLinear);
  EXPECT_EQ(one.seats[0].device.encoder, 5.5e-5);
  EXPECT_TRUE(one.phases.empty()) << "its report covers the whole session";
  const auto eight = shipped("eight_seats");
  EXPECT_EQ(eight.seats.size(), 8u);
  EXPECT_EQ(eight.seats[7].role, Role::kEvaluator);
  const auto two = shipped("two_by_two");
  EXPECT_EQ(two.tools.size(), 2u);
  EXPECT_EQ(two.follow[0][0], 1);
  EXPECT_EQ(two.follow[1][1], 1);
}

TEST(EffectiveScene, ListsDefaultsWithUnitsInColumns) {
  const auto text = effective_scene_text(shipped("one_axis"));
  const auto line = [&](const std::string& key) {
    const auto at = text.find("\n" + key + " ");
    return at == std::string::npos ? std::string() : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
  };
  EXPECT_TRUE(line("channel.e0_j").ends_with(" J")) << text;
  EXPECT_NE(line("channel.e0_j").find("0.05"), std::string::npos);
  EXPECT_NE(line("channel.law").find("REPLICA"), std::string::npos);
  EXPECT_NE(effective_scene_text(shipped("seed_contact")).find("0.09075"), std::string::npos) << "F^2 / (2 k_min)";
  EXPECT_NE(line("seat[0].device.encoder_m").find("5.5e-5"), std::string::npos) << text;
  EXPECT_EQ(line("tick_hz").find("1000"), line("gate.silence_limit_ms").find("20"));
}

/// The listing of `--check` contains the whole scene: more than 40 lines, and no nan or inf.
TEST(EffectiveScene, RoundTripsEveryShippedScene) {
  for (const auto& entry : shipped_scenes()) {
    SCOPED_TRACE(entry.name);
    const auto listing = effective_scene_text(shipped(entry.name));
    EXPECT_EQ(listing.find("nan"), std::string::npos);
    EXPECT_EQ(listing.find("inf"), std::string::npos);
    EXPECT_GT(std::count(listing.begin(), listing.end(), '\n'), 40);
  }
}

}  // namespace
}  // namespace tandem
