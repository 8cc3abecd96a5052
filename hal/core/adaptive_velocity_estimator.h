#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::hal {

/// Velocity estimator for a quantised position, by an adaptive window: the slope of the longest window whose straight
/// line fits every reading.
/// A line fits if each reading lies within one quantum of it. The window is short in fast motion (low lag) and long in
/// slow motion (low noise).
/// Unit: unit of the position per second. No heap; total: a non-finite position restarts the estimator.
/// Source [Janabi-Sharifi, Hayward, Chen 2000]: "Discrete-time adaptive windowing for velocity estimation", IEEE Trans.
/// Control Systems Technology 8(6), the end-fit form.
class AdaptiveVelocityEstimator {
 public:
  static constexpr std::size_t kWindow = 16;

  /// @param quantum  quantisation step of the position, > 0
  /// @param apart    least time between the two readings of a slope; about the timing uncertainty of a reading
  explicit AdaptiveVelocityEstimator(double quantum = 1.0, Duration apart = {}) noexcept
      : quantum_(std::abs(quantum)), apart_(apart) {}

  void restart() noexcept { size_ = 0, rate_ = 0.0; }

  /// @return velocity; 0 until there are two readings. A reading that is not newer than the last one is ignored.
  double update(Time at, double position) noexcept TANDEM_REALTIME {
    if (!std::isfinite(position)) restart();
    if (!std::isfinite(position) || (size_ > 0 && at <= sample(0).at)) return rate_;
    newest_ = (newest_ + 1) % kWindow;
    samples_[newest_] = {at, position};
    if (size_ < kWindow) ++size_;
    bool known = false;  // the shortest window is taken without the fit test
    for (std::size_t n = 1; n < size_; ++n) {
      if (at - sample(n).at < apart_) continue;
      const double slope = (position - sample(n).position) / seconds(at - sample(n).at);
      if (known && !explains(slope, n)) break;
      rate_ = slope;
      known = true;
    }
    if (size_ < 2) rate_ = 0.0;
    return rate_;
  }
  [[nodiscard]] double velocity() const noexcept { return rate_; }

 private:
  struct Sample {
    Time at{};
    double position = 0;
  };
  /// Returns the reading `back` places before the newest.
  [[nodiscard]] const Sample& sample(std::size_t back) const noexcept {
    return samples_[(newest_ + kWindow - back) % kWindow];
  }
  [[nodiscard]] bool explains(double slope, std::size_t n) const noexcept {
    for (std::size_t i = 1; i < n; ++i) {
      const double line = sample(0).position - slope * seconds(sample(0).at - sample(i).at);
      if (std::abs(line - sample(i).position) > quantum_ * (1.0 + 1e-9)) return false;
    }
    return true;
  }

  double quantum_;
  Duration apart_;
  double rate_ = 0;
  std::array<Sample, kWindow> samples_{};
  std::size_t newest_ = 0, size_ = 0;
};

}  // namespace tandem::hal
