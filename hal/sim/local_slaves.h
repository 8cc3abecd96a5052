#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/core/device.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// Simulated slaves of a scene's tools, which the server steps. One per tool; null for a tool whose slave is a seat,
/// and for a tool without a slave.
/// @param start   time of their first reading
/// @param joints  returns the joint positions at which the slave of a tool starts; null: the scene's
/// @return all mistakes: slaves that cannot be made
[[nodiscard]] std::expected<std::vector<std::unique_ptr<SteppedDevice>>, std::vector<std::string>> make_local_slaves(
    const SceneSpec& scene, Time start, const std::function<const AxisArray*(std::size_t tool)>& joints);

}  // namespace tandem::hal::sim
