#pragma once

#include <array>
#include <memory>
#include <optional>

#include "common/control/authority.h"
#include "common/control/flow_sources.h"
#include "common/control/ipc.h"
#include "common/control/local_contacts.h"
#include "common/control/virtual_tool.h"
#include "hal/device.h"
#include "hal/port_map.h"
#include "proto/scene_spec.h"
#include "server/contact_source.h"
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
  /// Where surfaces come from beside the scene's own. Not below a tick. @pre body() is not null
  void set_contact_source(std::unique_ptr<ContactSource> source) noexcept { source_ = std::move(source); }
  /// Once per tick, before `step`: asks the source, and meets what it names. @param view  time and slave; the tool's own part is filled here
  void look_for_contacts(ToolView view) noexcept TANDEM_REALTIME;
  /// Share of the spring between this tool and a SLAVE seat's device that acts at the tool, and is felt [0, 1].
  [[nodiscard]] double slave_share() const noexcept { return body_ && source_ != nullptr ? 1 - source_->trust() : 1; }
  /// Where a SLAVE seat's device is to go on a spring of stiffness k: beyond the tool by what presses at its surfaces, so that the device
  /// presses as hard as hands feel.
  [[nodiscard]] double slave_goal(std::size_t axis, double k) const noexcept { return x(axis) - (body_ && k > 0 ? body_->surface_force()[axis] / k : 0); }
  [[nodiscard]] bool has_contact_source() const noexcept { return source_ != nullptr; }
  [[nodiscard]] const LocalContactList& contacts() const noexcept { return named_; }          ///< named in this tick
  [[nodiscard]] std::uint64_t contacts_refused() const noexcept { return contacts_refused_; } ///< named, but no surfaces or out of range

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
  [[nodiscard]] const control::VirtualTool* body() const noexcept { return body_ ? &*body_ : nullptr; }  ///< null where a device that is simulated here meets the surfaces, and where no law makes a SLAVE seat's tool meet them
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
