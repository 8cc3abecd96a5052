#pragma once

#include <array>
#include <memory>
#include <optional>

#include "common/control/authority.h"
#include "common/control/flow_sources.h"
#include "common/control/ipc.h"
#include "common/control/local_contacts.h"
#include "common/control/virtual_tool.h"
#include "hal/core/device.h"
#include "hal/core/port_map.h"
#include "proto/spec/scene_spec.h"
#include "server/session/authority_transfer.h"
#include "server/session/contact_source.h"

namespace tandem::server {

/// One shared tool: virtual mass, authority, flow sources and slave. The slave is one of three: a simulated device
/// that is stepped here; a seat, then `slave` is null and its spring comes from outside; or none, then the virtual
/// mass meets its surfaces itself (`body`).
class Tool {
 public:
  Tool(const SceneSpec& scene, std::size_t index, std::unique_ptr<hal::SteppedDevice> slave);

  /// Places the virtual mass at `x`, at rest. Port axes, [m] or [rad].
  void rest_at(const AxisArray& x) noexcept;
  /// Steps the virtual mass under the springs of the slave and the seats, then commands the slave.
  /// @param dt      tick [s]
  /// @param braked  HELD: no authorised seat is present, so the tool is braked
  void step(double dt, const std::array<control::Pull, kAxesMax>& seats, bool braked) noexcept TANDEM_REALTIME;
  /// Sets the source of surfaces beside the scene's own. Not real-time safe. @pre body() is not null
  void set_contact_source(std::unique_ptr<ContactSource> source) noexcept { source_ = std::move(source); }
  /// Asks the contact source for surfaces and applies them. Call it once per tick, before `step`.
  /// @param view  time and slave; the tool's own part is filled here
  void update_contacts(ToolView view) noexcept TANDEM_REALTIME;
  /// Share of the spring between this tool and a SLAVE seat's device that acts at the tool, in [0, 1].
  [[nodiscard]] double slave_share() const noexcept {
    return body_ && source_ != nullptr ? 1 - source_->confidence() : 1;
  }
  /// Target of a SLAVE seat's device on a spring of stiffness k: beyond the tool by the surface force over k. So the
  /// device presses with the force that the hands feel.
  [[nodiscard]] double slave_goal(std::size_t axis, double k) const noexcept {
    return x(axis) - (body_ && k > 0 ? body_->surface_force()[axis] / k : 0);
  }
  [[nodiscard]] bool has_contact_source() const noexcept { return source_ != nullptr; }
  /// Surfaces of this tick.
  [[nodiscard]] const LocalContactList& contacts() const noexcept { return named_; }
  /// Number of rejected surfaces: duplicates, invalid ones and values out of range.
  [[nodiscard]] std::uint64_t contacts_refused() const noexcept { return contacts_refused_; }

  /// Advances the simulated slave by `dt`, with its command held.
  void advance_slave(Duration dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] const ToolSpec& spec() const noexcept { return *spec_; }
  [[nodiscard]] AxisArray position() const noexcept;
  [[nodiscard]] AxisArray velocity() const noexcept;
  [[nodiscard]] double x(std::size_t axis) const noexcept { return body_ ? body_->x(axis) : ipc_[axis].x; }
  [[nodiscard]] double v(std::size_t axis) const noexcept { return body_ ? body_->v(axis) : ipc_[axis].v; }
  /// Motion during the last step, port axes.
  [[nodiscard]] const AxisArray& moved() const noexcept { return moved_; }
  /// Energy dissipated during the last step, per axis [J].
  [[nodiscard]] const AxisArray& dissipated() const noexcept { return dissipated_; }
  [[nodiscard]] const hal::SteppedDevice* slave() const noexcept { return slave_.get(); }
  /// Virtual mass that meets surfaces itself. Null where a device simulated here meets the surfaces, and for a SLAVE
  /// seat's tool under laws other than `replica`.
  [[nodiscard]] const control::VirtualTool* body() const noexcept { return body_ ? &*body_ : nullptr; }
  /// Force commanded to the simulated slave at the tip [N]; zero without one.
  [[nodiscard]] hal::Vec3 slave_force_commanded() const noexcept;
  [[nodiscard]] std::uint64_t not_finite() const noexcept { return not_finite_; }

  control::ToolAuthority authority;
  AuthorityTransfer transfer;  ///< scheduled changes of `authority`
  control::FlowSources sources;

 private:
  const ToolSpec* spec_;
  std::size_t dof_;
  hal::PortMap map_;
  AxisArray scale_{1, 1, 1, 1, 1, 1, 1};
  std::unique_ptr<hal::SteppedDevice> slave_;
  void step_body(double dt, const std::array<control::Pull, kAxesMax>& seats, bool braked) noexcept;

  std::optional<control::VirtualTool> body_;
  std::unique_ptr<ContactSource> source_;
  LocalContactList named_;
  control::LocalContacts told_;
  std::uint64_t contacts_refused_ = 0;
  std::array<control::ToolIpc, kAxesMax> ipc_{};
  AxisArray moved_{}, dissipated_{}, slave_effort_{};  ///< slave_effort_: commanded, port axes
  hal::Command command_{};
  std::uint64_t not_finite_ = 0;
};

}  // namespace tandem::server
