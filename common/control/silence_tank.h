#pragma once

#include <cstddef>

#include "common/base/axes.h"

namespace tandem::control {

/// Bounds the energy that the motor gives a hand after the last fresh datagram (ARCHITECTURE.md, invariant 5). Measures
/// the work of the held effort along the way of the hand. Arrays are per axis of the port.
class SilenceTank {
 public:
  struct Params {
    std::size_t dof = 3;
    AxisArray scale{1, 1, 1, 1, 1, 1, 1};  ///< per axis: diag(J^T J)
    double mass = 0.1;                     ///< of the device at the tip [kg]
    double share = 1;                      ///< share of the size that follows from `mass`, (0, 1]
  };
  explicit SilenceTank(const Params& params) noexcept;

  /// Sets the first position of the hand.
  void start_at(const AxisArray& q) noexcept { q_ = q; }
  /// Books the work of the effort that the motor held while the hand moved to `q`. Ignores a `q` that is not finite.
  /// @param absorbed  false: energy that the hand seemed to return does not count
  void measure(const AxisArray& effort, const AxisArray& q, bool absorbed) noexcept TANDEM_REALTIME;
  /// Takes the duration of the last step [s]. An effort may act for as long as the longest recent step.
  void set_pace(double step) noexcept;
  /// A fresh datagram arrived: the whole tank may be given again.
  void refill() noexcept { given_ = 0; }
  /// Includes the present loss in `given_max`.
  void note_loss() noexcept;

  /// Returns whether the motor may hold `effort` for the next step: |f| (|v| + |f| dt / m) dt is at most the rest of
  /// the tank, or the effort brakes the hand.
  [[nodiscard]] bool allows(const AxisArray& effort, const AxisArray& v) const noexcept TANDEM_REALTIME;
  [[nodiscard]] double size() const noexcept { return size_; }    ///< [J]
  [[nodiscard]] double given() const noexcept { return given_; }  ///< since the last refill [J]
  /// Largest energy given during one loss so far [J].
  [[nodiscard]] double given_max() const noexcept { return given_max_; }

 private:
  Params p_;
  double size_;
  double given_ = 0, given_max_ = 0;
  double pace_ = 0;          ///< longest recent time between two steps [s]
  AxisArray q_{}, moved_{};  ///< position, and its change in the last step
};

}  // namespace tandem::control
