#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "netsim/system/authority_checker.h"
#include "netsim/system/authority_transfer_checker.h"
#include "netsim/system/channel_end_checker.h"
#include "netsim/system/delivery_checker.h"
#include "netsim/system/device_guard_checker.h"
#include "netsim/system/effort_checker.h"
#include "netsim/system/hand_energy_checker.h"
#include "netsim/system/restart_barrier_checker.h"
#include "netsim/system/silence_checker.h"

namespace tandem::netsim {

/// Checks in every tick the invariants of ARCHITECTURE.md that a Simulation can observe. They hold for every network,
/// every motion of the hands and every fault. Each is judged from outside, by numbers that the checked guard does not
/// compute, and has a checker of its own.
class InvariantChecker {
 public:
  explicit InvariantChecker(const SceneSpec& scene);

  /// Checks the state after a tick of the server and all clients.
  /// @param lived  ticks that the server ran in this simulation tick
  void check(std::uint32_t lived, const server::Session& session, const std::vector<SimulatedClient>& clients);
  /// Counts datagram number `index` of this seat, which the server received.
  void on_server_datagram(std::size_t seat, std::uint64_t index) noexcept {
    seats_[seat].delivery.on_server_datagram(index);
  }
  /// Checks an audit event of the session.
  void on_audit_event(const server::AuditEvent& event);
  /// Records that the server sent to an address that it had not validated.
  void on_reply_to_unknown_peer(double t) { violations_.add("mute", "", t, false); }
  /// Starts the recovery phase: no fault is active any more, and all hands are engaged. The checker then also judges
  /// invariants that hold only for ordinary motion.
  /// @return whether the motion of this scene is ordinary at all
  bool begin_recovery_phase() noexcept;
  /// Records that a core allocated memory within a tick: the core of a seat, or the server's.
  void note_heap_violation(std::size_t seat) { violations_.add("heap", scene_->seats[seat].name, t_, false); }
  void note_heap_violation() { violations_.add("heap", "", t_, false); }
  /// Marks violations of an invariant at a seat as expected. A seat with forged STATE, for example, reports an account
  /// that runs backwards.
  void expect(std::string_view invariant, std::string_view seat) { violations_.expect(invariant, seat); }

  [[nodiscard]] const server::Violations& violations() const noexcept { return violations_; }

 private:
  struct SeatCheckers {
    std::uint32_t starts = 0, joins = 0;  ///< of its client
    bool was_active = false;              ///< its gate, after the previous tick in which its client ran
    EffortChecker effort;
    SilenceChecker silence;
    DeviceGuardChecker guards;
    DeliveryChecker delivery;
    HandEnergyChecker hand;
    SeatEndsChecker ends;
  };
  void check_seat(std::uint32_t lived, ObservedSeat seat);

  const SceneSpec* scene_;
  double t_ = 0;                            ///< session time of the last check [s]
  std::optional<std::size_t> moving_seat_;  ///< recovery phase of ordinary motion: seat whose hand moves the tool
  std::vector<SeatCheckers> seats_;
  AuthorityChecker authority_;
  AuthorityTransferChecker transfers_;
  RestartBarrierChecker restart_barrier_;
  AxisArray scale_{1, 1, 1, 1, 1, 1, 1};  ///< tip gain to port gain, as the seats received it
  server::Violations violations_;
};

}  // namespace tandem::netsim
