#include "server/app/process/local_slaves.h"

#include "hal/core/port_map.h"
#include "hal/sim/local_slaves.h"
#include "hal/sim/sim_device.h"

namespace tandem::server {

std::expected<LocalSlaves, std::vector<std::string>> make_local_slaves(const SceneSpec& scene, Time start,
                                                                       const Checkpoint* from) {
  LocalSlaves slaves;
  std::vector<std::string> mistakes;
  auto devices = hal::sim::make_local_slaves(
      scene, start, [&](std::size_t tool) { return from != nullptr ? &from->tools[tool].slave : nullptr; });
  if (devices)
    slaves.devices = std::move(*devices);
  else
    mistakes = std::move(devices.error());
  // Clients connect their devices later. The gains are scaled at the working pose of the scene, which is the first
  // seat's start pose.
  for (const SeatSpec& seat : scene.seats) {
    const auto device = hal::sim::SimDevice::make({seat.device, HandSpec{}, seat.environment, nullptr, start});
    if (!device) {
      mistakes.push_back("seat " + seat.name + ": " + device.error().message);
    } else if (&seat == &scene.seats.front()) {
      slaves.scale = hal::PortMap(scene.port, scene.dof, (*device)->caps().joints).scale((*device)->state());
    }
  }
  if (!mistakes.empty()) return std::unexpected(std::move(mistakes));
  return slaves;
}

}  // namespace tandem::server
