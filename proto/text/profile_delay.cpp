#include "proto/text/profile_delay.h"

#include <cmath>

#include "common/base/milliseconds.h"
#include "proto/schema/profile.pb.h"

namespace tandem::netsim {
namespace {

using text::child_path;
using text::MessageValidator;
using Kind = BodySpec::Kind;

void fill(BodySpec& body, const pb::UniformDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kUniform;
  body.low = from_milliseconds(in.low_ms());
  body.high = from_milliseconds(in.high_ms());
  if (in.low_ms() > in.high_ms()) validator.error(child_path(key, "low_ms"), "is above high_ms");
}

void fill(BodySpec& body, const pb::TruncatedNormalDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kTruncatedNormal;
  body.scale = from_milliseconds(in.mean_ms());
  body.sd = from_milliseconds(in.sd_ms());
  body.low = from_milliseconds(in.low_ms());
  body.cap = from_milliseconds(in.cap_ms());
  if (in.low_ms() >= in.cap_ms()) validator.error(child_path(key, "low_ms"), "is not below cap_ms");
  if (in.mean_ms() < in.low_ms() || in.mean_ms() > in.cap_ms()) {
    validator.error(child_path(key, "mean_ms"), "is not between low_ms and cap_ms");
  }
}

void fill(BodySpec& body, const pb::HyperExponentialDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kHyperExponential;
  body.cap = from_milliseconds(in.cap_ms());
  double sum = 0;
  for (const auto& phase : in.phase()) {
    body.phases.push_back({phase.weight(), from_milliseconds(phase.mean_ms())});
    sum += phase.weight();
  }
  if (!(std::abs(sum - 1) < 1e-6)) validator.error(key, "the weights of its phases must add up to 1");
}

void fill(BodySpec& body, const pb::EmpiricalDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kEmpirical;
  const auto& points = in.point();
  for (int i = 0; i < points.size(); ++i) {
    const std::string here = child_path(key, "point", i);
    body.quantiles.push_back({points[i].percent() / 100, from_milliseconds(points[i].delay_ms())});
    if (i == 0) continue;
    if (points[i].percent() <= points[i - 1].percent()) validator.error(here + ".percent", "does not ascend");
    if (points[i].delay_ms() < points[i - 1].delay_ms()) validator.error(here + ".delay_ms", "falls");
  }
  if (points.size() < 2 || points[0].percent() != 0 || points[points.size() - 1].percent() != 100) {
    validator.error(key, "needs points from percent 0 to percent 100");
  }
}

BodySpec body_from(const pb::Body& in, MessageValidator& validator, const std::string& key) {
  BodySpec body{.shape = 0};  // stays 0 for kinds without a shape
  const int given = in.has_uniform() + in.has_log_normal() + in.has_log_logistic() + in.has_truncated_normal() +
                    in.has_exponential() + in.has_gamma() + in.has_hyper_exponential() + in.has_pareto() +
                    in.has_empirical();
  if (given != 1) {
    validator.error(key,
                    "needs exactly one of uniform, log_normal, log_logistic, truncated_normal, exponential, gamma, "
                    "hyper_exponential, pareto, empirical");
  }
  const auto take = [&body](Kind kind, double scale_ms, double shape, double cap_ms) {
    body.kind = kind;
    body.scale = from_milliseconds(scale_ms);
    body.shape = shape;
    body.cap = from_milliseconds(cap_ms);
  };
  if (in.has_log_normal()) {
    take(Kind::kLogNormal, in.log_normal().median_ms(), in.log_normal().shape(), in.log_normal().cap_ms());
  }
  if (in.has_log_logistic()) {
    take(Kind::kLogLogistic, in.log_logistic().median_ms(), in.log_logistic().shape(), in.log_logistic().cap_ms());
  }
  if (in.has_exponential()) take(Kind::kExponential, in.exponential().mean_ms(), 1, in.exponential().cap_ms());
  if (in.has_gamma()) take(Kind::kGamma, in.gamma().scale_ms(), in.gamma().shape(), in.gamma().cap_ms());
  if (in.has_pareto()) {
    take(Kind::kPareto, in.pareto().least_ms(), in.pareto().alpha(), in.pareto().cap_ms());
    if (in.pareto().cap_ms() < in.pareto().least_ms())
      validator.error(child_path(key, "pareto.cap_ms"), "is below least_ms");
  }
  if (in.has_uniform()) fill(body, in.uniform(), validator, child_path(key, "uniform"));
  if (in.has_truncated_normal()) fill(body, in.truncated_normal(), validator, child_path(key, "truncated_normal"));
  if (in.has_hyper_exponential()) fill(body, in.hyper_exponential(), validator, child_path(key, "hyper_exponential"));
  if (in.has_empirical()) fill(body, in.empirical(), validator, child_path(key, "empirical"));
  body.tau = from_milliseconds(in.tau_ms());
  if (in.tau_ms() > 0 && in.tau_ms() < 0.01)
    validator.error(child_path(key, "tau_ms"), "must be 0 or at least 0.01 ms");
  return body;
}

BoundarySpec boundary_from(const pb::BoundaryProfile& in, MessageValidator& validator, const std::string& key) {
  const auto must = [&](bool kept, const char* name, const char* message) {
    if (!kept) validator.error(child_path(key, name), message);
  };
  must(in.phase_s() < in.period_s(), "phase_s", "must be below period_s");
  must(in.stall_low_ms() <= in.stall_high_ms(), "stall_low_ms", "is above stall_high_ms");
  must(in.stall_high_ms() < in.period_s() * 1e3, "stall_high_ms", "must be below period_s, or nothing ever leaves");
  must(in.loss_window_ms() <= in.period_s() * 1e3, "loss_window_ms", "is longer than period_s");
  must(in.loss_percent() == 0 || in.loss_window_ms() > 0, "loss_percent", "needs loss_window_ms");
  return {.period = from_milliseconds(in.period_s() * 1e3),
          .phase = from_milliseconds(in.phase_s() * 1e3),
          .stall_low = from_milliseconds(in.stall_low_ms()),
          .stall_high = from_milliseconds(in.stall_high_ms()),
          .floor_high = from_milliseconds(in.floor_high_ms()),
          .loss_window = from_milliseconds(in.loss_window_ms()),
          .loss = in.loss_percent() / 100};
}

}  // namespace

void delay_from(const pb::NetworkPath& in, PathSpec& path, MessageValidator& validator, const std::string& key) {
  if (in.has_body()) path.body = body_from(in.body(), validator, child_path(key, "body"));
  for (int i = 0; i < in.regime_size(); ++i) {
    const auto& regime = in.regime(i);
    path.regimes.push_back({from_milliseconds(regime.mean_ms()), from_milliseconds(regime.floor_ms())});
    if (regime.has_body())
      path.regimes.back().body = body_from(regime.body(), validator, child_path(key, "regime", i) + ".body");
  }
  if (in.regime_size() == 1) validator.error(child_path(key, "regime", 0), "one regime alone is body and floor_ms");
  if (in.has_boundary()) path.boundary = boundary_from(in.boundary(), validator, child_path(key, "boundary"));
  if (in.has_slots()) {
    path.slots = {from_milliseconds(in.slots().period_ms()), in.slots().datagrams(),
                  static_cast<std::uint64_t>(in.slots().bytes())};
    if (in.order() == pb::NetworkPath::FREE) {
      validator.error(child_path(key, "slots"), "keep the order: not with order: FREE");
    }
  }
}

}  // namespace tandem::netsim
