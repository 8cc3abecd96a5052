#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace tandem::test {

/// Exact step of a free mass with damping under a held force: [x v] after T, from [x v] and F.
struct HeldMass {
  Eigen::Matrix2d A;
  Eigen::Vector2d B;
  HeldMass(double m, double b, double T) {
    if (b * T / m < 1e-9) {
      A << 1, T, 0, 1 - b * T / m;
      B << T * T / (2 * m), T / m;
      return;
    }
    const double e = std::exp(-b * T / m);
    A << 1, m / b * (1 - e), 0, e;
    B << (T - m / b * (1 - e)) / b, (1 - e) / b;
  }
};

/// Mass [kg] with damping [N s/m] against a virtual wall that is sampled every T [s] and responds `delay` ticks late.
/// The force is held for one tick: F(k) = -K x(k - delay) - B [x(k - delay) - x(k - delay - 1)] / T.
struct SampledWall {
  double m = 0.045, b = 0.1, B = 0, T = 0.001;
  int delay = 0;

  /// Returns the largest magnitude of an eigenvalue of one tick; the loop is stable below 1. Exact, without a
  /// frequency-domain approximation.
  [[nodiscard]] double spectral_radius(double K) const {
    const HeldMass mass(m, b, T);
    const int n = 3 + delay;  // x(k), v(k), then x(k-1) ... x(k-delay-1)
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
    M.topLeftCorner<2, 2>() = mass.A;
    const auto past = [](int age) { return age == 0 ? 0 : 1 + age; };
    M.block(0, past(delay), 2, 1) -= (K + B / T) * mass.B;
    M.block(0, past(delay + 1), 2, 1) += B / T * mass.B;
    for (int age = 1; age <= delay + 1; ++age) M(past(age), past(age - 1)) = 1;
    return M.eigenvalues().cwiseAbs().maxCoeff();
  }

  /// Returns the largest stable stiffness [N/m], by bisection from `lo` upwards; 0 if even `lo` is unstable.
  [[nodiscard]] double stiffness_limit(double lo = 1e-3, double hi = 1e5) const {
    if (spectral_radius(lo) >= 1) return 0;
    for (int i = 0; i < 60; ++i) {
      const double middle = std::sqrt(lo * hi);
      (spectral_radius(middle) < 1 ? lo : hi) = middle;
    }
    return lo;
  }
};

}  // namespace tandem::test
