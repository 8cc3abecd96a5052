#include "hal/sim/local_slaves.h"

#include <utility>

#include "hal/sim/sim_device.h"

namespace tandem::hal::sim {

std::expected<std::vector<std::unique_ptr<SteppedDevice>>, std::vector<std::string>> make_local_slaves(
    const SceneSpec& scene, Time start, const std::function<const AxisArray*(std::size_t tool)>& joints) {
  std::vector<std::unique_ptr<SteppedDevice>> slaves;
  std::vector<std::string> mistakes;
  for (const ToolSpec& tool : scene.tools) {
    slaves.emplace_back();
    if (tool.remote || tool.is_virtual) continue;
    SimSetup setup{tool.slave, HandSpec{}, tool.environment, nullptr, start};
    if (const AxisArray* const from = joints(slaves.size() - 1)) setup.joints = *from;
    auto device = SimDevice::make(setup);
    if (device)
      slaves.back() = std::move(*device);
    else
      mistakes.push_back("tool " + tool.name + ": " + device.error().message);
  }
  if (!mistakes.empty()) return std::unexpected(std::move(mistakes));
  return slaves;
}

}  // namespace tandem::hal::sim
