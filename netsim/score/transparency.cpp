#include "netsim/score/transparency.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "netsim/score/experts.h"
#include "netsim/score/filters.h"

namespace tandem::netsim::score {
namespace {

constexpr double kRateMost = 100, kFrequencyMin = 0.5, kFrequencyMax = 10;  // [Hz]
constexpr double kCoherenceMin = 0.8;
constexpr double kWindowS = 1.28;
constexpr std::size_t kWindowsMin = 8;

using Complex = std::complex<double>;

/// Spectra of force and velocity on one side, summed over windows.
struct SideSpectra {
  std::vector<Complex> cross;           ///< conj(v) F
  std::vector<double> velocity, force;  ///< |v|^2, |F|^2

  void add(const std::vector<Complex>& v, const std::vector<Complex>& f) {
    cross.resize(v.size());
    velocity.resize(v.size());
    force.resize(v.size());
    for (std::size_t k = 0; k < v.size(); ++k) {
      cross[k] += std::conj(v[k]) * f[k];
      velocity[k] += std::norm(v[k]);
      force[k] += std::norm(f[k]);
    }
  }
  [[nodiscard]] bool coherent(std::size_t k) const {
    const double powers = velocity[k] * force[k];
    return powers > 0 && std::norm(cross[k]) > kCoherenceMin * powers;
  }
  [[nodiscard]] double impedance(std::size_t k) const { return std::abs(cross[k]) / velocity[k]; }
};

std::vector<double> block_means(const std::vector<LessonTriple>& values, const Stretch& piece, std::size_t axis,
                                std::size_t block) {
  std::vector<double> out;
  for (std::size_t k = piece.begin; k + block <= piece.end; k += block) {
    double sum = 0;
    for (std::size_t i = 0; i < block; ++i) sum += values[k + i][axis];
    out.push_back(sum / static_cast<double>(block));
  }
  return out;
}

/// Spectra of windows of a signal, without their mean.
class WindowSpectrum {
 public:
  explicit WindowSpectrum(std::size_t size) : shape_(size), shaped_(size) {
    transform_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    for (std::size_t k = 0; k < size; ++k)
      shape_[k] =
          0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(size));  // Hann
  }
  std::vector<Complex> of(std::span<const double> signal) {
    double mean = 0;
    for (const double value : signal) mean += value / static_cast<double>(signal.size());
    for (std::size_t k = 0; k < signal.size(); ++k) shaped_[k] = (signal[k] - mean) * shape_[k];
    std::vector<Complex> spectrum;
    transform_.fwd(spectrum, shaped_);
    return spectrum;
  }

 private:
  Eigen::FFT<double> transform_;
  std::vector<double> shape_, shaped_;
};

/// Stretches of contact of at least `least` elements in which all four signals are known. A loop of its own: it runs
/// for every part of a lesson, and LessonGrid::runs takes five times as many instructions.
std::vector<Stretch> contact_pieces(const PartInput& in, std::size_t axis, std::size_t least) {
  std::vector<Stretch> pieces;
  for (const Stretch& stretch : in.grid.stretches()) {
    std::size_t begin = stretch.begin;
    for (std::size_t k = stretch.begin; k <= stretch.end; ++k) {
      if (k < stretch.end && in.tool.contact[k] != 0 && in.part.has(k) &&
          std::isfinite(in.seat.x_raw[k][axis] + in.seat.f_raw[k][axis] + in.tool.x[k][axis] + in.tool.f_env[k][axis]))
        continue;
      if (k - begin >= least) pieces.push_back({begin, k});
      begin = k + 1;
    }
  }
  return pieces;
}

}  // namespace

double impedance_ratio(const PartInput& in) {
  if (!in.tool.has_surface) return kUnknown;
  const auto axis = static_cast<std::size_t>(in.tool.surface.axis);
  const auto block = std::max<std::size_t>(1, static_cast<std::size_t>(in.grid.rate() / kRateMost));
  const double rate = in.grid.rate() / static_cast<double>(block);
  const auto window = static_cast<std::size_t>(kWindowS * rate);
  if (window < 8) return kUnknown;
  const std::vector<Stretch> pieces = contact_pieces(in, axis, window * block);
  std::size_t windows = 0;
  for (const Stretch& piece : pieces) windows += (piece.size() / block - window) / (window / 2) + 1;
  if (windows < kWindowsMin) return kUnknown;
  SideSpectra hand, tool;
  WindowSpectrum spectrum{window};
  for (const Stretch& piece : pieces) {
    const std::vector<double> x = block_means(in.seat.x_raw, piece, axis, block),
                              f = block_means(in.seat.f_raw, piece, axis, block),
                              x_tool = block_means(in.tool.x, piece, axis, block),
                              f_env = block_means(in.tool.f_env, piece, axis, block);
    const std::vector<double> v = derivative(std::span<const double>(x), rate),
                              v_tool = derivative(std::span<const double>(x_tool), rate);
    for (std::size_t from = 0; from + window <= x.size(); from += window / 2) {
      const auto at = [&](const std::vector<double>& signal) {
        return spectrum.of(std::span(signal).subspan(from, window));
      };
      hand.add(at(v), at(f));
      tool.add(at(v_tool), at(f_env));
    }
  }
  std::vector<double> ratios;
  for (std::size_t k = 1; k < hand.cross.size(); ++k) {
    const double frequency = static_cast<double>(k) * rate / static_cast<double>(window);
    if (frequency < kFrequencyMin || frequency > kFrequencyMax || !hand.coherent(k) || !tool.coherent(k)) continue;
    ratios.push_back(hand.impedance(k) / tool.impedance(k));
  }
  return median_of(std::move(ratios));
}

}  // namespace tandem::netsim::score
