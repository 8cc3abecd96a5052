#include "netsim/models/path_spec.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "netsim/models/corruption.h"
#include "netsim/models/delay_checks.h"

namespace tandem::netsim {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::minutes;

constexpr Duration kDelayMax = std::chrono::seconds(60);

void check_outages(const std::vector<OutageSpec>& outages, SpecErrors& found) {
  if (outages.size() > 64) found.add("outages", std::to_string(outages.size()) + " are more than 64");
  for (std::size_t i = 0; i < outages.size(); ++i) {
    const OutageSpec& outage = outages[i];
    const std::string key = "outages[" + std::to_string(i) + "]";
    found.range<Duration>(key + ".start", outage.start, Duration::zero(), hours(24 * 30));
    found.above<Duration>(key + ".length", outage.length, Duration::zero(), hours(1));
    if (outage.length > Duration::zero())  // otherwise the length itself is reported
      found.range<Duration>(key + ".loss_at_start", outage.loss_at_start, Duration::zero(), outage.length);
    if (outage.hold_bytes > 0 && outage.mode != OutageSpec::Mode::kHold) {
      found.add(key + ".hold_bytes", "nothing is held: belongs to the mode hold");
    }
    if (outage.mean_gap != Duration::zero()) {
      found.range<Duration>(key + ".mean_gap", outage.mean_gap, microseconds(1000), hours(24));
      found.range<Duration>(key + ".length_max", outage.length_max, outage.length, hours(1));
      if (outage.length_max / 32 > outage.mean_gap) found.add(key + ".length_max", "is above 32 times mean_gap");
      if (outage.period != Duration::zero() || outage.start != Duration::zero()) {
        found.add(key + ".mean_gap", "excludes start and period");
      }
      continue;
    }
    if (outage.scope == OutageSpec::Scope::kAll && outage.length_max == Duration::zero()) {
      found.add(key + ".scope", "nothing is drawn: needs mean_gap, or length_max");
    }
    if (outage.period == Duration::zero()) {
      if (outage.length_max != Duration::zero()) found.add(key + ".length_max", "needs mean_gap or period");
      continue;
    }
    if (outage.length_max != Duration::zero()) {
      found.range<Duration>(key + ".length_max", outage.length_max, outage.length, hours(1));
      if (outage.length_max >= outage.period) found.add(key + ".length_max", "is not below the period");
    }
    found.range<Duration>(key + ".period", outage.period, Duration::zero(), hours(24 * 30));
    if (outage.period > Duration::zero() && outage.period <= outage.length) {
      found.add(key + ".period", SpecErrors::text(outage.period) + " is not longer than the outage (" +
                                     SpecErrors::text(outage.length) + "): the link would never be up");
    }
  }
}

void check_capacity(const RateSpec& rate, SpecErrors& found) {
  if (rate.bits_per_s != 0) found.add("rate.trace", "a recorded capacity excludes bits_per_s");
  if (rate.competing_peak != Duration::zero()) found.add("rate.competing_peak", "not with a recorded capacity");
  const auto& entries = rate.trace->entries;
  bool ascends = !entries.empty() && entries.front().ms >= 0;
  for (std::size_t i = 0; ascends && i < entries.size(); ++i) {
    ascends = entries[i].opportunities > 0 && (i == 0 || entries[i].ms > entries[i - 1].ms);
  }
  if (!ascends) return found.add("rate.trace.entries", "are none, do not ascend or hold no opportunity");
  const Duration end = std::chrono::milliseconds(1) * entries.back().ms;
  if (rate.trace->period <= end || rate.trace->period % std::chrono::milliseconds(1) != Duration::zero()) {
    found.add("rate.trace.period", "is not after the last entry, or no whole millisecond");
  }
}

void check_head_drop(const RateSpec& rate, SpecErrors& found) {
  if (rate.drop != RateSpec::Drop::kHead) return;
  if (rate.queue_bytes == 0 && rate.queue_datagrams == 0 && !rate.queue_wait) {
    found.add("rate.drop", "a queue without a limit drops nothing at its head");
  }
  if (rate.codel) found.add("rate.codel", "drops at the head by a law of its own: excludes the drop at the head");
  if (rate.competing_peak != Duration::zero()) found.add("rate.competing_peak", "excludes the drop at the head");
}

void check_mtu(const PathSpec& spec, SpecErrors& found) {
  if (spec.mtu.bytes == 0) {
    if (spec.mtu.above == MtuSpec::Above::kFragment) found.add("mtu.above", "fragments need an MTU");
    return;
  }
  const std::uint32_t least = spec.rate.overhead_bytes + (spec.mtu.above == MtuSpec::Above::kFragment ? 8 : 1);
  if (spec.mtu.bytes < least) {
    found.add("mtu.bytes", std::to_string(spec.mtu.bytes) + " leaves no room beside the overhead of " +
                               std::to_string(spec.rate.overhead_bytes) + " bytes; at least " + std::to_string(least));
  }
}

void check_rate(const RateSpec& rate, SpecErrors& found) {
  if (rate.recorded && !rate.trace) {
    return found.add("rate.trace", "the capacity comes from a recording that must be supplied");
  }
  check_head_drop(rate, found);
  if (rate.queue_datagrams > 65'536) found.add("rate.queue_datagrams", "is above 65536");
  if (rate.codel) {
    found.above<Duration>("rate.codel.target", rate.codel->target, Duration::zero(), std::chrono::seconds(10));
    found.above<Duration>("rate.codel.interval", rate.codel->interval, rate.codel->target, std::chrono::seconds(60));
  }
  if (rate.trace) {
    if (rate.queue_wait) found.range<Duration>("rate.queue_wait", *rate.queue_wait, Duration::zero(), hours(1));
    return check_capacity(rate, found);
  }
  if (rate.bits_per_s == 0) {
    const std::pair<const char*, bool> parts[] = {{"rate.drop", rate.drop == RateSpec::Drop::kHead},
                                                  {"rate.queue_bytes", rate.queue_bytes != 0},
                                                  {"rate.queue_datagrams", rate.queue_datagrams != 0},
                                                  {"rate.codel", rate.codel.has_value()},
                                                  {"rate.queue_wait", rate.queue_wait.has_value()},
                                                  {"rate.competing_peak", rate.competing_peak != Duration::zero()}};
    for (const auto& [key, present] : parts)
      if (present) found.add(key, "a queue needs a rate");
    return;
  }
  found.range("rate.bits_per_s", static_cast<double>(rate.bits_per_s), 100.0, 1e12);
  found.range("rate.overhead_bytes", static_cast<double>(rate.overhead_bytes), 0.0, 1000.0);
  if (rate.queue_wait) found.range<Duration>("rate.queue_wait", *rate.queue_wait, Duration::zero(), hours(1));
  if (rate.competing_peak == Duration::zero() && rate.competing_period == Duration::zero()) return;
  found.above<Duration>("rate.competing_peak", rate.competing_peak, Duration::zero(), hours(1));
  found.above<Duration>("rate.competing_period", rate.competing_period, rate.competing_peak, hours(1));
}

void check_trace(const DelayTrace* trace, SpecErrors& found) {
  if (trace == nullptr) return;
  if (trace->steps.empty() || trace->steps.front().at != Duration::zero()) {
    found.add("trace.steps", "the first step must be at 0");
    return;
  }
  for (std::size_t i = 0; i < trace->steps.size(); ++i) {
    const std::string key = "trace.steps[" + std::to_string(i) + "]";
    found.range<Duration>(key + ".delay", trace->steps[i].delay, Duration::zero(), kDelayMax);
    if (i > 0 && trace->steps[i].at <= trace->steps[i - 1].at) found.add(key + ".at", "time does not go on");
  }
  if (trace->period <= trace->steps.back().at) found.add("trace.period", "ends before the last step");
}

void check_stall(const StallSpec& stall, SpecErrors& found) {
  if (stall.rate_per_s == 0) return;
  found.range("stall.rate_per_s", stall.rate_per_s, 0.0, 100.0);
  found.above<Duration>("stall.length_min", stall.length_min, Duration::zero(), kDelayMax);
  found.range("stall.alpha", stall.alpha, 0.5, 100.0);
  found.range<Duration>("stall.cap", stall.cap, std::max(Duration{1}, stall.length_min), kDelayMax);
  const double covered = stall.rate_per_s * tandem::seconds(stall.cap);
  if (covered > 32) {
    found.add("stall.rate_per_s",
              SpecErrors::text(covered) + " stalls of the longest length at the same time; at most 32");
  }
}

}  // namespace

std::vector<SpecError> problems(const PathSpec& spec) {
  SpecErrors found;
  check_outages(spec.outages, found);
  check_loss(spec.loss, spec.rate.present(), spec.stall.rate_per_s > 0, found);
  check_rate(spec.rate, found);
  found.range<Duration>("floor", spec.floor, Duration::zero(), kDelayMax);
  check_trace(spec.trace.get(), found);
  check_body("body", spec.body, found);
  check_delay_models(spec, found);
  check_stall(spec.stall, found);
  found.range("reorder.probability", spec.reorder.probability, 0.0, 1.0);
  if (spec.reorder.probability > 0) {
    found.range("reorder.displacement", static_cast<double>(spec.reorder.displacement), 1.0, 1000.0);
    found.above<Duration>("reorder.hold_limit", spec.reorder.hold_limit, Duration::zero(), kDelayMax);
  }
  found.range("corruption.probability", spec.corruption.probability, 0.0, 1.0);
  if (spec.corruption.mode == CorruptionSpec::Mode::kBitFlips) {
    found.range("corruption.bits", static_cast<double>(spec.corruption.bits), 1.0, static_cast<double>(kFlipsMax));
  }
  check_mtu(spec, found);
  found.range("duplicate.probability", spec.duplicate.probability, 0.0, 1.0);
  if (spec.duplicate.probability > 0) {
    found.range<Duration>("duplicate.delay_max", spec.duplicate.delay_max, Duration::zero(), kDelayMax);
  }
  return found.take();
}

bool defers(const PathSpec& spec) noexcept {
  return spec.rate.drop == RateSpec::Drop::kHead || std::ranges::any_of(spec.outages, [](const OutageSpec& outage) {
           return outage.mode == OutageSpec::Mode::kHoldLast;
         });
}

bool waits_for_others(const PathSpec& spec) noexcept { return defers(spec) || spec.reorder.probability > 0; }

Duration delay_max(const PathSpec& spec) noexcept {
  Duration sum = spec.floor;
  if (spec.trace) {
    Duration longest{};
    for (const DelayTrace::Step& step : spec.trace->steps) longest = std::max(longest, step.delay);
    sum += longest;
  }
  sum += spec.body.longest();
  Duration regime{};
  for (const RegimeSpec& state : spec.regimes) regime = std::max(regime, state.floor + state.body.longest());
  sum += regime + spec.boundary.floor_high + spec.boundary.stall_high + spec.slots.period;
  if (spec.stall.rate_per_s > 0) sum += spec.stall.cap;
  if (spec.reorder.probability > 0) sum += spec.reorder.hold_limit;
  if (spec.duplicate.probability > 0) sum += spec.duplicate.delay_max;
  Duration held{};
  for (const OutageSpec& outage : spec.outages) {
    if (outage.mode != OutageSpec::Mode::kDrop) held = std::max({held, outage.length, outage.length_max});
  }
  return sum + held;
}

LinkSpec link_from(const SimpleNetwork& numbers) {
  PathSpec path;
  path.floor = numbers.delay;
  if (numbers.jitter != Duration::zero()) {  // a negative one is an error of the spec
    path.body.kind = BodySpec::Kind::kUniform;
    path.body.high = numbers.jitter;
  }
  path.loss.probability = numbers.loss;
  path.duplicate.probability = numbers.duplicate;
  path.reorder.probability = numbers.reorder;
  path.outages = numbers.outages;
  return {path, path};
}

}  // namespace tandem::netsim
