#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/control/esc_hub.h"
#include "common/control/hand_coupling.h"
#include "common/control/reengage_offset.h"
#include "proto/spec/scene_spec.h"
#include "server/session/leading_hands.h"
#include "server/session/seat_endpoint.h"
#include "server/session/tool.h"

namespace tandem::server {

/// The tools of a session and their couplings to its seats: connects the ends of the seats and the tools with the hub
/// of Energy Shared Control (`control::EscHub`), once per tick. The functions of a tick are called in the order of
/// their declaration (ARCHITECTURE.md, "Order within a tick"). All quantities are in the axes of the port, SI units.
class SharedControl {
 public:
  /// @param slaves  one per tool; null for a tool whose slave is a seat, and for a tool without a slave
  /// @param scale   tip gain to port gain at the working pose, per axis
  /// @param present  seats whose springs may act on tools
  SharedControl(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale,
                std::span<SeatEndpoint> seats, const std::array<bool, kSeatsMax>& present);

  [[nodiscard]] std::span<Tool> tools() noexcept { return tools_; }
  [[nodiscard]] std::span<const Tool> tools() const noexcept { return tools_; }
  [[nodiscard]] const control::EscHub& hub() const noexcept { return hub_; }
  /// Whether the slave of a tool is in contact, as far as its device reports contact.
  [[nodiscard]] bool touching(Time now, std::size_t tool) const noexcept TANDEM_REALTIME;
  /// Number of steps of all tools whose result was not finite.
  [[nodiscard]] std::uint64_t not_finite() const noexcept TANDEM_REALTIME;
  /// Places the virtual mass of a tool at `x`, at rest.
  void rest_tool(std::size_t tool, const AxisArray& x) noexcept;

  /// Steps the authority over all tools.
  /// @param released  no seat may have authority now: the session ends, or is stopped
  void step_authority(bool released) noexcept TANDEM_REALTIME;
  /// Moves the references of all seats.
  void move_references(Time now) noexcept TANDEM_REALTIME;
  /// Steps the tools under the springs of all seats. @param time  session clock [s]
  void step_tools(double time) noexcept TANDEM_REALTIME;
  /// Moves the targets of all seats. Writes them into the next FORCE of each, with energies, authority and surfaces.
  void step_targets(std::uint32_t tick, const LeadingHands& hands) noexcept TANDEM_REALTIME;

 private:
  /// The seat receives the other hands' motion instead of the tool's, for its own copies of the tools.
  [[nodiscard]] bool has_copies(std::size_t i) const noexcept { return replica_ && i < masters_; }
  [[nodiscard]] bool slave_present(std::size_t tool) const noexcept;
  void move_spring(Time now, std::size_t i) noexcept TANDEM_REALTIME;
  void move_predictions(Time now, std::size_t i) noexcept TANDEM_REALTIME;
  void step_offset(std::size_t i, bool engaged) noexcept TANDEM_REALTIME;
  void update_contacts(std::size_t tool, double time) noexcept TANDEM_REALTIME;
  [[nodiscard]] double slave_share(std::size_t i, std::size_t tool) const noexcept TANDEM_REALTIME;
  void grant_following(std::size_t i) noexcept TANDEM_REALTIME;
  void fill_hand_target(std::size_t i, std::size_t tool, const LeadingHands& hands,
                        wire::ToolForce& out) const noexcept TANDEM_REALTIME;
  void fill_tool_target(std::size_t i) noexcept TANDEM_REALTIME;
  void fill_coupled_target(std::size_t i, PortSample& out) noexcept TANDEM_REALTIME;
  [[nodiscard]] control::CoupledBody coupled_tool() const noexcept TANDEM_REALTIME;
  void fill_account(std::size_t i, std::size_t tool, double alpha, wire::ToolForce& out) const noexcept TANDEM_REALTIME;
  void observe_sources(std::size_t tool) noexcept TANDEM_REALTIME;
  void fill_contacts(SeatEndpoint& seat, std::uint32_t tick) const noexcept TANDEM_REALTIME;

  const SceneSpec* scene_;
  double dt_;
  std::span<SeatEndpoint> seats_;
  const std::array<bool, kSeatsMax>& present_;
  std::size_t masters_;
  bool replica_;
  AxisArray tip_gain_{};  ///< force at the tip per force at the port
  control::HandCoupling coupling_;
  control::HandCouplingParams coupling_params_;
  control::EscHub hub_;
  std::vector<Tool> tools_;
  std::array<control::ReengageOffset, kSeatsMax> offsets_;
  std::array<control::CoupledTarget, kMastersMax> coupled_targets_{};  ///< couplings other than ESC
  std::array<std::uint32_t, kSeatsMax> engaged_ticks_{};               ///< since the seat engaged
  std::array<double, kMastersMax> effort_max_{};                       ///< largest pull of a hand's motor [N]
  std::array<control::NearEnd, kToolsMax> near_ends_{};      ///< scratch space of `move_spring` and `move_predictions`
  control::EscHub::Efforts efforts_{};                       ///< scratch space of `step_tools`
  std::array<std::uint64_t, kToolsMax> slave_generation_{};  ///< newest STATE that the contact source received
};

}  // namespace tandem::server
