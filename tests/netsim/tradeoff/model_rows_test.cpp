// Models and numerics of devices in the table of cost and error: tiers that a scene allows, the reference against a
// closed form and another code, orders of the errors, the front, the page.
#include "netsim/tradeoff/model_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "netsim/tradeoff/tradeoff.h"

namespace tandem::netsim::tradeoff {
namespace {

constexpr auto kAlways = [](std::size_t) { return true; };

SceneSpec scene_of(std::size_t dof, bool wall = false, bool tissue = false) {
  SceneSpec scene;
  scene.name = "some";
  scene.dof = dof;
  scene.seats.emplace_back();
  scene.seats[0].device.model = dof == 1 ? DeviceModel::kLinear : DeviceModel::kTouch;
  scene.seats[0].device.friction = 0;
  scene.tools.emplace_back();
  if (wall) scene.tools[0].environment.wall.emplace();
  if (tissue) scene.tools[0].environment.tissue.emplace();
  return scene;
}
std::string names_of(const std::vector<ModelChoice>& choices) {
  std::string out;
  for (const ModelChoice& choice : choices)
    out += std::string(kModelTierNames[static_cast<std::size_t>(choice.model)]) + " on " +
           std::string(kContactTierNames[static_cast<std::size_t>(choice.contact)]) + "; ";
  return out;
}

TEST(ModelTiers, AreThoseThatTheSceneAllows) {
  EXPECT_EQ(names_of(tier_choices(scene_of(1))), "point on none; virtual tool on none; ");
  EXPECT_EQ(names_of(tier_choices(scene_of(3, true, true))),
            "virtual tool on none; arm on none; arm with friction and gravity on none; "
            "virtual tool on plane; arm on plane; arm with friction and gravity on plane; "
            "virtual tool on tissue; arm on tissue; arm with friction and gravity on tissue; "
            "virtual tool on friction; ");
}

TEST(ModelTiers, AreFurtherFromTheFullestTheSimplerTheyAre) {
  const auto tiers = tier_choices(scene_of(3));
  auto rows = measure_models(tiers, {}, kAlways);
  compare_tiers(rows);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_FALSE(rows[2].apart_path_m) << "the fullest itself";
  ASSERT_TRUE(rows[0].apart_path_m && rows[1].apart_path_m);
  EXPECT_GT(*rows[0].apart_path_m, *rows[1].apart_path_m);
  EXPECT_GT(*rows[1].apart_path_m, *rows[1].path_rms_m) << "the model errs by more than its steps";
}

TEST(ModelTiers, ReportNoErrorWhereNoReferenceExists) {
  const auto tiers = tier_choices(scene_of(3, true));
  const auto rows = measure_models({tiers.back()}, {}, kAlways);
  ASSERT_EQ(rows.at(0).choice.contact, ContactTier::kFriction);
  EXPECT_TRUE(rows[0].stable);
  EXPECT_FALSE(rows[0].path_rms_m || rows[0].force_rms_n || rows[0].energy_rms_j);
}

/// Choices of one integrator at one tick rate for a device without friction.
double force_error(const SceneSpec& scene, IntegratorKind how, double tick_hz, std::uint8_t substeps) {
  ModelChoice choice = device_choices(scene, {tick_hz}, {substeps})[0];
  choice.numerics = NumericsSpec{.integrator = how, .substeps = substeps};
  return measure_models({choice}, {}, kAlways).at(0).force_rms_n.value();
}

// Between ticks the hand moves on straight lines: the floor of every integrator, of second order. Motors that balance a
// weight hold their effort for a tick, which is of first order.
TEST(DeviceReference, ShowsThatAHandOnStraightLinesErrsBySecondOrder) {
  for (const std::size_t dof : {std::size_t{1}, std::size_t{3}}) {
    SceneSpec scene = scene_of(dof);
    scene.seats[0].device.gravity = false;
    const double coarse = force_error(scene, IntegratorKind::kRk4, 500, 8);
    const double fine = force_error(scene, IntegratorKind::kRk4, 1000, 8);
    EXPECT_NEAR(coarse / fine, 4, 0.4) << dof << " axes: " << coarse << " and " << fine << " N";
    EXPECT_LT(fine, 2e-3) << "two codes agree";
  }
}

TEST(DeviceRows, ShowTheOrderOfEachIntegrator) {
  const SceneSpec scene = scene_of(1);
  const auto order = [&](IntegratorKind how, std::uint8_t substeps) {
    return std::log2(force_error(scene, how, 200, substeps) /
                     force_error(scene, how, 200, static_cast<std::uint8_t>(2 * substeps)));
  };
  EXPECT_NEAR(order(IntegratorKind::kImplicitEuler, 2), 1, 0.15);
  EXPECT_NEAR(order(IntegratorKind::kSemiImplicitEuler, 2), 1, 0.25);
}

TEST(DeviceRows, AreTheBuiltInSchemeAndAllNumericsThatFitTheDevice) {
  SceneSpec scene = scene_of(3);
  EXPECT_EQ(device_choices(scene, {500, 1000}, {1, 4}).size(), 2u * (1 + 5 * 2 * 2));
  scene.seats[0].device.friction = 0.1;
  const auto choices = device_choices(scene, {1000}, {1});
  EXPECT_EQ(choices.size(), 1u + 3 * 2) << "explicit integrators do not follow friction";
  EXPECT_FALSE(choices[0].numerics);
}

TEST(DeviceRows, AreOfTheSlaveWhereADeviceMovesTheTool) {
  SceneSpec scene = scene_of(3, true);
  scene.tools[0].is_virtual = false;
  scene.tools[0].slave.friction = 0;
  scene.tools[0].slave.gravity = false;
  const auto choices = device_choices(scene, {1000}, {1});
  EXPECT_EQ(choices[0].model, ModelTier::kArm);
  EXPECT_EQ(choices[0].contact, ContactTier::kPlane);
  const auto rows = measure_models(choices, {}, kAlways);
  EXPECT_TRUE(rows[0].stable);
  EXPECT_LT(*rows[0].path_rms_m, 1e-4);
}

TEST(DeviceRows, MarkTheFrontAndUnstableRows) {
  SceneSpec scene = scene_of(1, true);
  scene.tools[0].is_virtual = false;
  scene.tools[0].slave = scene.seats[0].device;
  scene.tools[0].environment.wall->k = 1e7;  // h^2 k / m = 100: beyond the limits of all explicit steps
  auto rows = measure_models(device_choices(scene, {1000}, {1}), {}, kAlways);
  mark_pareto(rows);
  const auto of = [&](IntegratorKind how) {
    return *std::ranges::find_if(
        rows, [&](const ModelRow& row) { return row.choice.numerics && row.choice.numerics->integrator == how; });
  };
  EXPECT_TRUE(of(IntegratorKind::kImplicitEuler).stable);
  EXPECT_FALSE(of(IntegratorKind::kRk4).stable);
  EXPECT_TRUE(std::ranges::any_of(rows, &ModelRow::pareto));
  for (const ModelRow& row : rows) {
    EXPECT_TRUE(row.stable || !row.pareto);
  }
}

TEST(DeviceRows, StopWhereTheCallerSays) {
  const auto rows = measure_models(device_choices(scene_of(1), {1000}, {1}), {}, [](std::size_t i) { return i < 2; });
  EXPECT_EQ(rows.size(), 2u);
}

TEST(TradeoffPage, HasEveryTableOnceAndEscapesNames) {
  Tradeoff all = run_tradeoff(
      scene_of(1), {.ticks_hz = {1000}, .substeps = {1}}, [](const control::Numerics&) { return Cost{}; },
      [](std::size_t, std::size_t) { return true; });
  all.scene = "<b>";
  all.tiers = measure_models(tier_choices(scene_of(1)), {}, kAlways);
  all.devices = measure_models(device_choices(scene_of(1), {1000}, {1}), {}, kAlways);
  const std::string page = tradeoff_page(all, false, "1.2.3");
  EXPECT_EQ(page, tradeoff_page(all, false, "1.2.3"));
  for (const std::string part : {"id=\"tool\"", "id=\"device\"", "id=\"models\"", "Tandem 1.2.3", "built_in", "<svg"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const std::string part : {"<b>", "<script", "href=\"http", "src=", "nan"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  const std::string csv = tradeoff_csv(all, false);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 10 + 2 + 11);
  const auto columns = std::ranges::count(csv.substr(0, csv.find('\n')), ',');
  std::size_t from = 0;
  for (std::size_t end; (end = csv.find('\n', from)) != std::string::npos; from = end + 1)
    EXPECT_EQ(std::ranges::count(csv.substr(from, end - from), ','), columns) << csv.substr(from, end - from);
  all.rows.clear();
  all.advice.clear();
  EXPECT_EQ(tradeoff_page(all, false, "1").find("id=\"tool\""), std::string::npos) << "a tool that a device moves";
}

}  // namespace
}  // namespace tandem::netsim::tradeoff
