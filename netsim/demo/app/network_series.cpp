#include "netsim/demo/app/network_series.h"

#include <algorithm>
#include <cmath>

#include "netsim/engine/path_decision.h"

namespace tandem::netsim::demo {
namespace {

constexpr std::size_t kFlow = 0;       ///< the trainer joins first
constexpr double kTickSeconds = 1e-3;  ///< width of the mark of one lost datagram [s]

double seconds_since(Time from, Time at) { return static_cast<double>((at - from).count()) * 1e-9; }

}  // namespace

NetworkSeries network_series(std::span<const Decision> decisions, Time begin, double length) {
  NetworkSeries series;
  for (const Decision& d : decisions) {
    const double t = seconds_since(begin, d.in);
    if (d.flow != kFlow || d.copy || t < 0 || t > length) continue;
    const std::size_t way = d.direction == Direction::kUp ? 0 : 1;
    if (d.outcome == Outcome::kDeliver) {
      series.delay[way].push_back({t, 1e3 * seconds_since(d.in, d.out)});
    } else if (dropped(d.outcome)) {
      series.lost[way].push_back({t, t + kTickSeconds, ""});
    }
  }
  for (auto& curve : series.delay) curve = plot::downsample_extremes(curve, plot::kCurvePointsMax);
  return series;
}

Time begin_of_session(std::span<const Decision> decisions, double length) {
  Time last{};
  for (const Decision& d : decisions)
    if (d.flow == kFlow && d.direction == Direction::kUp) last = std::max(last, d.in);
  return last - Duration{std::llround(length * 1e9)};
}

}  // namespace tandem::netsim::demo
