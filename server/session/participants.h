#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "proto/wire/wire_messages.h"
#include "server/session/audit_trail.h"
#include "server/session/close_out.h"
#include "server/session/seat_catalogue.h"
#include "server/session/seat_endpoint.h"
#include "server/session/seat_monitor.h"

namespace tandem::server {

/// Clients at the seats of a session: admission, presence and removal.
class Participants {
 public:
  static constexpr Duration kOwnerSilenceMax = std::chrono::seconds(2);  ///< then another client can take the seat

  /// All arguments must outlive this.
  Participants(std::span<SeatEndpoint> seats, const SessionClock& clock, AuditTrail& audit) noexcept
      : seats_(seats), clock_(&clock), audit_(&audit) {}

  /// Whether a client can take a seat now. A seat is available if it is free, or if its client has been silent for
  /// more than kOwnerSilenceMax, or if `same_owner` is true.
  /// @param same_owner  the request comes from the current owner of the seat
  /// @return kAccepted, kSeatTaken, kNoSuchSeat or kSessionOver
  [[nodiscard]] JoinResult may_admit(Time now, std::size_t seat, bool same_owner) const noexcept;
  /// Attaches a client to a seat if `may_admit` accepts it.
  /// @param entry  in: the client's connection; out: the previous contents of the seat, to be freed on another thread
  /// @return as `may_admit`
  [[nodiscard]] JoinResult admit(Time now, std::size_t seat, SeatConnection& entry, bool same_owner) noexcept;
  /// Removes a participant: the gate ramps out, the client receives CLOSE, then the seat is free.
  /// @return false if the seat is free or is closing already
  bool remove(std::size_t seat, wire::CloseReason why) noexcept;
  /// Frees a seat whose client ended the connection.
  void leave(Time now, std::size_t seat) noexcept { release(now, seat, AuditEvent::What::kLeave); }
  /// Ends the session for all clients: their gates ramp out, then they receive CLOSE.
  void end(wire::CloseReason why) noexcept;

  /// Updates `present` and the seats' monitors. To be called once per tick.
  void step(Time now) noexcept TANDEM_REALTIME;
  /// Advances the end of the session by one tick. @pre closing().session.begun()
  void step_end() noexcept { closing_.session.step(); }
  /// A removal may be in progress: `step_removals` is due.
  [[nodiscard]] bool any_removal() const noexcept { return any_removal_; }
  /// Advances removals by one tick, and frees the seats whose client has received CLOSE.
  void step_removals(Time now) noexcept TANDEM_REALTIME;
  /// Reports a request that the role forbids, at most once per second and seat.
  void reject_forbidden(Time now, std::size_t seat) noexcept;

  /// The seat's participant was removed and its close-out is in progress.
  [[nodiscard]] bool removing(std::size_t seat) const noexcept { return closing_.seats[seat].in_progress(); }
  [[nodiscard]] const CloseOuts& closing() const noexcept { return closing_; }
  /// Seats whose springs may act on tools, as of the last tick.
  [[nodiscard]] const std::array<bool, kSeatsMax>& present() const noexcept { return present_; }
  /// Seats that may be engaged once they are ready: they receive force, are not quarantined and not being removed, as
  /// of the last tick.
  [[nodiscard]] const std::array<bool, kSeatsMax>& admissible() const noexcept { return admissible_; }
  /// Seats that are ready (`SeatEndpoint::ready`), as of the last tick.
  [[nodiscard]] const std::array<bool, kSeatsMax>& ready() const noexcept { return ready_; }
  /// Seats whose client is alive, bit i for seat i.
  [[nodiscard]] std::uint32_t connected(Time now) const noexcept;

 private:
  void release(Time now, std::size_t seat, AuditEvent::What why) noexcept;

  std::span<SeatEndpoint> seats_;
  const SessionClock* clock_;
  AuditTrail* audit_;
  CloseOuts closing_;
  bool any_removal_ = false;
  std::array<bool, kSeatsMax> present_{}, ready_{}, admissible_{};
  std::array<SeatMonitor, kSeatsMax> monitors_{};
};

}  // namespace tandem::server
