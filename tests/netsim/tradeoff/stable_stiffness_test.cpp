// The stability limits that the table prints, against the eigenvalues of the one-step map.
#include "netsim/tradeoff/stable_stiffness.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

namespace tandem::netsim::tradeoff {
namespace {

using control::Integrator;
using control::Numerics;
using control::Precision;

/// Spectral radius of the map (x, v) -> (x+, v+) of one explicit step, written down by its definition.
double spectral_radius(Integrator how, double h, double m, double b, double k) {
  Eigen::Matrix2d rate;
  rate << 0, 1, -k / m, -b / m;
  Eigen::Matrix2d map;
  if (how == Integrator::kSemiImplicitEuler) {
    map << 1 - h * h * k / m, h - h * h * b / m, -h * k / m, 1 - h * b / m;
  } else {  // RK4: the exponential's series up to the fourth power
    const Eigen::Matrix2d a = h * rate;
    map = Eigen::Matrix2d::Identity() + a + a * a / 2 + a * a * a / 6 + a * a * a * a / 24;
  }
  return map.eigenvalues().cwiseAbs().maxCoeff();
}

double limit_by_eigenvalues(Integrator how, const ToolTask& task, double h) {
  const auto radius = [&](double k) {
    return spectral_radius(how, h, task.tool.m, task.tool.b + task.b_rel, task.k_c + k);
  };
  if (radius(1) > 1) return 0;
  double lo = 1, hi = 1e12;
  for (int i = 0; i < 200; ++i) {
    const double k = std::sqrt(lo * hi);
    (radius(k) > 1 ? hi : lo) = k;
  }
  return lo;
}

TEST(StableStiffness, MatchesTheEigenvaluesOfTheStep) {
  ToolTask task;
  for (const double b_rel : {0.0, 4.0, 14.0})
    for (const double tick_hz : {500.0, 1000.0, 4000.0})
      for (const std::uint8_t substeps : {std::uint8_t{1}, std::uint8_t{4}})
        for (const Integrator how : {Integrator::kSemiImplicitEuler, Integrator::kRk4})
          for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
            task.b_rel = b_rel;
            const double exact = limit_by_eigenvalues(how, task, 1 / (tick_hz * substeps));
            const double found = stable_stiffness(task, tick_hz, {how, precision, substeps});
            const std::string where = std::string(control::kIntegratorNames[static_cast<std::size_t>(how)]) + " " +
                                      std::to_string(tick_hz) + " Hz, " + std::to_string(b_rel) + " N s/m, " +
                                      std::to_string(substeps);
            if (exact >= kStiffnessMost) {
              EXPECT_EQ(found, kStiffnessMost) << where;
            } else {
              EXPECT_NEAR(found, exact, 0.01 * exact) << where;
            }
          }
}

// h^2 k / m < 4 - 2 h b / m: the limit of the symplectic step in closed form.
TEST(StableStiffness, MatchesTheClosedFormOfTheSemiImplicitStep) {
  ToolTask task;
  const double h = 1e-3, m = task.tool.m, b = task.tool.b + task.b_rel;
  const double limit = (4 - 2 * h * b / m) * m / (h * h) - task.k_c;
  EXPECT_NEAR(stable_stiffness(task, 1000, {Integrator::kSemiImplicitEuler, Precision::kDouble, 1}), limit,
              0.01 * limit);
}

TEST(StableStiffness, HasNoLimitForImplicitAndExactSteps) {
  for (const Integrator how : {Integrator::kImplicitEuler, Integrator::kImplicitMidpoint, Integrator::kExact})
    for (const Precision precision : {Precision::kDouble, Precision::kFloat})
      EXPECT_EQ(stable_stiffness({}, 100, {how, precision, 1}), kStiffnessMost)
          << control::kIntegratorNames[static_cast<std::size_t>(how)];
}

TEST(StableStiffness, IsZeroWhereTheDamperAloneIsUnstable) {  // h (b + b_rel) / m = 7.1 > 2
  EXPECT_EQ(stable_stiffness({}, 100, {Integrator::kSemiImplicitEuler, Precision::kDouble, 1}), 0);
}

}  // namespace
}  // namespace tandem::netsim::tradeoff
