#pragma once

#include <array>
#include <memory>
#include <optional>

#include "common/control/authority.h"
#include "common/control/esc_hub.h"
#include "common/control/ipc.h"
#include "common/control/local_contacts.h"
#include "common/control/virtual_tool.h"
#include "hal/core/device.h"
#include "hal/core/port_map.h"
#include "proto/spec/scene_spec.h"
#include "server/session/authority_transfer.h"
#include "server/session/contact_source.h"

namespace tandem::server {

/// One shared tool: virtual mass, authority and slave. The slave is one of three: a simulated device
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
  void step(double dt, const control::EscHub::Efforts& seats, bool braked) noexcept TANDEM_REALTIME;
  /// Sets the source of surfaces beside the scene's own. Not real-time safe. @pre body() is not null
  void set_contact_source(std::unique_ptr<ContactSource> source) noexcept { source_ = std::move(source); }
  /// Asks the contact source for surfaces and applies them. Call it once per tick, before `step`.
  /// @param view  time and slave; the tool's own part is filled here
  void update_contacts(ToolView view) noexcept TANDEM_REALTIME;
  /// Share of the spring between this tool and a SLAVE seat's device that acts at the tool, in [0, 1].
  [[nodiscard]] double slave_share() const noexcept {
    return body_ && source_ != nullptr ? 1 - source_->confidence() : 1;
  }
  [[nodiscard]] bool has_contact_source() const noexcept { return source_ != nullptr; }
  /// Surfaces of this tick.
  [[nodiscard]] const LocalContactList& contacts() const noexcept { return contacts_; }
  /// Number of rejected surfaces: duplicates, invalid ones, values out of range, and friction
  /// that the numerics of the tool do not solve.
  [[nodiscard]] std::uint64_t contacts_refused() const noexcept { return contacts_refused_; }

  /// Advances the simulated slave by `dt`, with its command held.
  void advance_slave(Duration dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] const ToolSpec& spec() const noexcept { return *spec_; }
  /// The port of the virtual mass at the hub.
  [[nodiscard]] const control::ToolPort& port() const noexcept { return port_; }
  [[nodiscard]] const AxisArray& position() const noexcept { return port_.x; }
  [[nodiscard]] const AxisArray& velocity() const noexcept { return port_.v; }
  [[nodiscard]] double x(std::size_t axis) const noexcept { return port_.x[axis]; }
  [[nodiscard]] const hal::SteppedDevice* slave() const noexcept { return slave_.get(); }
  /// Virtual mass that meets surfaces itself. Null where a device simulated here meets the surfaces, and for a SLAVE
  /// seat's tool under laws other than `replica`.
  [[nodiscard]] const control::VirtualTool* body() const noexcept { return body_ ? &*body_ : nullptr; }
  /// Force commanded to the simulated slave at the tip [N]; zero without one.
  [[nodiscard]] hal::Vec3 slave_force_commanded() const noexcept;
  [[nodiscard]] std::uint64_t not_finite() const noexcept { return not_finite_; }

  control::ToolAuthority authority;
  AuthorityTransfer transfer;  ///< scheduled changes of `authority`

 private:
  void step_body(double dt, const control::EscHub::Efforts& seats, bool braked) noexcept;

  const ToolSpec* spec_;
  std::size_t dof_;
  hal::PortMap map_;
  AxisArray scale_{1, 1, 1, 1, 1, 1, 1};
  std::unique_ptr<hal::SteppedDevice> slave_;
  std::optional<control::VirtualTool> body_;
  std::unique_ptr<ContactSource> source_;
  LocalContactList contacts_;
  control::LocalContacts received_contacts_;
  std::uint64_t contacts_refused_ = 0;
  std::array<control::ToolIpc, kAxesMax> ipc_{};
  control::VirtualTool::Pulls pulls_{};  ///< scratch space of `step_body`: entries beyond the axes in use stay 0
  control::ToolPort port_;
  AxisArray slave_effort_{};  ///< commanded, port axes
  hal::Command command_{};
  std::uint64_t not_finite_ = 0;
};

}  // namespace tandem::server
