#pragma once

#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "hal/device.h"
#include "proto/scene_spec.h"
#include "server/checkpoint.h"

namespace tandem::server {

/// The devices that live in the server, and what the session must know of those that do not.
struct Slaves {
  std::vector<std::unique_ptr<hal::SteppedDevice>> devices;  ///< one per tool, null for tools served by a seat
  AxisArray scale{};  ///< tip gain to port gain per axis, at the start pose of the first seat's device
};

/// Builds simulated slaves as the scene describes them. @return them, or every mistake (a pose out of reach)
/// @param from  they stand where it says; null: where the scene says  @pre unfit(*from, scene) is empty
[[nodiscard]] std::expected<Slaves, std::vector<std::string>> make_slaves(const SceneSpec& scene, Time start, const Checkpoint* from = nullptr);

}  // namespace tandem::server
