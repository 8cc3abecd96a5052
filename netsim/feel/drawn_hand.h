#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>

#include "hal/sim/recorded_motion.h"
#include "proto/spec/scene_spec.h"

namespace tandem::netsim {

/// Kind of simulated hands: random for each run, or the same ideal hand in all runs.
enum class HandKind : std::uint8_t {
  kDrawn,  ///< impedance, tremor and intention noise drawn from the seed
  kPlain,  ///< impedance of the model, without tremor and noise: for numbers that can be computed by hand
};

/// Position that the user intends for the tip [m], 3x1, as a function of the session time t [s].
using IntendedPath = std::function<hal::Vec3(double t)>;

/// A user's hand, drawn from a seed. Axes are independent of each other.
/// - Impedance: stiffness 0.5 to 1.5 times, damping and mass 0.7 to 1.4 times the model's, log-uniform.
///   The stiffness range from a relaxed to a tense grip is far wider [Hajian, Howe 1997]; the model's 1000 N/m is a
///   firm grip.
/// - Tremor: a sine of 8 to 12 Hz and 0.07 to 0.13 mm amplitude (physiological tremor).
/// - Intention noise: eight sines about 2.3 Hz (1.5 to 3.1 Hz), together 0.3 mm RMS per axis.
class DrawnHand {
 public:
  /// @param number  number of the hand in its session; hands of one seed differ
  DrawnHand(HandKind kind, std::uint64_t seed, std::size_t number);

  /// Returns the model with the impedance of this user.
  /// @param k, b, m  impedance of the ideal hand [N/m, N s/m, kg]
  [[nodiscard]] HandSpec with_impedance(HandModel model, double k, double b, double m) const;

  /// Returns a factor in [lo, hi], log-uniform; 1 for a plain hand.
  [[nodiscard]] double factor(std::uint64_t purpose, double lo, double hi) const;

  /// Returns the sum of tremor and noise at time t [m], 3x1; zero for a plain hand.
  [[nodiscard]] hal::Vec3 unsteadiness(double t) const;

  /// Returns the intended path plus this user's tremor and noise. Both grow during the first second, so that the motion
  /// starts at rest.
  /// @param length  length of the motion [s]; the hand then stays at its end
  [[nodiscard]] std::shared_ptr<const hal::sim::RecordedMotion> move(const IntendedPath& path, double length) const;

 private:
  struct Wave {
    double amplitude = 0, omega = 0, phase = 0;
  };
  static constexpr std::size_t kNoiseWaves = 8;
  HandKind kind_;
  std::uint64_t key_;
  std::array<std::array<Wave, kNoiseWaves + 1>, 3> waves_{};  ///< by axis; the last wave is the tremor
};

}  // namespace tandem::netsim
