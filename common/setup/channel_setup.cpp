#include "common/setup/channel_setup.h"

#include <algorithm>

namespace tandem::setup {

namespace {
/// A slave has no hand that damps it: at 20 ms and the masters' damping it bounces off a wall with 0.84 m/s, with twice with 0.24.
constexpr double kSlaveDamping = 2;
}  // namespace

std::string_view law_name(LawKind law) noexcept {
  switch (law) {
    case LawKind::kSetPosition: return "set_position";
    case LawKind::kRaw: return "raw";
  }
  return "";
}

control::FlowSourceMode flow_source_mode(MfsMode mode) noexcept {
  switch (mode) {
    case MfsMode::kOpen: return control::FlowSourceMode::kOpen;
    case MfsMode::kTank: return control::FlowSourceMode::kTank;
    case MfsMode::kSeed: return control::FlowSourceMode::kSeed;
    case MfsMode::kSeedSigned: return control::FlowSourceMode::kSeedSigned;
  }
  return control::FlowSourceMode::kOpen;
}

std::unique_ptr<control::ChannelEnd> make_channel(const ChannelSpec& spec, control::Side side, std::size_t dof,
                                                  const AxisArray& scale, double force_max, bool leashed, std::optional<double> stiffness) {
  control::ChannelParams p;
  if (leashed) p.effort_max = force_max;
  p.side = side;
  p.dof = dof;
  p.scale = scale;
  p.schedule.k = stiffness.value_or(spec.k);
  p.schedule.k_min = std::min(spec.k_min, p.schedule.k);
  p.schedule.k_delay = spec.k_delay;
  p.schedule.b_delay = stiffness ? kSlaveDamping * spec.b_delay : spec.b_delay;
  p.schedule.lead_max = spec.lead_max;
  p.effort_half = spec.effort_half;
  // Below F^2 / 2k the channel would dead-lock at its start: the first full force could not be paid (design notes, control 4).
  p.e0 = std::max(spec.e0, force_max * force_max / (2 * p.schedule.k_min));
  p.eta = spec.eta;
  p.margin_max = std::max(spec.margin_max, p.e0);
  p.v_app = spec.v_app;
  return control::make_channel_end(law_name(spec.law), p);
}

}  // namespace tandem::setup
