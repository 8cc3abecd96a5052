#include "netsim/models/delay_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tandem::netsim {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using Kind = BodySpec::Kind;

constexpr Duration kCheckedDelayMax = std::chrono::seconds(60);
constexpr std::size_t kPhasesMax = 8, kQuantilesMax = 4096, kRegimesMax = 16;

void check_quantiles(const std::string& key, const std::vector<QuantilePoint>& points, SpecErrors& found) {
  if (points.size() < 2 || points.size() > kQuantilesMax) {
    found.add(key, std::to_string(points.size()) + " points are not in [2, 4096]");
    return;
  }
  if (points.front().p != 0 || points.back().p != 1) found.add(key, "the first is not at 0 or the last not at 1");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string here = key + "[" + std::to_string(i) + "]";
    found.range<Duration>(here + ".delay", points[i].delay, Duration::zero(), kCheckedDelayMax);
    if (i > 0 && !(points[i].p > points[i - 1].p)) found.add(here + ".p", "does not ascend");
    if (i > 0 && points[i].delay < points[i - 1].delay) found.add(here + ".delay", "falls");
  }
}

void check_phases(const std::string& key, const std::vector<HyperPhase>& phases, SpecErrors& found) {
  if (phases.empty() || phases.size() > kPhasesMax) {
    found.add(key, std::to_string(phases.size()) + " phases are not in [1, 8]");
  }
  double sum = 0;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const std::string here = key + "[" + std::to_string(i) + "]";
    found.above(here + ".weight", phases[i].weight, 0.0, 1.0);
    found.above<Duration>(here + ".mean", phases[i].mean, Duration::zero(), kCheckedDelayMax);
    sum += phases[i].weight;
  }
  if (!(std::abs(sum - 1) < 1e-6)) found.add(key, "weights add up to " + SpecErrors::text(sum) + ", not 1");
}

}  // namespace

void check_body(std::string_view name, const BodySpec& body, SpecErrors& found) {
  const std::string key(name);
  if (body.kind == Kind::kNone) return;
  if (body.tau != Duration::zero()) {
    found.range<Duration>(key + ".tau", body.tau, microseconds(10), std::chrono::seconds(10));
  }
  if (body.kind == Kind::kUniform) {
    found.range<Duration>(key + ".low", body.low, Duration::zero(), kCheckedDelayMax);
    found.range<Duration>(key + ".high", body.high, Duration::zero(), kCheckedDelayMax);
    if (body.low > body.high) {
      found.add(key + ".low", SpecErrors::text(body.low) + " is above the high end, " + SpecErrors::text(body.high));
    }
    return;
  }
  if (body.kind == Kind::kEmpirical) return check_quantiles(key + ".quantiles", body.quantiles, found);
  if (body.kind == Kind::kHyperExponential) {
    check_phases(key + ".phases", body.phases, found);
  } else if (body.kind == Kind::kTruncatedNormal) {
    found.range<Duration>(key + ".scale", body.scale, Duration::zero(), kCheckedDelayMax);
  } else {
    found.above<Duration>(key + ".scale", body.scale, Duration::zero(), kCheckedDelayMax);
  }
  found.above<Duration>(key + ".cap", body.cap, Duration::zero(), kCheckedDelayMax);
  switch (body.kind) {
    case Kind::kTruncatedNormal:
      found.above<Duration>(key + ".sd", body.sd, Duration::zero(), kCheckedDelayMax);
      found.range<Duration>(key + ".low", body.low, Duration::zero(), kCheckedDelayMax);
      if (body.low >= body.cap) found.add(key + ".low", "is not below the cap");
      if (body.scale < body.low || body.scale > body.cap) found.add(key + ".scale", "is not between low and cap");
      break;
    case Kind::kLogNormal:
      found.range(key + ".shape", body.shape, 0.0, 5.0);
      break;
    case Kind::kPareto:
      if (body.cap < body.scale) found.add(key + ".cap", "is below the least value, scale");
      [[fallthrough]];
    case Kind::kLogLogistic:
    case Kind::kGamma:
      found.range(key + ".shape", body.shape, 0.5, 100.0);
      break;
    default:
      break;
  }
}

void check_delay_models(const PathSpec& spec, SpecErrors& found) {
  if (spec.regimes.size() == 1 || spec.regimes.size() > kRegimesMax) {
    found.add("regimes", std::to_string(spec.regimes.size()) + " are not in [2, 16]");
  }
  for (std::size_t i = 0; i < spec.regimes.size(); ++i) {
    const std::string key = "regimes[" + std::to_string(i) + "]";
    found.range<Duration>(key + ".mean", spec.regimes[i].mean, milliseconds(1), hours(1));
    found.range<Duration>(key + ".floor", spec.regimes[i].floor, Duration::zero(), kCheckedDelayMax);
    check_body(key + ".body", spec.regimes[i].body, found);
  }
  if (const BoundarySpec& b = spec.boundary; b != BoundarySpec{}) {
    found.range<Duration>("boundary.period", b.period, milliseconds(1), hours(1));
    const Duration last = std::max(b.period - Duration{1}, Duration::zero());
    found.range<Duration>("boundary.phase", b.phase, Duration::zero(), last);
    found.range<Duration>("boundary.stall_high", b.stall_high, Duration::zero(), std::min(last, kCheckedDelayMax));
    found.range<Duration>("boundary.stall_low", b.stall_low, Duration::zero(), b.stall_high);
    found.range<Duration>("boundary.floor_high", b.floor_high, Duration::zero(), kCheckedDelayMax);
    found.range<Duration>("boundary.loss_window", b.loss_window, Duration::zero(), b.period);
    found.range("boundary.loss", b.loss, 0.0, 1.0);
    if (b.loss > 0 && b.loss_window == Duration::zero()) found.add("boundary.loss", "there is no window to lose in");
  }
  if (spec.slots != SlotsSpec{}) {
    found.range<Duration>("slots.period", spec.slots.period, microseconds(1), std::chrono::seconds(10));
    if (spec.order != ArrivalOrder::kFifo) found.add("slots.period", "a grid of slots keeps the order");
  }
}

}  // namespace tandem::netsim
