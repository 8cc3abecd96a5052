#include "netsim/quality/age_of_information.h"

#include <algorithm>

#include "netsim/quality/delay_histogram.h"

namespace tandem::netsim {
namespace {

/// Upper end of the last bin; longer ages are clamped to it.
constexpr Duration kAgeMax = DelayScale::begin_of(DelayScale::kBins - 1);

}  // namespace

AgeOfInformation::AgeOfInformation() : bins_(DelayScale::kBins) {}

void AgeOfInformation::add(Duration from, Duration to, Time end) noexcept {
  from = std::clamp(from, Duration::zero(), kAgeMax);
  to = std::clamp(to, Duration::zero(), kAgeMax);
  if (to <= from) return;
  const auto mark = [this](Duration age, std::int64_t sign) {
    const std::size_t bin = DelayScale::bin_of(age);
    const Duration left = (bin + 1 < DelayScale::kBins ? DelayScale::begin_of(bin + 1) : kAgeMax) - age;
    bins_[bin].begun += sign;
    bins_[bin].rest += sign * left;
  };
  mark(from, 1);
  mark(to, -1);
  observed_ += to - from;
  integral_ += (seconds(to) - seconds(from)) * (seconds(to) + seconds(from)) / 2;
  if (to > max_) {
    max_ = to;
    max_at_ = end;
  }
}

Duration AgeOfInformation::quantile(double share) const noexcept {
  const double wanted = share * static_cast<double>(observed_.count());
  double below = 0;
  std::int64_t over = 0;
  for (std::size_t bin = 0; bin + 1 < bins_.size(); ++bin) {
    const Duration begin = DelayScale::begin_of(bin), width = DelayScale::begin_of(bin + 1) - begin;
    const double here =
        static_cast<double>(over) * static_cast<double>(width.count()) + static_cast<double>(bins_[bin].rest.count());
    if (here > 0 && below + here >= wanted) {
      const double part = std::clamp((wanted - below) / here, 0.0, 1.0);
      return begin + Duration{static_cast<std::int64_t>(part * static_cast<double>(width.count()))};
    }
    below += here;
    over += bins_[bin].begun;
  }
  return max_;
}

AgeSummary AgeOfInformation::summary() const noexcept {
  if (observed_ == Duration::zero()) return {};
  return {.watched = observed_,
          .mean_s = integral_ / seconds(observed_),
          .p50 = std::min(quantile(0.5), max_),
          .p99 = std::min(quantile(0.99), max_),
          .max = max_,
          .max_at = max_at_};
}

}  // namespace tandem::netsim
