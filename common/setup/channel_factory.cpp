#include "common/setup/channel_factory.h"

#include <algorithm>

namespace tandem::setup {

namespace {
/// Damping of a SLAVE seat relative to the masters' damping. A slave has no hand that damps it. At 20 ms it bounces off
/// a wall with 0.84 m/s with the masters' damping, and with 0.24 m/s with twice that damping.
constexpr double kSlaveDamping = 2;
/// Converts the gains of a hand to its tool, x_tool = s x_hand. A hand with s > 1 is light, soft and weakly damped as
/// the tool sees it: its reference is damped by as much less. At the client, an approach is no faster for the hand than
/// without scale.
void scale_to_tool(double s, control::ChannelParams& p) noexcept {
  const double at_tool = 1 / (s * s);
  for (double* const gain : {&p.schedule.k, &p.schedule.k_min, &p.schedule.k_delay, &p.k_c, &p.impedance})
    *gain *= at_tool;
  p.kappa *= std::min(1.0, at_tool);
  if (p.side == control::Side::kClient) p.v_app *= std::min(1.0, s);
}

}  // namespace

std::string_view law_name(LawKind law) noexcept {
  switch (law) {
    case LawKind::kSetPosition:
      return "set_position";
    case LawKind::kRaw:
      return "raw";
    case LawKind::kReplica:
      return "replica";
    case LawKind::kTdpa:
      return "tdpa";
    case LawKind::kWave:
      return "wave";
    case LawKind::kPd:
      return "pd";
  }
  return "";
}

control::FlowSourceMode flow_source_mode(MfsMode mode) noexcept {
  switch (mode) {
    case MfsMode::kOpen:
      return control::FlowSourceMode::kOpen;
    case MfsMode::kTank:
      return control::FlowSourceMode::kTank;
    case MfsMode::kSeed:
      return control::FlowSourceMode::kSeed;
    case MfsMode::kSeedSigned:
      return control::FlowSourceMode::kSeedSigned;
  }
  return control::FlowSourceMode::kOpen;
}

static_assert(static_cast<int>(HandCouplingKind::kAveragePosition) ==
                  static_cast<int>(control::HandCoupling::kAveragePosition) &&
              control::kHandCouplings == static_cast<std::size_t>(HandCouplingKind::kAveragePosition) + 1);
control::HandCoupling hand_coupling(HandCouplingKind kind) noexcept { return static_cast<control::HandCoupling>(kind); }

static_assert(static_cast<int>(IntegratorKind::kExact) == static_cast<int>(control::Integrator::kExact) &&
              control::kIntegrators == static_cast<std::size_t>(IntegratorKind::kExact) + 1);
static_assert(static_cast<int>(PrecisionKind::kFloat) == static_cast<int>(control::Precision::kFloat));
static_assert(kSubstepsMax == control::kSubstepsMax);
control::Numerics numerics(const NumericsSpec& spec) noexcept {
  return {static_cast<control::Integrator>(spec.integrator), static_cast<control::Precision>(spec.precision),
          static_cast<std::uint8_t>(spec.substeps)};
}

control::ContactSet contacts(const EnvironmentSpec& environment) noexcept {
  control::ContactSet all;
  if (const auto& w = environment.wall) {
    control::Contact contact{.k = w->k, .b = w->b, .mu = w->mu};
    const double sign = w->from_below ? -1 : 1;
    contact.normal[static_cast<std::size_t>(w->axis)] = sign;
    contact.at = sign * w->at;
    all.add(contact);
  }
  if (const auto& t = environment.tissue) {
    control::Contact contact{.k = t->k, .k3 = t->k3, .b = t->b, .mu = t->mu};
    const double sign = t->from_below ? -1 : 1;
    contact.normal[static_cast<std::size_t>(t->axis)] = sign;
    contact.at = sign * t->at;
    all.add(contact);
  }
  return all;
}

std::unique_ptr<control::ChannelEnd> make_channel(const ChannelSpec& spec, control::Side side, std::size_t dof,
                                                  const AxisArray& scale, double force_max, double k_c, bool clamped,
                                                  std::optional<double> stiffness, double motion_scale) {
  control::ChannelParams p;
  if (clamped) p.effort_max = force_max / motion_scale;
  p.side = side;
  p.dof = dof;
  p.scale = scale;
  p.schedule.k = stiffness.value_or(spec.k);
  p.schedule.k_min = std::min(spec.k_min, p.schedule.k);
  p.schedule.k_delay = spec.k_delay;
  p.schedule.b_delay = stiffness ? kSlaveDamping * spec.b_delay : spec.b_delay;
  p.schedule.lead_max = spec.lead_max;
  p.effort_half = spec.effort_half;
  // Below F^2 / 2k the channel would dead-lock at its start: the first full force could not be paid.
  p.e0 = std::max(spec.e0, force_max * force_max / (2 * p.schedule.k_min));
  p.eta = spec.eta;
  p.margin_max = std::max(spec.margin_max, p.e0);
  p.v_app = spec.v_app;
  p.k_c = k_c;
  p.b_rel = spec.b_rel;
  p.impedance = spec.impedance;
  if (motion_scale != 1) scale_to_tool(motion_scale, p);
  // The force of law `tdpa` goes to the hand and its position to the tool. A SLAVE seat is the other way round.
  if (stiffness && spec.law == LawKind::kTdpa) return control::make_channel_end(law_name(LawKind::kSetPosition), p);
  if (spec.law != LawKind::kReplica) return control::make_channel_end(law_name(spec.law), p);
  // A slave is coupled to the tool by a spring with two ends. The initial energy of a hand does not depend on its
  // motors.
  if (stiffness) return control::make_channel_end(law_name(LawKind::kSetPosition), p);
  p.e0 = spec.e0;
  p.margin_max = spec.margin_max;
  return control::make_channel_end(law_name(spec.law), p);
}

}  // namespace tandem::setup
