#pragma once

#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "hal/core/device.h"
#include "proto/spec/scene_spec.h"
#include "server/session/checkpoint.h"

namespace tandem::server {

/// Slave devices that the server simulates, and the port scale for all devices.
struct LocalSlaves {
  /// One per tool; null for tools of a seat and for virtual tools.
  std::vector<std::unique_ptr<hal::SteppedDevice>> devices;
  AxisArray scale{};  ///< tip gain to port gain per axis, at the start pose of the first seat's device
};

/// Builds the simulated slaves of a scene. @return the slaves, or all errors (such as an unreachable pose)
/// @param from  checkpoint with their joint positions; null: the start poses of the scene
/// @pre incompatibility(*from, scene) is empty
[[nodiscard]] std::expected<LocalSlaves, std::vector<std::string>> make_local_slaves(const SceneSpec& scene, Time start,
                                                                                     const Checkpoint* from = nullptr);

}  // namespace tandem::server
