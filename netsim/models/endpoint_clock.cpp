#include "netsim/models/endpoint_clock.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tandem::netsim {
namespace {

__extension__ using WideTime = __int128;
constexpr WideTime kE12 = 1'000'000'000'000;
constexpr Duration kDay = std::chrono::hours(24);
constexpr std::size_t kStepsMax = 64;

void check_wake(const WakeSpec& wake, SpecErrors& found) {
  const Duration lowest = Duration::zero();
  if (wake.kind == WakeSpec::Kind::kUniform) {
    found.range<Duration>("wake.late_max", wake.late_max, lowest, std::chrono::seconds(1));
    found.range<Duration>("wake.phase", wake.phase, lowest, std::chrono::seconds(1));
    return;
  }
  if (wake.late_max != lowest) found.add("wake.late_max", "needs kind uniform");
  if (wake.phase != lowest) found.add("wake.phase", "needs kind uniform");
  if (wake.shifts) found.add("wake.shifts", "needs kind uniform");
}

}  // namespace

std::vector<SpecError> problems(const EndpointSpec& spec) {
  SpecErrors found;
  found.range<Duration>("offset", spec.offset, -kDay, kDay);
  found.range("drift_ppm", spec.drift_ppm, -1000.0, 1000.0);
  if (spec.steps.size() > kStepsMax) found.add("steps", std::to_string(spec.steps.size()) + " are more than 64");
  for (std::size_t i = 0; i < spec.steps.size(); ++i) {
    const std::string key = "steps[" + std::to_string(i) + "]";
    found.range<Duration>(key + ".at", spec.steps[i].at, Duration::zero(), 30 * kDay);
    found.range<Duration>(key + ".by", spec.steps[i].by, -kDay, kDay);
    if (i > 0 && spec.steps[i].at <= spec.steps[i - 1].at) found.add(key + ".at", "does not ascend");
  }
  check_wake(spec.wake, found);
  return found.take();
}

EndpointClock::EndpointClock(const EndpointSpec& spec) : offset_(spec.offset), drift_e12_(0), steps_(spec.steps) {
  throw_if_any("endpoint", problems(spec));
  drift_e12_ = std::llround(spec.drift_ppm * 1e6);
}

Time EndpointClock::at(Time now) const noexcept {
  const WideTime product = WideTime{now.time_since_epoch().count()} * drift_e12_;
  WideTime drift = product / kE12;
  if (product % kE12 < 0) --drift;  // rounds down also below zero; otherwise time would stop around zero drift
  Time own = now + offset_ + Duration{static_cast<std::int64_t>(drift)};
  for (const EndpointSpec::Step& step : steps_) {
    if (step.at > now.time_since_epoch()) break;
    own += step.by;
  }
  return own;
}

WakeUps::WakeUps(const WakeSpec& spec, Duration tick, Time start, RandomKey key)
    : spec_(spec), tick_(tick), start_(start + spec.phase), key_(key) {
  SpecErrors found;
  check_wake(spec, found);
  found.above<Duration>("tick", tick, Duration::zero(), std::chrono::seconds(1));
  throw_if_any("endpoint", found.take());
  next_ = spec_.kind == WakeSpec::Kind::kMeasured ? start_ : deadline(0);
}

std::optional<Time> WakeUps::within(Time since, Time now) noexcept {
  if (now < next_) return std::nullopt;
  const Time woke = std::max(next_, since);
  ++count_;
  schedule_next(woke);
  return woke;
}

double WakeUps::measured_step(double u) noexcept {
  struct Point {
    double u, step;
  };
  constexpr Point kPoints[] = {{0, 1}, {0.5, 1.02}, {0.99, 1.92}, {1, 2.77}};
  for (std::size_t i = 1; i < std::size(kPoints); ++i) {
    const auto& [lo, hi] = std::pair{kPoints[i - 1], kPoints[i]};
    if (u <= hi.u) return lo.step + (hi.step - lo.step) * (u - lo.u) / (hi.u - lo.u);
  }
  return kPoints[3].step;
}

Time WakeUps::deadline(std::uint64_t n) const noexcept {
  const double late = key_.uniform(n) * static_cast<double>(spec_.late_max.count() + 1);
  return start_ + tick_ * static_cast<std::int64_t>(n) + Duration{static_cast<std::int64_t>(late)};
}

void WakeUps::schedule_next(Time woke) noexcept {
  if (spec_.kind == WakeSpec::Kind::kMeasured) {
    // The step starts at the scheduled wake-up, not at the call that served it. The step distribution therefore does
    // not depend on the caller's time grid.
    const double step = measured_step(key_.uniform(number_++)) * static_cast<double>(tick_.count());
    next_ += Duration{std::llround(step)};
    return;
  }
  // Deadlines that have passed are skipped; the loop sleeps until the next future deadline.
  const auto following = static_cast<std::uint64_t>((woke - start_) / tick_) + 1;
  skipped_ += following - number_ - 1;
  number_ = following;
  next_ = deadline(number_);
}

}  // namespace tandem::netsim
