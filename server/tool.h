#pragma once

#include <array>
#include <memory>
#include <optional>

#include "common/control/authority.h"
#include "common/control/flow_sources.h"
#include "common/control/ipc.h"
#include "common/control/virtual_tool.h"
#include "hal/device.h"
#include "hal/port_map.h"
#include "proto/scene_spec.h"
#include "server/handover.h"

namespace tandem::server {

/// One shared tool: its virtual mass, who has authority over it, what its flow sources give, and the slave that touches the task.
/// The slave is stepped here (a simulated device), or is a seat of its own, then `slave` is null and the spring comes from outside; or
/// there is none, then the virtual mass meets its surfaces itself (`body`).
class Tool {
 public:
  Tool(const SceneSpec& scene, std::size_t index, std::unique_ptr<hal::SteppedDevice> slave);

  /// Puts the virtual mass where the slave is, at rest.
  void rest_at(const AxisArray& x) noexcept;
  /// Steps the virtual mass under the slave's and the seats' springs, then commands the slave. @param braked  HELD: nobody entitled is left.
  void step(double dt, const std::array<control::Pull, kAxesMax>& seats, bool braked) noexcept TANDEM_REALTIME;
  /// Lets the local slave live through the tick with its command held.
  void advance_slave(Duration dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] const ToolSpec& spec() const noexcept { return *spec_; }
  [[nodiscard]] AxisArray position() const noexcept;
  [[nodiscard]] AxisArray velocity() const noexcept;
  [[nodiscard]] double x(std::size_t axis) const noexcept { return body_ ? body_->x(axis) : ipc_[axis].x; }
  [[nodiscard]] double v(std::size_t axis) const noexcept { return body_ ? body_->v(axis) : ipc_[axis].v; }
  [[nodiscard]] const AxisArray& moved() const noexcept { return moved_; }          ///< during the last step
  [[nodiscard]] const AxisArray& dissipated() const noexcept { return dissipated_; }  ///< during the last step [J]
  [[nodiscard]] const hal::SteppedDevice* slave() const noexcept { return slave_.get(); }
  [[nodiscard]] const control::VirtualTool* body() const noexcept { return body_ ? &*body_ : nullptr; }  ///< null where a slave meets the surfaces
  [[nodiscard]] hal::Vec3 slave_force_commanded() const noexcept;                     ///< at the tip [N]
  [[nodiscard]] std::uint64_t not_finite() const noexcept { return not_finite_; }

  control::AuthorityRow authority;
  Handover handover;  ///< what becomes of it
  control::FlowSources sources;

 private:
  const ToolSpec* spec_;
  std::size_t dof_;
  hal::PortMap map_;
  AxisArray scale_{1, 1, 1, 1, 1, 1, 1};
  std::unique_ptr<hal::SteppedDevice> slave_;
  void step_body(double dt, const std::array<control::Pull, kAxesMax>& seats, bool braked) noexcept;

  std::optional<control::VirtualTool> body_;
  std::array<control::ToolIpc, kAxesMax> ipc_{};
  AxisArray moved_{}, dissipated_{}, slave_effort_{};  ///< slave_effort_: commanded, port axes
  hal::Command command_{};
  std::uint64_t not_finite_ = 0;
};

}  // namespace tandem::server
