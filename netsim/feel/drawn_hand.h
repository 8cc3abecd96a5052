#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>

#include "hal/sim/recorded_motion.h"
#include "proto/scene_spec.h"

namespace tandem::netsim {

/// Whether hands are those of different people, or the same ideal one in every run.
enum class HandKind : std::uint8_t {
  kDrawn,  ///< impedance, tremor and intention noise drawn from the seed
  kPlain,  ///< impedance of the model, no tremor, no noise: for numbers that can be computed by hand
};

/// Where a person intends the tip to be at session time t [s] -> [m].
using IntendedPath = std::function<hal::Vec3(double t)>;

/// A person's hand, drawn from a seed. Axes are independent of each other.
/// - Impedance: stiffness 0.5 to 1.5 times, damping and mass 0.7 to 1.4 times the model's, log-uniform. The range of stiffness of
///   a relaxed to a tense grip is far wider [Hajian, Howe 1997]; the model's 1000 N/m is a firm one.
/// - Tremor: a sine of 8 to 12 Hz and 0.07 to 0.13 mm amplitude (physiological tremor).
/// - Intention noise: eight sines about 2.3 Hz (1.5 to 3.1 Hz), together 0.3 mm RMS per axis.
class DrawnHand {
 public:
  /// @param number  of the hand in its session: hands of one seed differ
  DrawnHand(HandKind kind, std::uint64_t seed, std::size_t number);

  /// The model with this person's impedance in place of its own.
  /// @param k, b, m  what the ideal hand has [N/m, N s/m, kg]
  [[nodiscard]] HandSpec with_impedance(HandModel model, double k, double b, double m) const;

  /// A factor in [lo, hi], log-uniform; 1 for a plain hand.
  [[nodiscard]] double factor(std::uint64_t purpose, double lo, double hi) const;

  /// What tremor and noise add to the intended position at time t [m]; zero for a plain hand.
  [[nodiscard]] hal::Vec3 unsteadiness(double t) const;

  /// The intended path with this person's tremor and noise, which grow within the first second so that the motion begins at rest.
  /// @param length  of the motion [s]; its end is held
  [[nodiscard]] std::shared_ptr<const hal::sim::RecordedMotion> move(const IntendedPath& path, double length) const;

 private:
  struct Wave {
    double amplitude = 0, omega = 0, phase = 0;
  };
  static constexpr std::size_t kNoiseWaves = 8;
  HandKind kind_;
  std::uint64_t key_;
  std::array<std::array<Wave, kNoiseWaves + 1>, 3> waves_{};  ///< by axis; the last one is the tremor
};

}  // namespace tandem::netsim
