#include "netsim/demo/measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::netsim::demo {
namespace {

constexpr double kTouching = 0.3;       // [N]
constexpr std::size_t kSpeedHalf = 25;  // samples on each side: they average out encoder steps, not the approach

/// Accumulates a mean of squares.
class Squares {
 public:
  void add(double v) {
    if (!std::isfinite(v)) return;
    sum_ += v * v;
    ++n_;
  }
  [[nodiscard]] double rms() const { return n_ == 0 ? kUnknown : std::sqrt(sum_ / static_cast<double>(n_)); }

 private:
  double sum_ = 0;
  std::size_t n_ = 0;
};

/// Least squares of y = p0 u + p1 v + p2. Returns the first parameter; NaN if the samples do not determine it.
class Fit {
 public:
  void add(double u, double v, double y) {
    const std::array<double, 3> row{u, v, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) a_[i][j] += row[i] * row[j];
      b_[i] += row[i] * y;
    }
    ++n_;
  }
  [[nodiscard]] double slope() const {
    if (n_ < 10) return kUnknown;
    const double whole = determinant(a_);
    auto replaced = a_;
    for (std::size_t i = 0; i < 3; ++i) replaced[i][0] = b_[i];
    return std::abs(whole) > 1e-12 * a_[0][0] * a_[1][1] * a_[2][2] ? determinant(replaced) / whole : kUnknown;
  }

 private:
  using Matrix = std::array<std::array<double, 3>, 3>;
  static double determinant(const Matrix& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
  Matrix a_{};
  std::array<double, 3> b_{};
  std::size_t n_ = 0;
};

}  // namespace

double rendered_stiffness(const TraceData& trace) {
  const Column& t = trace.t;
  const Column& x = trace.trainer.x[0];
  Fit fit;
  for (std::size_t k = kSpeedHalf; k + kSpeedHalf < t.size() && t[k] < kHoldFrom; ++k) {
    if (!(std::abs(trace.tool.f_env[0][k]) > kTouching) || !(x[k] <= kNearPose)) continue;
    const double v = (x[k + kSpeedHalf] - x[k - kSpeedHalf]) / (t[k + kSpeedHalf] - t[k - kSpeedHalf]);
    const double force = -trace.trainer.f_cmd[0][k], stretch = x[k] - trace.tool.x[0][k];
    if (std::isfinite(v) && std::isfinite(force) && std::isfinite(stretch)) fit.add(stretch, v, force);
  }
  return fit.slope();
}

double held_stiffness(const TraceData& trace) {
  double force = 0, depth = 0;
  for (std::size_t k = 0; k < trace.rows(); ++k) {
    if (trace.t[k] < kHoldFrom || trace.t[k] >= kHoldTo) continue;
    force -= trace.trainer.f_cmd[0][k];
    depth += trace.trainer.x[0][k];
  }
  return depth > 0 && force > 0 ? force / depth : kUnknown;
}

ForceError force_error_x(const TraceData& trace, const SeatTrace& seat, double from_s, double to_s, bool commanded) {
  Squares squares;
  double peak = 0;
  for (std::size_t k = 0; k < trace.rows(); ++k) {
    // The force commanded to the slave is the force with which it presses; the environment's force is its opposite.
    const double wanted = commanded ? -trace.tool.f_cmd[0][k] : trace.tool.f_env[0][k];
    if (std::isfinite(wanted)) peak = std::max(peak, std::abs(wanted));
    if (trace.t[k] < from_s || trace.t[k] >= to_s) continue;
    squares.add((commanded ? seat.f_cmd[0][k] : seat.f_out[0][k]) - wanted);
  }
  const double rms = squares.rms();
  return {rms, peak > 0 ? 100 * rms / peak : kUnknown};
}

double force_step(const TraceData& trace) {
  // The interval ends a tenth of a second after the trainer's authority has reached 0, because the springs respond with
  // a delay.
  double until = kAlphaMovesAt;
  for (std::size_t k = 0; k < trace.rows(); ++k)
    if (trace.t[k] >= kAlphaMovesAt && trace.trainer.alpha[k] > 1e-6) until = trace.t[k];
  until += 0.1;
  double largest = kUnknown;
  const auto look = [&](const Column& t, const Column3& force) {
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (t[k] < kAlphaMovesAt - 0.01 || t[k] > until) continue;
      double square = 0;
      for (const Column& f : force) square += (f[k] - f[k - 1]) * (f[k] - f[k - 1]);
      if (std::isfinite(square) && !(std::sqrt(square) <= largest)) largest = std::sqrt(square);
    }
  };
  for (const auto& [seat, own] :
       {std::pair{&trace.trainer, &trace.trainer_own}, std::pair{&trace.trainee, &trace.trainee_own}}) {
    if (own->t.empty()) {
      look(trace.t, seat->f_cmd);
    } else {
      look(own->t, own->f_cmd);
    }
  }
  return largest;
}

TraceNumbers measure(const RunPlan& plan, const TraceData& trace) {
  if (plan.task == Task::kFreeMotion) return {.force_step_n = force_step(trace)};
  const bool commanded = plan.setting == Setting::kSeed;
  const ForceError leader = force_error_x(trace, trace.trainer, kContactFrom, kContactEnd, commanded);
  const ForceError follower = force_error_x(trace, trace.trainee, kAlignFrom, kContactEnd, commanded);
  Squares apart;
  for (std::size_t k = 0; k < trace.rows(); ++k)
    if (trace.t[k] >= kAlignFrom && trace.t[k] < kContactEnd) apart.add(trace.trainee.x[0][k] - trace.trainer.x[0][k]);
  return {.stiffness_n_m = rendered_stiffness(trace),
          .stiffness_held_n_m = held_stiffness(trace),
          .force_x_leader_n = leader.rms_n,
          .force_x_leader_percent = leader.percent,
          .force_x_follower_n = follower.rms_n,
          .force_x_follower_percent = follower.percent,
          .aligned_x_m = apart.rms()};
}

}  // namespace tandem::netsim::demo
