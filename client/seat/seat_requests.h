#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "common/control/authority.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Requests of the user of one seat: local stop, stop or pause of the session, resume, new authority. Each request is
/// repeated until a FORCE shows its effect. The server decides on all of them but the local stop, and judges the role
/// again. Real-time safe.
class SeatRequests {
 public:
  explicit SeatRequests(const SeatSetup& setup) noexcept;

  /// Stops this seat: its force ramps to zero from the next tick on. The local stop lasts until `resume`.
  void stop_locally() noexcept { local_stop_ = true; }
  [[nodiscard]] bool locally_stopped() const noexcept { return local_stop_; }
  /// Requests a stop of the whole session, or a pause if the role may only pause. The request is repeated until the
  /// server counts a new stop.
  /// @return false for observers and for SLAVE seats
  bool stop_all() noexcept;
  /// Ends the local stop, and also the session's stop or pause if this seat may end it. The request names the newest
  /// stop received, so it does not end a later one.
  void resume() noexcept;
  /// Requests new authority over one tool. Sent every 20 ms until the server shows a newer version, at most for 1 s.
  /// Allowed for INSTRUCTOR and TRAINEE seats; the server grants a trainee only the return of own authority to
  /// instructors.
  /// @param tool   number of the tool
  /// @param alpha  authority of each master seat, in [0, 1], sum 1
  /// @return       false for other roles, or for more than `kMastersMax` values
  bool change_authority(std::uint32_t tool, std::span<const double> alpha) noexcept;
  /// The same for the tool that this seat follows. @param alpha  used up to the number of masters
  bool change_own_tool(const control::MasterArray& alpha) noexcept {
    return change_authority(own_tool_, std::span{alpha}.first(masters_));
  }

  /// Clears a latched gate and latched guards with the next tick.
  void reset_gate() noexcept { reset_gate_ = true; }
  /// Returns whether gate and guards are to be cleared now.
  [[nodiscard]] bool take_gate_reset() noexcept { return std::exchange(reset_gate_, false); }

  /// Drops the requests that a newer FORCE shows as settled.
  void on_force(const wire::ForceMessage& force) noexcept TANDEM_REALTIME;
  /// The next FORCE belongs to a new connection. Only stops and a reset of the gate persist.
  void on_reconnect() noexcept TANDEM_REALTIME;

  /// Writes the requests that STATE carries into `out`.
  void fill(wire::StateMessage& out) const noexcept TANDEM_REALTIME;
  /// Returns the AUTHORITY to send now, if one is due.
  [[nodiscard]] std::optional<wire::AuthorityMessage> take_authority(Time now) noexcept TANDEM_REALTIME;

 private:
  struct PendingAuthority {
    wire::AuthorityMessage message;
    bool follows = false;  ///< replaces a request that was sent against the same version
    std::optional<Time> sent = {};
    Time first_sent = {};
  };
  void clear_settled() noexcept;
  void renew_authority(const wire::ForceMessage& force) noexcept;

  bool may_stop_all_, ends_stops_, ends_pauses_, may_change_authority_;
  std::uint32_t own_tool_;
  std::size_t masters_;
  std::optional<std::uint32_t> own_number_;  ///< as `wire::TransferParties::by`; empty: SLAVE seat

  // As in the newest FORCE of this connection; zero before it.
  bool heard_ = false;
  wire::SessionState session_ = wire::SessionState::kWaiting;
  std::uint32_t stops_ = 0, authority_version_ = 0;

  bool local_stop_ = false, stop_all_ = false, reset_gate_ = false;
  std::optional<std::uint32_t> stops_at_request_;  ///< number of stops at the request; empty: no FORCE received since
  std::uint32_t resume_stop_ = 0;                  ///< number of the stop to end; 0: no request
  std::optional<PendingAuthority> authority_;
};

}  // namespace tandem::client
