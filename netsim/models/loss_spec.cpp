#include "netsim/models/loss_spec.h"

#include <algorithm>
#include <cmath>

#include "netsim/models/spec_errors.h"

namespace tandem::netsim {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;

constexpr std::size_t kListMax = 4096;
constexpr std::size_t kTraceMax = 10'000'000;

void check(const BadPeriodsSpec& periods, SpecErrors& found) {
  found.range<Duration>("loss.periods.good_mean", periods.good_mean, microseconds(1), hours(1));
  found.range<Duration>("loss.periods.bad_mean", periods.bad_mean, microseconds(1), hours(1));
  found.range("loss.periods.loss_good", periods.loss_good, 0.0, 1.0);
  found.range("loss.periods.loss_bad", periods.loss_bad, 0.0, 1.0);
}

void check(const GilbertElliottSpec& ge, SpecErrors& found) {
  found.above("loss.gilbert_elliott.p", ge.p, 0.0, 1.0);
  found.above("loss.gilbert_elliott.r", ge.r, 0.0, 1.0);
  found.range("loss.gilbert_elliott.h", ge.h, 0.0, 1.0);
  found.range("loss.gilbert_elliott.k", ge.k, 0.0, 1.0);
  if (ge.h > ge.k) found.add("loss.gilbert_elliott.h", "the bad state passes more than the good one");
}

void check(const FourStateSpec& s, SpecErrors& found) {
  for (const auto& [key, p] : {std::pair{"p13", s.p13}, {"p31", s.p31}, {"p32", s.p32}, {"p23", s.p23}, {"p14", s.p14}})
    found.range(std::string("loss.four_state.") + key, p, 0.0, 1.0);
  if (s.p13 + s.p14 > 1) found.add("loss.four_state.p13", "p13 + p14 is above 1");
  if (s.p31 + s.p32 > 1) found.add("loss.four_state.p31", "p31 + p32 is above 1");
  if (s.p13 > 0 && s.p31 == 0) found.add("loss.four_state.p31", "is 0: a burst would never end");
  if (s.p32 > 0 && s.p23 == 0) found.add("loss.four_state.p23", "is 0: state 2 would never be left");
}

void check(const LossBurstsSpec& bursts, SpecErrors& found) {
  found.above("loss.bursts.rate_per_s", bursts.rate_per_s, 0.0, 1000.0);
  found.above("loss.bursts.cap", bursts.cap, 0.0, 1e5);
  found.above("loss.bursts.length", bursts.length, 0.0, bursts.cap);
  found.range("loss.bursts.alpha", bursts.alpha, 0.1, 100.0);
  const bool datagrams = bursts.unit == LossBurstsSpec::Unit::kDatagrams;
  if (datagrams && bursts.law != LossBurstsSpec::Law::kParetoII && bursts.length < 1) {
    found.add("loss.bursts.length", SpecErrors::text(bursts.length) + " datagrams are less than 1");
  }
  if (datagrams && bursts.law == LossBurstsSpec::Law::kFixed && bursts.length != std::floor(bursts.length)) {
    found.add("loss.bursts.length", SpecErrors::text(bursts.length) + " datagrams: must be a whole number");
  }
  if (!datagrams && bursts.rate_per_s * bursts.cap > 32e3) {
    found.add("loss.bursts.rate_per_s", "times cap is more than 32 bursts at the same time");
  }
}

template <typename T>
void check_list(const std::vector<T>& list, std::string_view key, SpecErrors& found) {
  if (list.size() > kListMax) found.add(key, std::to_string(list.size()) + " are more than 4096");
  if (std::adjacent_find(list.begin(), list.end(), std::greater_equal<>{}) != list.end()) {
    found.add(key, "do not ascend");
  }
}

void check(const LossPatternSpec& pattern, SpecErrors& found) {
  if (pattern.lost > pattern.of) found.add("loss.pattern.lost", "more are to be lost than there are in a window");
  if (pattern.of > 0 && pattern.lost == 0) found.add("loss.pattern.lost", "is 0: leave the window out");
  check_list(pattern.indices, "loss.pattern.indices", found);
  check_list(pattern.times, "loss.pattern.times", found);
}

void check(const CongestionLossSpec& c, bool has_rate, bool has_stall, SpecErrors& found) {
  found.range("loss.congestion.probability", c.probability, 0.0, 1.0);
  found.range("loss.congestion.in_stall", c.in_stall, 0.0, 1.0);
  found.range<Duration>("loss.congestion.wait_low", c.wait_low, Duration::zero(), hours(1));
  found.range<Duration>("loss.congestion.wait_high", c.wait_high, Duration::zero(), hours(1));
  if (c.probability > 0 && c.wait_high <= c.wait_low) {
    found.add("loss.congestion.wait_high", "is not above wait_low");
  }
  if (c.probability > 0 && !has_rate) found.add("loss.congestion.probability", "a queue needs a rate");
  if (c.in_stall > 0 && !has_stall) found.add("loss.congestion.in_stall", "there are no stalls");
}

void check(const LossTrace& trace, SpecErrors& found) {
  if (trace.lost.empty() || trace.lost.size() > kTraceMax) {
    found.add("loss.trace", std::to_string(trace.lost.size()) + " entries are not in [1, 1e7]");
  }
  if (trace.interval != Duration::zero()) {
    found.range<Duration>("loss.trace.interval", trace.interval, microseconds(1), hours(1));
  }
}

}  // namespace

void check_loss(const LossSpec& loss, bool has_rate, bool has_stall, SpecErrors& found) {
  found.range("loss.probability", loss.probability, 0.0, 1.0);
  if (loss.periods) check(*loss.periods, found);
  if (loss.gilbert_elliott) check(*loss.gilbert_elliott, found);
  if (loss.four_state) check(*loss.four_state, found);
  if (loss.bursts) check(*loss.bursts, found);
  if (loss.pattern) check(*loss.pattern, found);
  if (loss.congestion) check(*loss.congestion, has_rate, has_stall, found);
  if (loss.trace) check(*loss.trace, found);
}

}  // namespace tandem::netsim
