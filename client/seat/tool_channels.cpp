#include "client/seat/tool_channels.h"

#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>

#include "common/setup/channel_factory.h"

namespace tandem::client {

ToolChannels::ToolChannels(const SeatSetup& setup)
    : weights_{setup.weight},
      ends_(make_ends(setup)),
      further_(setup.further.size()),
      further_next_(setup.further.size()),
      further_samples_(setup.further.size()),
      tools_(ends_.size()) {
  for (const CoupledTool& tool : setup.further) weights_.push_back(tool.weight);
  bind();
}

ToolChannels::Ends ToolChannels::make_ends(const SeatSetup& s) {
  Ends ends;
  for (std::size_t k = 0; k <= s.further.size(); ++k)
    ends.push_back(setup::make_channel(s.channel, control::Side::kClient, s.dof, s.axis_scale,
                                       s.gate.force_max * share_of_force(s.seat.role), s.coupling.k_c, !s.unsafe_gains,
                                       s.seat.kind == SeatKind::kSlave ? std::optional{s.k_s} : std::nullopt,
                                       s.seat.motion_scale));
  return ends;
}

void ToolChannels::bind() noexcept {
  for (std::size_t k = 0; k < tools_.size(); ++k) tools_[k] = {ends_[k].get(), k == 0 ? &force_ : &further_[k - 1]};
}

void ToolChannels::swap_ends(Ends& ends) noexcept {
  std::swap(ends_, ends);
  bind();
}

void ToolChannels::clear_received() noexcept {
  force_ = {};
  std::ranges::fill(further_, wire::ToolForce{});
  heard_ = false;
}

void ToolChannels::receive(const wire::ForceMessage& force) noexcept {
  force_ = force;
  std::ranges::copy(further_next_, further_.begin());
  heard_ = true;
}

void ToolChannels::predict(control::HeldSample& held, Duration silence) noexcept {
  const double step = held.advance(seconds(silence));
  const std::size_t axes = ends_[0]->dof();
  held.predict(force_.port, axes, step);
  for (wire::ToolForce& tool : further_) held.predict(tool.port, axes, step);
  if (held.order() == 0) return;
  for (std::size_t a = 0; a < force_.ghost.x.size(); ++a)
    force_.ghost.x[a] += force_.ghost.v[a] * static_cast<float>(step);
}

double ToolChannels::authority() const noexcept {
  return std::ranges::max(tools_ |
                          std::views::transform([](const Coupling::Tool& tool) { return tool.received->alpha; }));
}

void ToolChannels::fill(wire::Telemetry& out) const noexcept {
  out.e_out = ends_[0]->e_out();
  out.refused_j = weights_[0] * ends_[0]->refused();
  out.margin_min_j = ends_[0]->margin_min();
  for (std::size_t k = 1; k < ends_.size(); ++k) {
    out.refused_j += weights_[k] * ends_[k]->refused();
    out.margin_min_j = std::min(out.margin_min_j, ends_[k]->margin_min());
  }
}

}  // namespace tandem::client
