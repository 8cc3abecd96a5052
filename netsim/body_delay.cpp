#include "netsim/body_delay.h"

#include <algorithm>

#include "netsim/quantiles.h"

namespace tandem::netsim {
namespace {

enum Purpose : std::uint64_t { kPerDatagram = 1, kProcess };

double nanoseconds(Duration d) noexcept { return static_cast<double>(d.count()); }

}  // namespace

BodyDelay::BodyDelay(const BodySpec& spec, RandomKey key) noexcept
    : kind_(spec.kind),
      low_(nanoseconds(spec.low)),
      width_(nanoseconds(spec.high - spec.low)),
      scale_(nanoseconds(spec.scale)),
      shape_(spec.shape),
      cap_(nanoseconds(spec.kind == BodySpec::Kind::kUniform ? spec.high : spec.cap)),
      key_(key.derive(kPerDatagram)) {
  if (spec.tau > Duration::zero()) process_.emplace(spec.tau, key.derive(kProcess));
}

Duration BodyDelay::drawn(Time t, std::uint64_t index) noexcept {
  double value = 0;
  switch (kind_) {
    case BodySpec::Kind::kNone:
      break;
    case BodySpec::Kind::kUniform:
      value = low_ + width_ * (process_ ? normal_cdf(process_->at(t)) : key_.uniform(index));
      break;
    case BodySpec::Kind::kLogNormal:
      value =
          scale_ * log_normal_at(process_ ? process_->at(t) : normal_quantile(open_unit(key_.uniform(index))), shape_);
      break;
    case BodySpec::Kind::kLogLogistic:
      value = scale_ * (process_ ? log_logistic_at(process_->at(t), shape_)
                                 : log_logistic_quantile(open_unit(key_.uniform(index)), shape_));
      break;
  }
  return Duration{static_cast<std::int64_t>(std::min(value, cap_) + 0.5)};
}

}  // namespace tandem::netsim
