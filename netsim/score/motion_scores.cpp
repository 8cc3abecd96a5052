#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "netsim/score/filters.h"
#include "netsim/score/hull_volume.h"
#include "netsim/score/part_scores.h"
#include "netsim/score/smoothness.h"

/// Metrics of motion, force and contact.
namespace tandem::netsim::score {
namespace {

/// Mean of values that exist, weighted with the duration of their piece.
class PieceMean {
 public:
  void add(double value, double duration) {
    if (!std::isfinite(value)) return;
    sum_ += value * duration;
    weight_ += duration;
  }
  [[nodiscard]] double value() const { return weight_ > 0 ? sum_ / weight_ : kUnknown; }

 private:
  double sum_ = 0, weight_ = 0;
};

/// A signal averaged over blocks, for spectra.
struct Averaged {
  std::vector<double> values;
  double rate_hz = 0;
};

Averaged averaged(std::span<const double> signal, double rate_hz, double rate_most) {
  const auto block = std::max<std::size_t>(1, static_cast<std::size_t>(std::floor(rate_hz / rate_most + 1e-9)));
  Averaged out{{}, rate_hz / static_cast<double>(block)};
  out.values.reserve(signal.size() / block);
  for (std::size_t k = 0; k + block <= signal.size(); k += block) {
    double sum = 0;
    for (std::size_t i = 0; i < block; ++i) sum += signal[k + i];
    out.values.push_back(sum / static_cast<double>(block));
  }
  return out;
}

double path_of(std::span<const LessonTriple> x) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) sum += distance(x[k], x[k + 1]);
  return sum;
}

constexpr double kHullRateMost = 50;  // [Hz]

/// Sums over single samples and pairs of samples.
struct MotionSums {
  double samples = 0, idle = 0, path = 0, straight = 0, speed = 0, peak = 0, peaks = 0, jerk = 0, jerks = 0;
  double turned = 0, turns = 0;
  std::vector<LessonTriple> hull;  ///< points at most at 50 Hz
  LessonTriple low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  void add(const PartInput& in, const Stretch& piece) {
    const SeatTrack& seat = in.seat;
    const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(in.grid.rate() / kHullRateMost));
    for (std::size_t k = piece.begin; k < piece.end; k += stride) hull.push_back(seat.x[k]);
    hull.push_back(seat.x[piece.end - 1]);
    for (std::size_t k = piece.begin; k < piece.end; ++k) {
      const double s = seat.speed[k];
      if (k > piece.begin && !seat.turn.empty() && std::isfinite(seat.turn[k])) turned += seat.turn[k], turns += 1;
      samples += 1;
      idle += s < in.options.speed_min ? 1 : 0;
      speed += s;
      peak = std::max(peak, s);
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], seat.x[k][c]);
        high[c] = std::max(high[c], seat.x[k][c]);
      }
      if (k > piece.begin && k + 1 < piece.end && s > in.options.speed_min && seat.speed[k - 1] < s &&
          s >= seat.speed[k + 1])
        peaks += 1;
    }
    path += path_of(std::span(seat.x).subspan(piece.begin, piece.size()));
    straight += distance(seat.x[piece.begin], seat.x[piece.end - 1]);
  }
};

}  // namespace

void score_motion(const PartInput& in, MetricValues& values) {
  const SeatTrack& seat = in.seat;
  const double rate = in.grid.rate();
  of(values, Metric::kTime) = static_cast<double>(std::ranges::count(in.part.mask, 1)) / rate;
  MotionSums sums;
  PieceMean normalised, dlj, ldlj, spectral, frequency;
  for (const Stretch& piece :
       in.grid.runs([&](std::size_t k) { return in.part.has(k) && std::isfinite(seat.speed[k]); })) {
    sums.add(in, piece);
    const auto x = std::span(seat.x).subspan(piece.begin, piece.size());
    const std::vector<double> jerk = squared_jerk(x, rate);
    double integral = 0;
    for (const double j : jerk) integral += j / rate;
    sums.jerk += integral;
    sums.jerks += static_cast<double>(jerk.size()) / rate;
    const double duration = static_cast<double>(piece.size()) / rate, path = path_of(x);
    // A hand at rest has no movement whose smoothness could be judged.
    const double peak = *std::max_element(seat.speed.begin() + static_cast<std::ptrdiff_t>(piece.begin),
                                          seat.speed.begin() + static_cast<std::ptrdiff_t>(piece.end));
    if (duration < in.options.segment_min_s || peak < in.options.speed_min) continue;
    if (path > 0) normalised.add(std::pow(duration, 5) * integral / (path * path), duration);
    const auto speed = std::span(seat.speed).subspan(piece.begin, piece.size());
    dlj.add(dimensionless_jerk(speed, rate), duration);
    ldlj.add(log_dimensionless_jerk(speed, rate), duration);
    const Averaged slow = averaged(speed, rate, in.options.spectrum_rate_hz);
    spectral.add(sparc(slow.values, slow.rate_hz), duration);
    frequency.add(motion_frequency_95(slow.values, slow.rate_hz), duration);
  }
  if (!(sums.samples > 0)) return;
  of(values, Metric::kIdleTime) = sums.idle / rate;
  of(values, Metric::kPathLength) = sums.path;
  of(values, Metric::kStraightShare) = sums.path > 0 ? sums.straight / sums.path : kUnknown;
  of(values, Metric::kSpeedMean) = sums.speed / sums.samples;
  of(values, Metric::kSpeedPeak) = sums.peak;
  of(values, Metric::kSpeedPeaks) = sums.peaks;
  of(values, Metric::kWorkspace) =
      (sums.high[0] - sums.low[0]) * (sums.high[1] - sums.low[1]) * (sums.high[2] - sums.low[2]);
  of(values, Metric::kHullVolume) = hull_volume(sums.hull);
  if (sums.turns > 0) of(values, Metric::kAngularPath) = sums.turned;
  of(values, Metric::kSquaredJerk) = sums.jerks > 0 ? sums.jerk / sums.jerks : kUnknown;
  of(values, Metric::kNormalisedJerk) = normalised.value();
  of(values, Metric::kDimensionlessJerk) = dlj.value();
  of(values, Metric::kLogJerk) = ldlj.value();
  of(values, Metric::kSparc) = spectral.value();
  of(values, Metric::kMotionFrequency) = frequency.value();
}

namespace {

/// Sums of the force on the hand.
struct ForceSums {
  double samples = 0, sum = 0, squares = 0, peak = 0, excess = 0, off_axis = 0, work = 0;
  double rate_squares = 0, rates = 0, rate_peak = 0;
  LessonTriple mean{};
  std::array<std::array<double, 3>, 3> products{};

  void add(const PartInput& in, const Stretch& piece) {
    const SeatTrack& seat = in.seat;
    for (std::size_t k = piece.begin; k < piece.end; ++k) {
      const LessonTriple& f = seat.f[k];
      const double magnitude = seat.force[k];
      samples += 1;
      sum += magnitude;
      squares += magnitude * magnitude;
      peak = std::max(peak, magnitude);
      excess += magnitude > in.options.force_limit ? 1 : 0;
      for (std::size_t a = 0; a < 3; ++a) {
        mean[a] += f[a];
        for (std::size_t b = 0; b < 3; ++b) products[a][b] += f[a] * f[b];
      }
      if (in.tool.has_surface) {
        LessonTriple across = f;
        across[static_cast<std::size_t>(in.tool.surface.axis)] = 0;
        off_axis += length(across);
      }
      if (k + 1 == piece.end) continue;
      const LessonTriple& next = seat.f[k + 1];
      const double change = distance(f, next) * in.grid.rate();
      rate_squares += change * change;
      rates += 1;
      rate_peak = std::max(rate_peak, change);
      if (!known(seat.x[k]) || !known(seat.x[k + 1])) continue;
      const LessonTriple step = minus(seat.x[k + 1], seat.x[k]);
      work += (dot(f, step) + dot(next, step)) / 2;
    }
  }

  /// Volume of the ellipsoid of one standard deviation [N^3].
  [[nodiscard]] double ellipsoid() const {
    std::array<std::array<double, 3>, 3> c{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) c[a][b] = products[a][b] / samples - mean[a] * mean[b] / (samples * samples);
    const double determinant = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) -
                               c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
                               c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
    return 4.0 / 3 * std::numbers::pi * std::sqrt(std::max(0.0, determinant));
  }
};

}  // namespace

void score_force(const PartInput& in, MetricValues& values) {
  const SeatTrack& seat = in.seat;
  const double rate = in.grid.rate();
  ForceSums sums;
  PieceMean spectral;
  for (const Stretch& piece :
       in.grid.runs([&](std::size_t k) { return in.part.has(k) && std::isfinite(seat.force[k]); })) {
    sums.add(in, piece);
    const double duration = static_cast<double>(piece.size()) / rate;
    if (duration < in.options.segment_min_s) continue;
    const Averaged slow =
        averaged(std::span(seat.force).subspan(piece.begin, piece.size()), rate, in.options.spectrum_rate_hz);
    spectral.add(sparc(slow.values, slow.rate_hz), duration);
  }
  if (!(sums.samples > 0)) return;
  const double mean = sums.sum / sums.samples;
  of(values, Metric::kForcePeak) = sums.peak;
  of(values, Metric::kForceMean) = mean;
  of(values, Metric::kForceRms) = std::sqrt(sums.squares / sums.samples);
  of(values, Metric::kImpulse) = sums.sum / rate;
  of(values, Metric::kForceRateRms) = sums.rates > 0 ? std::sqrt(sums.rate_squares / sums.rates) : kUnknown;
  of(values, Metric::kForceRatePeak) = sums.rates > 0 ? sums.rate_peak : kUnknown;
  of(values, Metric::kWork) = sums.work;
  of(values, Metric::kExcessTime) = sums.excess / rate;
  of(values, Metric::kForceDeviation) = std::sqrt(std::max(0.0, sums.squares / sums.samples - mean * mean));
  of(values, Metric::kForceEllipsoid) = sums.ellipsoid();
  if (in.tool.has_surface && sums.sum > 0) of(values, Metric::kOffAxisShare) = sums.off_axis / sums.sum;
  of(values, Metric::kForceSparc) = spectral.value();
}

void score_contact(const PartInput& in, MetricValues& values) {
  const ToolTrack& tool = in.tool;
  double known_samples = 0, contact = 0, sum = 0, all = 0, peak = 0, depth = -1;
  for (std::size_t k = 0; k < in.grid.size(); ++k) {
    if (!in.part.has(k)) continue;
    if (std::isfinite(tool.penetration[k])) depth = std::max(depth, tool.penetration[k]);
    if (!std::isfinite(tool.force[k])) continue;
    known_samples += 1;
    all += tool.force[k];
    peak = std::max(peak, tool.force[k]);
    if (tool.contact[k] == 0) continue;
    contact += 1;
    sum += tool.force[k];
  }
  if (depth >= 0) of(values, Metric::kPenetrationMax) = depth;
  if (!(known_samples > 0)) return;
  const auto contacts = in.grid.runs([&](std::size_t k) { return in.part.has(k) && tool.contact[k] != 0; });
  of(values, Metric::kContacts) = static_cast<double>(contacts.size());
  of(values, Metric::kContactForcePeak) = peak;
  of(values, Metric::kContactImpulse) = all / in.grid.rate();
  if (!(contact > 0)) return;
  of(values, Metric::kContactTimeMean) = contact / in.grid.rate() / static_cast<double>(contacts.size());
  of(values, Metric::kContactForceMean) = sum / contact;
}

}  // namespace tandem::netsim::score
