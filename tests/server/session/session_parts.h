#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hal/sim/sim_device.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/session/audit_trail.h"
#include "server/session/seat_endpoint.h"
#include "server/session/session_clock.h"
#include "server/session/tool.h"

namespace tandem::server::test {

/// The base of a session's parts, without clients: a shipped scene with its seats, tools, clock and audit trail.
struct SessionParts {
  /// @param change  modifies the scene
  explicit SessionParts(const std::string& scene_name, void (*change)(SceneSpec&) = nullptr)
      : scene(*parse_scene(find_shipped_scene(scene_name)->text, scene_name + ".textproto")) {
    if (change != nullptr) change(scene);
    AxisArray scale;
    scale.fill(1);
    seats.reserve(scene.seats.size());
    for (std::size_t i = 0; i < scene.seats.size(); ++i) seats.emplace_back(scene, i, scale);
    tools.reserve(scene.tools.size());
    for (std::size_t j = 0; j < scene.tools.size(); ++j) {
      const ToolSpec& tool = scene.tools[j];
      tools.emplace_back(scene, j,
                         std::move(*hal::sim::SimDevice::make({tool.slave, {}, tool.environment, nullptr, Time{}})));
    }
  }
  /// Steps the authority of all tools once, with these seats present and engaged.
  void step_authority() {
    for (Tool& tool : tools) {
      control::ToolAuthority::Input in;
      in.dt = clock.dt();
      for (std::size_t i = 0; i < in.present.size(); ++i) in.present[i] = present[i];
      tool.authority.step(in);
    }
  }
  /// All events so far.
  std::vector<AuditEvent> events() {
    std::vector<AuditEvent> out;
    while (const auto e = audit.poll()) out.push_back(*e);
    return out;
  }

  SceneSpec scene;
  std::vector<SeatEndpoint> seats;
  std::vector<Tool> tools;
  std::array<bool, kSeatsMax> present{};
  SessionClock clock{scene.tick_hz};
  AuditTrail audit{clock};
};

}  // namespace tandem::server::test
