#include "netsim/models/body_delay.h"

#include <algorithm>

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

using Kind = BodySpec::Kind;
enum BodyPurpose : std::uint64_t { kPerDatagram = 1, kProcess };

double nanoseconds(Duration d) noexcept { return static_cast<double>(d.count()); }

}  // namespace

BodyDelay::BodyDelay(const BodySpec& spec, RandomKey key)
    : spec_(spec),
      low_(nanoseconds(spec.low)),
      scale_(nanoseconds(spec.scale)),
      cap_(nanoseconds(spec.longest())),
      key_(key.derive(kPerDatagram)) {
  if (spec.tau > Duration::zero()) process_.emplace(spec.tau, key.derive(kProcess));
  if (spec.kind == Kind::kGamma || spec.kind == Kind::kHyperExponential) table_.emplace(spec);
  if (spec.kind == Kind::kTruncatedNormal) {
    u_low_ = normal_cdf((low_ - scale_) / nanoseconds(spec.sd));
    u_high_ = normal_cdf((cap_ - scale_) / nanoseconds(spec.sd));
  }
}

Duration BodyDelay::drawn(Time t, std::uint64_t index) noexcept {
  double ns = 0;
  // Kinds that need the normal quantile use it directly, without a detour over u.
  switch (spec_.kind) {
    case Kind::kLogNormal:
    case Kind::kGamma:
    case Kind::kHyperExponential: {
      const double z = process_ ? process_->at(t) : normal_quantile(open_unit(key_.uniform(index)));
      ns = table_ ? table_->at(z) : scale_ * log_normal_at(z, spec_.shape);
      break;
    }
    case Kind::kLogLogistic:
      ns = scale_ * (process_ ? log_logistic_at(process_->at(t), spec_.shape)
                              : log_logistic_quantile(open_unit(key_.uniform(index)), spec_.shape));
      break;
    default:
      ns = value(process_ ? normal_cdf(process_->at(t)) : key_.uniform(index));
      break;
  }
  return Duration{static_cast<std::int64_t>(std::min(ns, cap_) + 0.5)};
}

double BodyDelay::value(double u) const noexcept {
  switch (spec_.kind) {
    case Kind::kUniform:
      return low_ + nanoseconds(spec_.high - spec_.low) * u;
    case Kind::kTruncatedNormal: {
      const double inside = std::clamp(u_low_ + u * (u_high_ - u_low_), 0x1.0p-1000, 1 - 0x1.0p-53);
      return std::max(low_, scale_ + nanoseconds(spec_.sd) * normal_quantile(inside));
    }
    case Kind::kExponential:
      return scale_ * exponential_quantile(u);
    case Kind::kPareto:
      return scale_ * pareto_quantile(u, spec_.shape);
    case Kind::kEmpirical:
      return recorded(u);
    default:
      return 0;
  }
}

double BodyDelay::recorded(double u) const noexcept {
  const auto& points = spec_.quantiles;  // p is 0 at the first point and 1 at the last
  auto right = std::upper_bound(points.begin(), points.end(), u, [](double p, const auto& q) { return p < q.p; });
  if (right == points.end()) return nanoseconds(points.back().delay);
  const auto left = right - 1;
  const double w = (u - left->p) / (right->p - left->p);
  return nanoseconds(left->delay) + w * nanoseconds(right->delay - left->delay);
}

}  // namespace tandem::netsim
