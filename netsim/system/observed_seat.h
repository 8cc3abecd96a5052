#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>

#include "netsim/system/simulated_client.h"
#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Returns the norm of an effort at the tip [N].
/// @param effort  at the port, per axis
/// @param scale   tip gain to port gain, per axis
[[nodiscard]] inline double tip_norm(const AxisArray& effort, const AxisArray& scale, std::size_t dof) noexcept {
  double sum = 0;
  for (std::size_t a = 0; a < dof; ++a) sum += effort[a] * effort[a] / scale[a];
  return std::sqrt(sum);
}

/// One seat after a tick of server and client, as the invariant checkers see it. It also takes the violations that they
/// find there.
struct ObservedSeat {
  const SceneSpec& scene;
  std::size_t index;  ///< of the seat in the scene
  const SimulatedClient& client;
  const server::Session& session;
  server::Violations& violations;
  bool was_active = false;       ///< its gate was active after the previous tick of this program
  bool ordinary_motion = false;  ///< recovery phase: one hand moves the only tool, and nothing hinders it

  [[nodiscard]] const SeatSpec& spec() const noexcept { return scene.seats[index]; }
  [[nodiscard]] bool slave() const noexcept { return spec().kind == SeatKind::kSlave; }
  [[nodiscard]] bool master_of_law_replica() const noexcept {
    return scene.channel.law == LawKind::kReplica && spec().kind == SeatKind::kMaster;
  }
  /// Returns the share of force and tank that a participant of this role may receive: evaluators get half.
  [[nodiscard]] double force_share() const noexcept { return spec().role == Role::kEvaluator ? 0.5 : 1; }
  [[nodiscard]] double tick() const noexcept { return 1 / scene.tick_hz; }  ///< [s]

  /// Returns the server's end of the seat.
  [[nodiscard]] const server::SeatEndpoint& endpoint() const noexcept { return session.seat(index); }
  /// Returns the client's core; the client must be joined.
  [[nodiscard]] const client::Seat& core() const noexcept { return *client.seat(); }
  [[nodiscard]] double force() const noexcept {  ///< of the client's effort at the tip [N]
    return tip_norm(core().effort(), core().setup().axis_scale, scene.dof);
  }
  /// Returns whether a fault freezes or invalidates the readings of the device in this tick.
  [[nodiscard]] bool frozen() const noexcept { return client.faults().active(Fault::Kind::kFrozen, client.last_run()); }

  void violated(std::string_view invariant, bool expected = false) const {
    violations.add(invariant, spec().name, session.clock().time(), expected);
  }
};

}  // namespace tandem::netsim
