#include "hal/falcon/falcon_weighing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/servo_core.h"
#include "tests/hal/falcon/bench.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

const std::array<double, 3> kTruth{9000, 10000, 12000};

/// A Falcon whose motors are worth what nobody knows, standing or on its back.
struct Scale {
  Scale(const Vec3& direction, const FalconSpec& file, double friction) : up(direction) {
    wire::FalconModelSpec spec = falcon::ready_model();
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
    FalconWeighing nobody(Vec3::Zero(), up);
    for (int i = 0; i < 20; ++i) step(nobody);
    EXPECT_TRUE(core->enable());
  }
  void step(FalconWeighing& client) {
    const Time next = clock->now() + 1ms;
    (void)core->step(clock->now(), client);
    clock->wait_until(next);
  }
  std::expected<FalconWeighing::Held, std::string> weigh(double mass) {
    model->mechanics().set_load(mass);
    FalconWeighing weighing(Vec3::Zero(), up);
    for (int i = 0; i < 20'000 && !weighing.finished(); ++i) step(weighing);
    EXPECT_TRUE(weighing.finished());
    EXPECT_EQ(core->phase(), Phase::kEnabled);
    return weighing.held();
  }
  FalconMassReading reading(double mass) {
    FalconMassReading r{.mass = mass, .up = {up[0], up[1], up[2]}, .encoder = {}, .motor_without = {}, .motor_with = {}};
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
  std::optional<wire::FalconModel> model;
  std::optional<wire::ModelClock> clock;
  std::optional<wire::UsbModelPipe> pipe;
  std::optional<ServoCore> core;
};

// The whole procedure, as an owner does it: a light mass under the small ceiling, then heavier ones with that scale.
TEST(FalconWeighing, FindsTheMotorsScaleFromNothingInTwoRounds) {
  const Vec3 back(0, -1, 0);
  FalconSpec first;
  {
    Scale scale(back, FalconSpec{}, 0.02);
    first.readings = {scale.reading(0.02), scale.reading(0.03)};
  }
  const auto rough = fit_falcon_scale(first.readings);
  ASSERT_TRUE(rough) << rough.error().words;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*rough)[i], kTruth[i], 0.08 * kTruth[i]);
  FalconSpec second;
  {
    Scale scale(back, first, 0.02);
    second.readings = {scale.reading(0.1), scale.reading(0.2)};
  }
  const auto fine = fit_falcon_scale(second.readings);
  ASSERT_TRUE(fine) << fine.error().words;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*fine)[i], kTruth[i], 0.02 * kTruth[i]);
  std::printf("[ measured ] scale found: %.0f %.0f %.0f of %.0f %.0f %.0f, rough %.0f %.0f %.0f\n", (*fine)[0], (*fine)[1],
              (*fine)[2], kTruth[0], kTruth[1], kTruth[2], (*rough)[0], (*rough)[1], (*rough)[2]);
}

TEST(FalconWeighing, SaysThatTheMassIsTooHeavyForTheMotors) {
  Scale scale(Vec3(0, -1, 0), FalconSpec{}, 0);
  const auto held = scale.weigh(0.3);
  ASSERT_FALSE(held);
  EXPECT_NE(held.error().find("lighter"), std::string::npos) << held.error();
}

TEST(FalconWeighing, SaysWhatToDoWithAGripThatIsTooHeavyByItself) {
  Scale scale(Vec3(0, -1, 0), FalconSpec{}, 0);
  scale.model->mechanics().set_load(0.3);
  FalconWeighing weighing(Vec3::Zero(), scale.up);
  for (int i = 0; i < 20'000 && !weighing.finished(); ++i) scale.step(weighing);
  const auto held = weighing.held(FalconWeighing::Load::kEmptyGrip);
  ASSERT_FALSE(held);
  for (const char* cure : {"standing", "counterweight"}) EXPECT_NE(held.error().find(cure), std::string::npos) << held.error();
  EXPECT_EQ(held.error().find("lighter mass"), std::string::npos) << held.error();
}

TEST(FalconWeighing, KnowsBeforehandWhatNoMotorHolds) {
  const Vec3 lying(0, -1, 0), standing(0, 0, 1);
  // At the middle 1 N along the axis is 0.0249 N m per leg (hal.md): 120 counts of the guess, 0.06 N m, hold 2.41 N.
  EXPECT_NEAR(FalconWeighing::holds(FalconForce{}, Vec3::Zero(), lying), 0.06 / 0.0249, 0.05);
  // 4095 counts at 10000 per N m hold 16 N; no more than kForceMax is asked.
  EXPECT_EQ(FalconWeighing::holds(*FalconForce::from(falcon::calibrated()), Vec3::Zero(), lying), FalconWeighing::kForceMax);
  EXPECT_EQ(FalconWeighing::holds(FalconForce{}, Vec3(1, 0, 0), lying), 0) << "beyond the reach";
  EXPECT_GT(FalconWeighing::holds(FalconForce{}, Vec3::Zero(), standing), 0.5);
}

TEST(FalconWeighing, SaysThatSomebodyHoldsTheGrip) {
  Scale scale(Vec3(0, -1, 0), falcon::calibrated(), 0);
  scale.model->mechanics().set_pull({.k = 20000, .b = 50, .m = 0.1, .x = Vec3(0.001, 0, 0)});
  const auto held = scale.weigh(0);
  ASSERT_FALSE(held);
  EXPECT_NE(held.error().find("rest"), std::string::npos) << held.error();
}

TEST(FalconWeighing, AsksForNothingUnhomedAndWhenItIsOver) {
  FalconWeighing weighing(Vec3::Zero(), Vec3::UnitZ());
  State state;
  state.J.leftCols<3>() = Eigen::Matrix3d::Identity();
  state.x = Vec3(0.1, 0, 0);
  state.homed = false;
  EXPECT_EQ(weighing.tick(state).effort, AxisArray{});
  state.homed = true;
  const Command command = weighing.tick(state);
  EXPECT_LE(std::hypot(command.effort[0], command.effort[1], command.effort[2]), FalconWeighing::kForceMax + 1e-12);
  state.sampled_at += FalconWeighing::length();
  EXPECT_EQ(weighing.tick(state).effort, AxisArray{});
  EXPECT_TRUE(weighing.finished());
  EXPECT_FALSE(weighing.held()) << "nothing was averaged";
}

}  // namespace
}  // namespace tandem::hal
