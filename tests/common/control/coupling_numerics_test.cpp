// Integration of the coupling between a hand and its tool. Under law REPLICA its spring is part of the tool's step, so
// that the numerics of the tool step it. Under other laws it has a virtual mass, stepped once per tick by implicit
// Euler. Both against the closed form of a damped oscillator.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/control/channel_replica.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"

namespace tandem::control {
namespace {

constexpr double kT = 1e-3, kMass = 0.02, kStiffness = 400, kDamping = 0.2, kHand = 1e-3;
constexpr int kTicks = 30;  ///< two thirds of a period

/// Position of a mass at rest at 0, `t` after its spring's end was moved to kHand.
double closed_form(double m, double k, double b, double t) {
  const double decay = b / (2 * m), w = std::sqrt(k / m - decay * decay);
  return kHand * (1 - std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t)));
}

/// Error of the copy of a hand that leads alone [m].
double copy_error(Integrator how, std::uint8_t substeps, Precision precision = Precision::kDouble) {
  ToolCopy copy({.tool = {.m = kMass, .b = kDamping},
                 .axes = 1,
                 .contacts = {},
                 .k_c = kStiffness,
                 .b_rel = 0,
                 .numerics = {how, precision, substeps},
                 .assist = {}});
  ChannelParams params;
  params.dof = 1;
  params.effort_max = 3.3;
  ReplicaReference end(params);
  AxisArray hand{};
  copy.rest_at(hand, hand);
  end.engage(hand, 0);
  EndInput in;
  in.authority = 1;
  hand[0] = kHand;
  const auto tick = [&] {
    in.x[0] = copy.tool().x(0);
    in.dissipated[0] = copy.dissipated(0);
    end.move(in);
    copy.delivered(copy.step(hand, 1, end));
  };
  tick();  // the gate passes nothing before the first wanted effort: the copy rests
  EXPECT_EQ(copy.tool().x(0), 0);
  for (int i = 0; i < kTicks; ++i) tick();
  return std::abs(copy.tool().x(0) - closed_form(kMass, kStiffness, kDamping, kTicks * kT));
}
double copy_order(Integrator how, std::uint8_t substeps) {
  return std::log2(copy_error(how, substeps) / copy_error(how, static_cast<std::uint8_t>(2 * substeps)));
}

TEST(CouplingNumerics, TheSpringOfAHandConvergesWithTheOrderOfTheToolsIntegrator) {
  EXPECT_NEAR(copy_order(Integrator::kImplicitEuler, 16), 1, 0.1);
  EXPECT_NEAR(copy_order(Integrator::kSemiImplicitEuler, 16), 1, 0.1);
  EXPECT_NEAR(copy_order(Integrator::kImplicitMidpoint, 4), 2, 0.05);
  EXPECT_NEAR(copy_order(Integrator::kRk4, 2), 4, 0.15);
}

TEST(CouplingNumerics, TheSpringOfAHandIsExactWithTheMatrixExponential) {
  EXPECT_LT(copy_error(Integrator::kExact, 1), 1e-15);
  EXPECT_LT(copy_error(Integrator::kExact, 1, Precision::kFloat), 2e-9);
}

/// Error of the virtual mass of the other laws after the same time [m].
double ipc_error(int steps_per_tick) {
  MasterIpc ipc;
  const double h = kT / steps_per_tick;
  for (int i = 0; i < kTicks * steps_per_tick; ++i) ipc.step({kStiffness, kDamping, kMass}, h, kHand, 0, 0, 0);
  return std::abs(ipc.x - closed_form(kMass, kStiffness, kDamping, kTicks * kT));
}

TEST(CouplingNumerics, TheVirtualMassOfOtherLawsConvergesWithOrderOne) {
  EXPECT_NEAR(std::log2(ipc_error(16) / ipc_error(32)), 1, 0.1);
}

}  // namespace
}  // namespace tandem::control
