#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

/// Sampled closed loops as matrices, for stability limits that owe nothing to the code under test. Continuous masses
/// are discretised by the matrix exponential, implicit steps by solving the backward Euler equations.
namespace tandem::test {

/// A linear map of one tick, built equation by equation. A state is a column; `row(i)` is the value of state i after
/// the tick as a function of the states before it. An expression is a row vector over the states.
class LinearLoop {
 public:
  using Expression = Eigen::RowVectorXd;

  explicit LinearLoop(int states) : map_(Eigen::MatrixXd::Zero(states, states)) {}
  /// State i before the tick.
  [[nodiscard]] Expression now(int i) const { return Expression::Unit(map_.cols(), i); }
  [[nodiscard]] Expression zero() const { return Expression::Zero(map_.cols()); }
  /// Sets state i after the tick.
  void set(int i, const Expression& value) { map_.row(i) = value; }

  /// A mass m with damping b on a spring k to 0, under a force held for T: position and velocity after it.
  /// @param x  index of the position; the velocity follows it
  void held_mass(int x, double m, double b, double k, double T, const Expression& force) {
    Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
    system(0, 1) = 1;
    system(1, 0) = -k / m;
    system(1, 1) = -b / m;
    system(1, 2) = 1 / m;
    const Eigen::Matrix3d step = (system * T).exp();
    set(x, step(0, 0) * now(x) + step(0, 1) * now(x + 1) + step(0, 2) * force);
    set(x + 1, step(1, 0) * now(x) + step(1, 1) * now(x + 1) + step(1, 2) * force);
  }
  /// A mass m under backward Euler, with total stiffness k and damping b and the rest of its force.
  /// @return its position after the tick
  Expression implicit_mass(int x, double m, double b, double k, double T, const Expression& rest) {
    Eigen::Matrix2d left;
    left << 1, -T, T * k / m, 1 + T * b / m;
    const Eigen::Matrix2d solved = left.inverse();
    const Expression position = now(x), velocity = now(x + 1) + T / m * rest;
    set(x, solved(0, 0) * position + solved(0, 1) * velocity);
    set(x + 1, solved(1, 0) * position + solved(1, 1) * velocity);
    return map_.row(x);
  }
  /// A delay line: `ticks` >= 1 states from `first` on. @return the expression that entered it `ticks` ticks ago
  Expression delayed(int first, int ticks, const Expression& entering) {
    for (int i = ticks - 1; i > 0; --i) set(first + i, now(first + i - 1));
    set(first, entering);
    return now(first + ticks - 1);
  }
  /// Largest magnitude of an eigenvalue; the loop is stable below 1.
  [[nodiscard]] double spectral_radius() const { return map_.eigenvalues().cwiseAbs().maxCoeff(); }

 private:
  Eigen::MatrixXd map_;
};

/// Returns the value from which on `stable` first fails, looking upwards from `lo` in steps of a quarter and then by
/// bisection; `hi` if it holds everywhere, 0 if it fails at `lo`. Far beyond the limit a loop may be stable again.
[[nodiscard]] inline double stability_limit(double lo, double hi, const std::function<bool(double)>& stable,
                                            int steps = 40) {
  if (!stable(lo)) return 0;
  double good = lo, bad = lo;
  while (true) {
    bad = 1.25 * good;
    if (bad > hi) return hi;
    if (!stable(bad)) break;
    good = bad;
  }
  for (int i = 0; i < steps; ++i) {
    const double middle = std::sqrt(good * bad);
    (stable(middle) ? good : bad) = middle;
  }
  return good;
}

/// Returns whether a motion grows: RMS about the mean in the last eighth against the second eighth.
[[nodiscard]] inline bool grows(const std::vector<double>& x) {
  const auto rms = [&](std::size_t part) {
    const std::size_t n = x.size() / 8, first = part * n;
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < n; ++i) mean += x[first + i] / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) square += (x[first + i] - mean) * (x[first + i] - mean);
    return square;
  };
  const double late = rms(7);
  return !std::isfinite(late) || late > rms(1);
}

}  // namespace tandem::test
