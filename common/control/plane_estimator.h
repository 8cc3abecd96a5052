#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"

namespace tandem::control {

/// Estimates the plane that a remote slave touches, from its motion and effort. This is model-mediated telemanipulation
/// [Mitra & Niemeyer, IJRR 27(2) 2008]: hands then touch the plane locally, without delay.
///
/// Pressing yields pairs of depth u along the normal and force N. Their regression u = u_0 + c N, with a forgetting
/// time of 0.5 s, gives the place u_0 and the compliance c = 1/k. The force has the smaller error, so u is regressed on
/// N. The normal is the direction of the force. Frame: the tip's.
class PlaneEstimator {
 public:
  static constexpr double kTouchForce = 0.2,
                          kLeaveForce = 0.12;  ///< a touch begins above the first and ends below the second [N]
  /// kTouchForce grows with speed and acceleration, because friction and inertia are not contact [N s/m, kg].
  static constexpr double kTouchDrag = 2, kTouchMass = 0.2;
  static constexpr double kStiffnessMin = 50,
                          kStiffnessMax = 10'000;  ///< [N/m]; above the maximum a hand on 400 N/m feels no difference
  static constexpr double kUncertaintyMax =
      0.05;  ///< relative standard error of 1/k_c + 1/k below which the plane is known, k_c = 400 N/m

  /// Knowledge about the touched plane.
  enum class State : std::uint8_t {
    kFree,      ///< no contact
    kTouching,  ///< contact with a surface that is unknown or differs from the estimate
    kKnown,     ///< the plane is known
  };

  /// One sample of the slave. Frame: the tip's.
  struct Sample {
    std::array<double, 3> x{};  ///< of the slave [m]
    std::array<double, 3> v{};  ///< [m/s]
    std::array<double, 3> f{};  ///< force of the touched surface on the slave [N]
  };

  /// @param axes  of the port, 1 to 3
  explicit PlaneEstimator(std::size_t axes = 3) noexcept : axes_(axes) {}
  /// Returns to kFree and keeps the count of touches.
  void reset() noexcept;
  /// Adds a newer sample, taken `dt` [s] after the one before. A sample that is not finite changes nothing.
  void step(double dt, const Sample& sample) noexcept TANDEM_REALTIME;

  [[nodiscard]] State state() const noexcept { return state_; }
  /// Number of touches so far, which is the number of the present one.
  [[nodiscard]] std::uint32_t touches() const noexcept { return touches_; }
  [[nodiscard]] const std::array<double, 3>& normal() const noexcept { return normal_; }  ///< outward, of length 1
  [[nodiscard]] std::array<double, 3> point() const noexcept;                             ///< on the surface [m]
  [[nodiscard]] double stiffness() const noexcept { return 1 / compliance_; }             ///< [N/m]
  /// Relative standard error of what a hand on 400 N/m feels; infinite while nothing is known.
  [[nodiscard]] double uncertainty() const noexcept { return uncertainty_; }

 private:
  void begin() noexcept;
  void leave() noexcept;
  void turn(double dt, const Sample& sample) noexcept;
  void regress(double dt, double depth, double force) noexcept;

  std::size_t axes_;
  State state_ = State::kFree;
  std::uint32_t touches_ = 0;
  std::array<double, 3> force_{}, x_{}, v_{}, a_{};  ///< smoothed [N, m, m/s, m/s^2]
  bool heard_ = false;
  std::array<double, 3> normal_{};
  std::array<double, 3> origin_{};  ///< origin of depths: where the touch began [m]
  double since_ = 0;                ///< how long the condition for begin or end has held [s]
  double touched_ = 0;              ///< duration of the touch [s]
  double weight_ = 0;               ///< of the sums [s]
  double mean_u_ = 0, mean_n_ = 0, uu_ = 0, un_ = 0, nn_ = 0;
  double compliance_ = 1 / kStiffnessMax, place_ = 0, uncertainty_ = 0;
};

}  // namespace tandem::control
