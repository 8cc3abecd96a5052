#include "server/reception.h"

#include <algorithm>

#include "common/setup/channel_setup.h"

namespace tandem::server {

std::unique_ptr<control::ChannelEnd> make_channel_end(const SceneSpec& scene, std::size_t seat, const AxisArray& scale) {
  const SeatSpec& s = scene.seats[seat];
  const std::optional<double> k_s = s.kind == SeatKind::kSlave ? std::optional{scene.tools[s.tool].k_s} : std::nullopt;
  return setup::make_channel(scene.channel, control::Side::kServer, scene.dof, scale, scene.gate.force_max * share_of_force(s.role), scene.coupling.k_c, !scene.unsafe_gains, k_s);
}

Reception::Reception(const SceneSpec& scene, const AxisArray& scale) : scene_(&scene), scale_(scale) {
  setups_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    setups_.push_back(seat_setup(scene, i));
    setups_.back().axis_scale = scale;
  }
}

std::optional<std::size_t> Reception::seat_named(std::string_view name) const noexcept {
  const auto found = std::ranges::find_if(scene_->seats, [&](const SeatSpec& s) { return s.name == name; });
  return found == scene_->seats.end() ? std::nullopt : std::optional{static_cast<std::size_t>(found - scene_->seats.begin())};
}

std::string Reception::seat_names() const {
  std::string text;
  for (const SeatSpec& s : scene_->seats) text += (text.empty() ? "" : " ") + s.name;
  return text;
}

std::string Reception::unfit(std::size_t seat, const tandem::control::DeviceFacts& device) const {
  const std::size_t needed = scene_->dof;
  if (scene_->port == PortSpace::kTip ? device.tip_axes < needed : device.joints < needed)
    return "the scene needs " + std::to_string(needed) + " axes, the device has " +
           std::to_string(scene_->port == PortSpace::kTip ? device.tip_axes : device.joints);
  if (!device.simulated && !scene_->gate.latch) return "gate.latch: false is for simulated devices only";
  if (!device.simulated && scene_->gate.loop_age_max > 0.3)
    return "gate.loop_age_max_ms above 300 is for simulated devices only; use a scene with at most 300";
  if (!scene_->unsafe_gains && device.damping_n_s_m > 0 && scene_->seats[seat].kind == SeatKind::kMaster) {
    const double limit = 2 * device.damping_n_s_m * scene_->tick_hz;
    if (scene_->coupling.k_c > limit * (1 + 1e-9))
      return "k_c is above the device's passivity limit 2 b/T = " + std::to_string(static_cast<int>(limit)) + " N/m";
  }
  return {};
}

Entry Reception::prepare(std::size_t seat, link::Link::Params link) const {
  link.outgoing = link::Direction::kToClient;
  link.tick = tick();
  return {std::make_unique<link::Link>(link), make_channel_end(*scene_, seat, scale_), {}, 1};
}

}  // namespace tandem::server
