#include "server/session/seat_catalogue.h"

#include <algorithm>

#include "common/setup/channel_factory.h"
#include "common/setup/device_stiffness.h"

namespace tandem::server {

namespace {

std::vector<std::unique_ptr<control::ChannelEnd>> ends_of(const SeatSetup& s, const AxisArray& scale) {
  const bool slave = s.seat.kind == SeatKind::kSlave;
  const std::optional<double> k_s = slave ? std::optional{s.k_s} : std::nullopt;
  // Tools that this hand does not follow get an end too, because the hand may receive authority over them.
  const std::size_t tools = s.channel.law == LawKind::kReplica && !slave ? std::max<std::size_t>(1, s.tools.size()) : 1;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends;
  for (std::size_t j = 0; j < tools; ++j)
    ends.push_back(setup::make_channel(s.channel, control::Side::kServer, s.dof, scale,
                                       s.gate.force_max * share_of_force(s.seat.role), s.coupling.k_c, !s.unsafe_gains,
                                       k_s, s.seat.motion_scale));
  return ends;
}

}  // namespace

std::vector<std::unique_ptr<control::ChannelEnd>> make_channel_ends(const SceneSpec& scene, std::size_t seat,
                                                                    const AxisArray& scale) {
  return ends_of(seat_setup(scene, seat), scale);
}

SeatCatalogue::SeatCatalogue(const SceneSpec& scene, const AxisArray& scale) : scene_(&scene), scale_(scale) {
  setups_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    setups_.push_back(seat_setup(scene, i));
    setups_.back().axis_scale = scale;
  }
}

std::optional<std::size_t> SeatCatalogue::seat_named(std::string_view name) const noexcept {
  const auto found = std::ranges::find_if(scene_->seats, [&](const SeatSpec& s) { return s.name == name; });
  return found == scene_->seats.end() ? std::nullopt
                                      : std::optional{static_cast<std::size_t>(found - scene_->seats.begin())};
}

std::string SeatCatalogue::seat_names() const {
  std::string text;
  for (const SeatSpec& s : scene_->seats) text += (text.empty() ? "" : " ") + s.name;
  return text;
}

std::string SeatCatalogue::device_incompatibility(const tandem::rpc::DeviceFacts& device) const {
  const std::size_t needed = scene_->dof;
  if (scene_->port == PortSpace::kTip ? device.tip_axes < needed : device.joints < needed)
    return "the scene needs " + std::to_string(needed) + " axes, the device has " +
           std::to_string(scene_->port == PortSpace::kTip ? device.tip_axes : device.joints);
  if (!device.simulated && !scene_->gate.latch) return "gate.latch: false is for simulated devices only";
  if (!device.simulated && scene_->gate.loop_age_max > 0.3)
    return "gate.loop_age_max_ms above 300 is for simulated devices only; use a scene with at most 300";
  return {};
}

SeatSetup SeatCatalogue::setup_for(std::size_t seat, const tandem::rpc::DeviceFacts& device) const {
  return setup::with_limited_stiffness(setups_[seat],
                                       setup::with_declared_properties(device, setups_[seat].seat.device));
}

std::string SeatCatalogue::softened_spring_text(std::size_t seat, const tandem::rpc::DeviceFacts& device) const {
  return setup::softened_text(setup_for(seat, device),
                              setup::with_declared_properties(device, setups_[seat].seat.device));
}

SeatConnection SeatCatalogue::make_connection(std::size_t seat, transport::SecureChannel::Params link,
                                              const tandem::rpc::DeviceFacts& device) const {
  link.outgoing = transport::Direction::kToClient;
  link.tick = tick();
  return {std::make_unique<transport::SecureChannel>(link), ends_of(setup_for(seat, device), scale_), {}, 1, device};
}

}  // namespace tandem::server
