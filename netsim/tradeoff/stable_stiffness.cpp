#include "netsim/tradeoff/stable_stiffness.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim::tradeoff {
namespace {

constexpr int kTicks = 400, kHalvings = 40;
constexpr double kStart = 1e-3;  ///< elongation at the start [m]

/// Whether one axis without surfaces, released from an elongation, swings further in the second half of a run than in
/// the first.
bool grows(const ToolTask& task, double tick_hz, const control::Numerics& numerics, double k) {
  control::VirtualTool tool(task.tool, 1, {}, numerics);
  tool.rest_at({kStart});
  control::VirtualTool::Pulls pulls{};
  pulls[0].spring(task.k_c + k, 0);
  pulls[0].damper(task.b_rel, 0);
  double early = kStart, late = 0;
  for (int i = 0; i < kTicks; ++i) {
    if (!tool.step(1 / tick_hz, pulls)) return true;
    double& widest = i < kTicks / 2 ? early : late;
    widest = std::max(widest, std::abs(tool.x(0)));
  }
  return late > early;
}

}  // namespace

double stable_stiffness(const ToolTask& task, double tick_hz, const control::Numerics& numerics) {
  if (!grows(task, tick_hz, numerics, kStiffnessMost)) return kStiffnessMost;
  if (grows(task, tick_hz, numerics, 0)) return 0;
  double lo = 1, hi = kStiffnessMost;  // in equal ratios
  if (grows(task, tick_hz, numerics, lo)) return 0;
  for (int i = 0; i < kHalvings && hi > 1.001 * lo; ++i) {
    const double k = std::sqrt(lo * hi);
    (grows(task, tick_hz, numerics, k) ? hi : lo) = k;
  }
  return lo;
}

}  // namespace tandem::netsim::tradeoff
