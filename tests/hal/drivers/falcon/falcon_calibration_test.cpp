#include "hal/drivers/falcon/falcon_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/core/servo_core.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

const std::array<double, 3> kTruth{9000, 10000, 12000};

/// A Falcon with an unknown motor scale, upright or on its back.
struct Scale {
  Scale(const Vec3& direction, const FalconSpec& file, double friction) : up(direction) {
    emulation::FalconModelSpec spec = falcon::ready_model();
    spec.mechanics.counts_per_nm = kTruth;
    spec.mechanics.up = direction;
    spec.mechanics.friction = friction;
    model.emplace(spec);
    clock.emplace(*model);
    pipe.emplace(*model, *clock, kFalconOut, kFalconIn);
    core.emplace(std::make_unique<FalconDriver>(*FalconDriver::make({"falcon", "1"}, *pipe, *clock, {file, {}})));
    force = *FalconForce::from(file);
    falcon::Watcher watcher;
    EXPECT_TRUE(core->bring_up(watcher));
    FalconCalibration nobody(Vec3::Zero(), up);
    for (int i = 0; i < 20; ++i) step(nobody);
    EXPECT_TRUE(core->enable());
  }
  void step(FalconCalibration& client) {
    const Time next = clock->now() + 1ms;
    (void)core->step(clock->now(), client);
    clock->wait_until(next);
  }
  std::expected<FalconCalibration::Measurement, std::string> weigh(double mass) {
    model->mechanics().set_load(mass);
    FalconCalibration weighing(Vec3::Zero(), up);
    for (int i = 0; i < 20'000 && !weighing.finished(); ++i) step(weighing);
    EXPECT_TRUE(weighing.finished());
    EXPECT_EQ(core->phase(), Phase::kEnabled);
    return weighing.measurement();
  }
  FalconMassReading reading(double mass) {
    FalconMassReading r{
        .mass = mass, .up = {up[0], up[1], up[2]}, .encoder = {}, .motor_without = {}, .motor_with = {}};
    const auto without = weigh(0), with = weigh(mass);
    EXPECT_TRUE(without && with) << (without ? "" : without.error()) << (with ? "" : with.error());
    if (!without || !with) return r;
    r.encoder = with->encoder;
    for (std::size_t i = 0; i < 3; ++i) {
      r.motor_without[i] = -without->torque[i] * force.counts_per_nm()[i];
      r.motor_with[i] = -with->torque[i] * force.counts_per_nm()[i];
    }
    return r;
  }
  Vec3 up;
  FalconForce force;
  std::optional<emulation::FalconModel> model;
  std::optional<emulation::ModelClock> clock;
  std::optional<emulation::UsbModelPipe> pipe;
  std::optional<ServoCore> core;
};

// The whole procedure of a user: a light mass under the small ceiling, then heavier ones with the resulting scale.
TEST(FalconCalibration, FindsTheMotorsScaleFromNothingInTwoRounds) {
  const Vec3 back(0, -1, 0);
  FalconSpec first;
  {
    Scale scale(back, FalconSpec{}, 0.02);
    first.readings = {scale.reading(0.02), scale.reading(0.03)};
  }
  const auto rough = fit_falcon_scale(first.readings);
  ASSERT_TRUE(rough) << rough.error().text;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*rough)[i], kTruth[i], 0.08 * kTruth[i]);
  FalconSpec second;
  {
    Scale scale(back, first, 0.02);
    second.readings = {scale.reading(0.1), scale.reading(0.2)};
  }
  const auto fine = fit_falcon_scale(second.readings);
  ASSERT_TRUE(fine) << fine.error().text;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*fine)[i], kTruth[i], 0.02 * kTruth[i]);
  std::printf("[ measured ] scale found: %.0f %.0f %.0f of %.0f %.0f %.0f, rough %.0f %.0f %.0f\n", (*fine)[0],
              (*fine)[1], (*fine)[2], kTruth[0], kTruth[1], kTruth[2], (*rough)[0], (*rough)[1], (*rough)[2]);
}

TEST(FalconCalibration, ReportsAMassTooHeavyForTheMotors) {
  Scale scale(Vec3(0, -1, 0), FalconSpec{}, 0);
  const auto held = scale.weigh(0.3);
  ASSERT_FALSE(held);
  EXPECT_NE(held.error().find("lighter"), std::string::npos) << held.error();
}

TEST(FalconCalibration, NamesTheRemedyForATooHeavyGrip) {
  Scale scale(Vec3(0, -1, 0), FalconSpec{}, 0);
  scale.model->mechanics().set_load(0.3);
  FalconCalibration weighing(Vec3::Zero(), scale.up);
  for (int i = 0; i < 20'000 && !weighing.finished(); ++i) scale.step(weighing);
  const auto held = weighing.measurement(FalconCalibration::Load::kEmptyGrip);
  ASSERT_FALSE(held);
  for (const char* cure : {"--orientation upright", "counterweight"})
    EXPECT_NE(held.error().find(cure), std::string::npos) << held.error();
  EXPECT_EQ(held.error().find("lighter mass"), std::string::npos) << held.error();
}

TEST(FalconCalibration, PredictsTheLargestWeightTheMotorsHold) {
  const Vec3 lying(0, -1, 0), standing(0, 0, 1);
  // At the middle 1 N along the axis is 0.0249 N m per leg. 120 counts of the guess, 0.06 N m, hold 2.41 N.
  EXPECT_NEAR(FalconCalibration::weight_max(FalconForce{}, Vec3::Zero(), lying), 0.06 / 0.0249, 0.05);
  // 4095 counts at 10000 per N m hold 16 N; the result is limited to kForceMax.
  EXPECT_EQ(FalconCalibration::weight_max(*FalconForce::from(falcon::calibrated()), Vec3::Zero(), lying),
            FalconCalibration::kForceMax);
  EXPECT_EQ(FalconCalibration::weight_max(FalconForce{}, Vec3(1, 0, 0), lying), 0) << "beyond the reach";
  EXPECT_GT(FalconCalibration::weight_max(FalconForce{}, Vec3::Zero(), standing), 0.5);
}

TEST(FalconCalibration, ReportsThatAHandHoldsTheGrip) {
  Scale scale(Vec3(0, -1, 0), falcon::calibrated(), 0);
  scale.model->mechanics().set_pull({.k = 20000, .b = 50, .m = 0.1, .x = Vec3(0.001, 0, 0)});
  const auto held = scale.weigh(0);
  ASSERT_FALSE(held);
  EXPECT_NE(held.error().find("rest"), std::string::npos) << held.error();
}

TEST(FalconCalibration, RequestsNothingWhenUnhomedOrFinished) {
  FalconCalibration weighing(Vec3::Zero(), Vec3::UnitZ());
  State state;
  state.J.leftCols<3>() = Eigen::Matrix3d::Identity();
  state.x = Vec3(0.1, 0, 0);
  state.homed = false;
  EXPECT_EQ(weighing.tick(state).effort, AxisArray{});
  state.homed = true;
  const Command command = weighing.tick(state);
  EXPECT_LE(std::hypot(command.effort[0], command.effort[1], command.effort[2]), FalconCalibration::kForceMax + 1e-12);
  state.sampled_at += FalconCalibration::length();
  EXPECT_EQ(weighing.tick(state).effort, AxisArray{});
  EXPECT_TRUE(weighing.finished());
  EXPECT_FALSE(weighing.measurement()) << "nothing was averaged";
}

}  // namespace
}  // namespace tandem::hal
