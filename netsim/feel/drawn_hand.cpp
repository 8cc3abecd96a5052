#include "netsim/feel/drawn_hand.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/base/rng.h"

namespace tandem::netsim {
namespace {

constexpr double kTremorMin = 0.07e-3, kTremorMax = 0.13e-3;  // [m]
constexpr double kTremorLow = 8, kTremorHigh = 12;            // [Hz]
constexpr double kNoiseRms = 0.3e-3;                          // [m] per axis
constexpr double kNoiseLow = 1.5, kNoiseHigh = 3.1;           // [Hz]
constexpr double kStep = 0.002;  // [s] between points of a motion: 40 per period of the fastest tremor
constexpr std::uint64_t kStiffness = 1, kDamping = 2, kMass = 3, kWaves = 100;

double between(const RandomKey& key, std::uint64_t counter, double lo, double hi) {
  return key.uniform(counter, lo, hi);
}

}  // namespace

DrawnHand::DrawnHand(HandKind kind, std::uint64_t seed, std::size_t number)
    : kind_(kind), key_(RandomKey{seed}.derive(0x6665656cU).derive(number).bits(0)) {
  if (kind_ == HandKind::kPlain) return;
  const RandomKey key{key_};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const RandomKey own = key.derive(kWaves + axis);
    std::uint64_t draw = 0;
    for (std::size_t i = 0; i <= kNoiseWaves; ++i) {
      const bool tremor = i == kNoiseWaves;
      Wave& wave = waves_[axis][i];
      // Noise: one wave in each eighth of the band, so that no two waves are equal.
      const double part = (kNoiseHigh - kNoiseLow) / static_cast<double>(kNoiseWaves),
                   low = kNoiseLow + part * static_cast<double>(i);
      const double hz = tremor ? between(own, draw++, kTremorLow, kTremorHigh) : between(own, draw++, low, low + part);
      wave.omega = 2 * std::numbers::pi * hz;
      wave.phase = between(own, draw++, 0, 2 * std::numbers::pi);
      wave.amplitude = tremor ? between(own, draw++, kTremorMin, kTremorMax)
                              : kNoiseRms * std::sqrt(2.0 / static_cast<double>(kNoiseWaves));
    }
  }
}

double DrawnHand::factor(std::uint64_t purpose, double lo, double hi) const {
  if (kind_ == HandKind::kPlain) return 1;
  return lo * std::pow(hi / lo, RandomKey{key_}.derive(purpose).uniform(0));
}

HandSpec DrawnHand::with_impedance(HandModel model, double k, double b, double m) const {
  HandSpec hand;
  hand.model = model;
  hand.k = k * factor(kStiffness, 0.5, 1.5);
  hand.b = b * factor(kDamping, 0.7, 1.4);
  hand.m = m * factor(kMass, 0.7, 1.4);
  return hand;
}

hal::Vec3 DrawnHand::unsteadiness(double t) const {
  hal::Vec3 sum = hal::Vec3::Zero();
  if (kind_ == HandKind::kPlain) return sum;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Wave& wave : waves_[axis])
      sum[static_cast<Eigen::Index>(axis)] += wave.amplitude * std::sin(wave.omega * t + wave.phase);
  return sum;
}

std::shared_ptr<const hal::sim::RecordedMotion> DrawnHand::move(const IntendedPath& path, double length) const {
  std::vector<double> t;
  std::vector<hal::Vec3> x;
  const auto points = static_cast<std::size_t>(std::ceil(length / kStep)) + 1;
  t.reserve(points);
  x.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at = kStep * static_cast<double>(i);
    t.push_back(at);
    x.push_back(path(at) + hal::sim::min_jerk(at).value * unsteadiness(at));
  }
  auto motion = hal::sim::RecordedMotion::from_points(std::move(t), std::move(x));
  if (!motion) throw std::invalid_argument("intended path: " + motion.error());
  return std::make_shared<const hal::sim::RecordedMotion>(std::move(*motion));
}

}  // namespace tandem::netsim
