#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"

namespace tandem::control {

/// Tells from the motion and the effort of a remote slave what plane it touches: model-mediated telemanipulation [Mitra & Niemeyer, IJRR
/// 27(2) 2008], where hands then touch the plane itself, without delay.
///
/// Pressing gives pairs of depth u along the normal and force N. Their regression u = u_0 + c N, forgetting by 0.5 s, gives the place u_0
/// and the compliance c = 1/k; force has the smaller error, so u is regressed on N. The normal is the direction of the force.
/// Frame: the tip's.
class PlaneEstimator {
 public:
  static constexpr double kTouchForce = 0.2, kLeaveForce = 0.12;  ///< from which on it touches, and below which it does no more [N]
  /// The former grows with speed and acceleration: friction and inertia are no contact [N s/m, kg].
  static constexpr double kTouchDrag = 2, kTouchMass = 0.2;
  static constexpr double kStiffnessMin = 50, kStiffnessMax = 10'000;  ///< [N/m]; beyond, a hand on 400 N/m feels no difference
  static constexpr double kDoubtMax = 0.05;  ///< standard error of 1/k_c + 1/k that counts as known, k_c = 400 N/m

  enum class State : std::uint8_t {
    kFree,      ///< it touches nothing
    kTouching,  ///< something that is not known yet, or not as it was thought
    kKnown,     ///< the plane
  };

  struct Sample {
    std::array<double, 3> x{};  ///< of the slave [m]
    std::array<double, 3> v{};  ///< [m/s]
    std::array<double, 3> f{};  ///< of what it touches, on it [N]
  };

  /// @param axes  of the port, 1 to 3
  explicit PlaneEstimator(std::size_t axes = 3) noexcept : axes_(axes) {}
  void reset() noexcept;
  /// A newer sample, `dt` [s] after the one before. What is not finite changes nothing.
  void step(double dt, const Sample& sample) noexcept TANDEM_REALTIME;

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] std::uint32_t touches() const noexcept { return touches_; }  ///< how many so far: the number of this one
  [[nodiscard]] const std::array<double, 3>& normal() const noexcept { return normal_; }  ///< outward, of length 1
  [[nodiscard]] std::array<double, 3> point() const noexcept;                             ///< on the surface [m]
  [[nodiscard]] double stiffness() const noexcept { return 1 / compliance_; }             ///< [N/m]
  /// Standard error of what a hand on 400 N/m feels, relative; infinite while nothing is known.
  [[nodiscard]] double doubt() const noexcept { return doubt_; }

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
  std::array<double, 3> origin_{};  ///< of depths: where the touch began [m]
  double since_ = 0;                ///< how long the state begins or ends already [s]
  double touched_ = 0;              ///< [s]
  double weight_ = 0;               ///< of the sums [s]
  double mean_u_ = 0, mean_n_ = 0, uu_ = 0, un_ = 0, nn_ = 0;
  double compliance_ = 1 / kStiffnessMax, place_ = 0, doubt_ = 0;
};

}  // namespace tandem::control
