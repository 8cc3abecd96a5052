#include "proto/text/profile_delay.h"

#include <cmath>

#include "proto/schema/profile.pb.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;
using Kind = ProfileBody::Kind;

void fill(ProfileBody& body, const pb::UniformDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kUniform;
  body.low_ms = in.low_ms();
  body.high_ms = in.high_ms();
  if (body.low_ms > body.high_ms) validator.error(child_path(key, "low_ms"), "is above high_ms");
}

void fill(ProfileBody& body, const pb::TruncatedNormalDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kTruncatedNormal;
  body.scale_ms = in.mean_ms();
  body.sd_ms = in.sd_ms();
  body.low_ms = in.low_ms();
  body.cap_ms = in.cap_ms();
  if (body.low_ms >= body.cap_ms) validator.error(child_path(key, "low_ms"), "is not below cap_ms");
  if (body.scale_ms < body.low_ms || body.scale_ms > body.cap_ms) {
    validator.error(child_path(key, "mean_ms"), "is not between low_ms and cap_ms");
  }
}

void fill(ProfileBody& body, const pb::HyperExponentialDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kHyperExponential;
  body.cap_ms = in.cap_ms();
  double sum = 0;
  for (const auto& phase : in.phase()) {
    body.phases.push_back({phase.weight(), phase.mean_ms()});
    sum += phase.weight();
  }
  if (!(std::abs(sum - 1) < 1e-6)) validator.error(key, "the weights of its phases must add up to 1");
}

void fill(ProfileBody& body, const pb::EmpiricalDelay& in, MessageValidator& validator, const std::string& key) {
  body.kind = Kind::kEmpirical;
  for (int i = 0; i < in.point_size(); ++i) {
    const std::string here = child_path(key, "point", i);
    body.points.push_back({in.point(i).percent(), in.point(i).delay_ms()});
    if (i == 0) continue;
    if (in.point(i).percent() <= in.point(i - 1).percent()) validator.error(here + ".percent", "does not ascend");
    if (in.point(i).delay_ms() < in.point(i - 1).delay_ms()) validator.error(here + ".delay_ms", "falls");
  }
  if (body.points.size() < 2 || body.points.front().percent != 0 || body.points.back().percent != 100) {
    validator.error(key, "needs points from percent 0 to percent 100");
  }
}

ProfileBody body_from(const pb::Body& in, MessageValidator& validator, const std::string& key) {
  ProfileBody body;
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
    body.scale_ms = scale_ms;
    body.shape = shape;
    body.cap_ms = cap_ms;
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
    if (body.cap_ms < body.scale_ms) validator.error(child_path(key, "pareto.cap_ms"), "is below least_ms");
  }
  if (in.has_uniform()) fill(body, in.uniform(), validator, child_path(key, "uniform"));
  if (in.has_truncated_normal()) fill(body, in.truncated_normal(), validator, child_path(key, "truncated_normal"));
  if (in.has_hyper_exponential()) fill(body, in.hyper_exponential(), validator, child_path(key, "hyper_exponential"));
  if (in.has_empirical()) fill(body, in.empirical(), validator, child_path(key, "empirical"));
  body.tau_ms = in.tau_ms();
  if (body.tau_ms > 0 && body.tau_ms < 0.01)
    validator.error(child_path(key, "tau_ms"), "must be 0 or at least 0.01 ms");
  return body;
}

ProfileBoundary boundary_from(const pb::BoundaryProfile& in, MessageValidator& validator, const std::string& key) {
  ProfileBoundary b{in.period_s(),      in.phase_s(),        in.stall_low_ms(), in.stall_high_ms(),
                    in.floor_high_ms(), in.loss_window_ms(), in.loss_percent()};
  const auto must = [&](bool kept, const char* name, const char* message) {
    if (!kept) validator.error(child_path(key, name), message);
  };
  must(b.phase_s < b.period_s, "phase_s", "must be below period_s");
  must(b.stall_low_ms <= b.stall_high_ms, "stall_low_ms", "is above stall_high_ms");
  must(b.stall_high_ms < b.period_s * 1e3, "stall_high_ms", "must be below period_s, or nothing ever leaves");
  must(b.loss_window_ms <= b.period_s * 1e3, "loss_window_ms", "is longer than period_s");
  must(b.loss_percent == 0 || b.loss_window_ms > 0, "loss_percent", "needs loss_window_ms");
  return b;
}

}  // namespace

void delay_from(const pb::NetworkPath& in, ProfilePath& path, MessageValidator& validator, const std::string& key) {
  if (in.has_body()) path.body = body_from(in.body(), validator, child_path(key, "body"));
  for (int i = 0; i < in.regime_size(); ++i) {
    const auto& regime = in.regime(i);
    ProfileRegime& out = path.regimes.emplace_back();
    out.mean_ms = regime.mean_ms();
    out.floor_ms = regime.floor_ms();
    if (regime.has_body()) out.body = body_from(regime.body(), validator, child_path(key, "regime", i) + ".body");
  }
  if (in.regime_size() == 1) validator.error(child_path(key, "regime", 0), "one regime alone is body and floor_ms");
  if (in.has_boundary()) path.boundary = boundary_from(in.boundary(), validator, child_path(key, "boundary"));
  if (in.has_slots()) {
    path.slots = {in.slots().period_ms(), in.slots().datagrams(), static_cast<std::uint64_t>(in.slots().bytes())};
    if (in.order() == pb::NetworkPath::FREE) {
      validator.error(child_path(key, "slots"), "keep the order: not with order: FREE");
    }
  }
}

}  // namespace tandem
