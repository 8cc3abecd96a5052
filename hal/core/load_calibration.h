#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <expected>
#include <string>

#include "hal/core/device.h"

namespace tandem::hal {

/// Estimates weight and friction of a device from a slow motion without a hand, whose motor effort is known:
///
///     tau_j = w_j J_zj + c_j sign(dq_j) + d_j dq_j        least squares over all samples, joint by joint
///
/// Samples below 5 mm/s do not count, as friction is undefined there. The viscous d_j only keeps c_j free of it.
/// Inertia is neglected: at 30 mm and 0.25 Hz it is 2 % of the weight. Not real-time.
class LoadCalibration {
 public:
  /// Slowest motion that counts, of the tip by one joint [m/s].
  static constexpr double kSpeedMin = 0.005;
  /// Smallest number of samples of each joint in each direction.
  static constexpr std::size_t kSamplesMin = 200;

  explicit LoadCalibration(std::size_t joints) noexcept;

  /// Takes a reading with the effort that the motors held up to it (State::tau_out). A reading that is stale or not
  /// finite is ignored and counted.
  void add(const State& state) noexcept;
  /// Number of readings that were ignored.
  [[nodiscard]] std::size_t ignored() const noexcept { return ignored_; }
  /// Returns the estimate; the error says which joint lacks data, and what to do.
  [[nodiscard]] std::expected<DeviceLoad, std::string> result() const;

 private:
  struct Sums {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double effort_square = 0, lever_square = 0;  ///< [(N m)^2], [m^2]
    std::array<std::size_t, 2> samples{};        ///< downwards and upwards
  };
  std::size_t joints_, ignored_ = 0;
  std::array<Sums, kAxesMax> sums_{};
};

}  // namespace tandem::hal
