#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/control/authority.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_messages.h"
#include "server/session/audit_trail.h"
#include "server/session/checkpoint.h"
#include "server/session/command_result.h"
#include "server/session/requester.h"
#include "server/session/seat_endpoint.h"
#include "server/session/session_clock.h"
#include "server/session/tool.h"

namespace tandem::server {

/// Changes of authority over the tools of a session: permission, schedule, execution, cancellation and the notice to
/// the seats (ARCHITECTURE.md, invariants 46 and 53).
///
/// A request is a compare-and-set: it names the version that it changes. An accepted change is announced to its parties
/// and takes effect `AuthorityTransfer::kNotice` ticks later. It is cancelled if a seat that gains authority has a
/// stale link then. The timeline of the scene schedules its changes the same way; they are deferred, not cancelled.
class AuthorityControl {
 public:
  /// Sets the initial authority of the scene, without notice.
  /// @param present  seats whose springs may act on tools
  /// All arguments must outlive this.
  AuthorityControl(const SceneSpec& scene, const SessionClock& clock, std::span<Tool> tools,
                   std::span<const SeatEndpoint> seats, const std::array<bool, kSeatsMax>& present,
                   AuditTrail& audit) noexcept;
  /// Sets authority and version of a checkpoint, without notice. Changes of the timeline that the checkpoint contains
  /// are skipped. @pre the clock is restored
  void restore(const Checkpoint& from) noexcept;
  /// Writes version and scheduled authority.
  void save(Checkpoint& to) const noexcept TANDEM_REALTIME;

  /// Schedules new authority over a tool. Instructors may set the authority of all seats. Roles with a partial right
  /// may only give up their own, to instructors; all other authorities must stay.
  /// @return kDone: scheduled; kOutdated, kForbidden, kInvalid or kStaleLink
  CommandResult request(Time now, const Requester& by, const wire::AuthorityMessage& wish) noexcept TANDEM_REALTIME;
  /// A change is scheduled, or the timeline has changes left: `step` is due.
  [[nodiscard]] bool any_change() const noexcept { return scheduled_ || next_event_ < scene_->timeline.size(); }
  /// Advances by one tick: announces the changes of the timeline and executes the changes that are due.
  /// @param clock_stopped  the timeline does not advance
  void step(Time now, bool clock_stopped) noexcept TANDEM_REALTIME;
  /// Fills the authority notice of the next FORCE to a seat: the last decision that affects it, until it is executed.
  void fill_notice(std::size_t seat, bool clock_stopped, wire::ForceMessage& message) noexcept TANDEM_REALTIME;

  /// Origin of the last pending change over a tool, as TransferParties::by. @pre a change is pending
  [[nodiscard]] std::uint32_t origin(std::size_t tool) const noexcept;
  /// Number of the newest decision, which `AuthorityTransfer::scheduled` of all tools stands for.
  [[nodiscard]] std::uint32_t version() const noexcept { return version_; }

 private:
  enum class Stage : std::uint8_t { kScheduling, kExecution };

  void set_initial(std::size_t tool, const control::MasterArray& wanted) noexcept;
  [[nodiscard]] bool permitted(const Requester& by, const wire::AuthorityMessage& wish) const noexcept;
  /// @param by     as in AuditEvent::seat
  /// @param ahead  ticks until execution, at most AuthorityTransfer::kNotice
  /// @pre `wanted` can be normalised
  void schedule(Time now, std::uint8_t by, std::size_t tool, const control::MasterArray& wanted,
                std::uint32_t ahead) noexcept;
  void reject(Time now, std::uint8_t by, std::size_t tool, const control::MasterArray& wanted,
              std::size_t party) noexcept;
  void schedule_timeline(Time now) noexcept TANDEM_REALTIME;
  void execute(Time now, std::size_t tool) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::optional<std::size_t> stale_party(Time now, std::size_t tool, const control::MasterArray& weights,
                                                       Stage stage) const noexcept;
  void show_cancelled(std::size_t seat) noexcept;
  [[nodiscard]] wire::TransferParties parties(std::size_t tool, std::size_t seat) const noexcept;
  void emit(Time now, AuditEvent::What what, std::uint8_t by, std::size_t tool, const control::MasterArray& before,
            const control::MasterArray& after, std::size_t party = AuditEvent::kNoSeat) noexcept;

  const SceneSpec* scene_;
  const SessionClock* clock_;
  std::span<Tool> tools_;
  std::span<const SeatEndpoint> seats_;
  const std::array<bool, kSeatsMax>* present_;
  AuditTrail* audit_;
  std::size_t masters_;
  std::uint32_t version_ = 1;
  bool scheduled_ = false;                                  ///< a tool may have a scheduled change
  std::size_t next_event_ = 0;                              ///< next event of the timeline
  std::array<std::uint32_t, kSeatsMax> cancelled_ticks_{};  ///< for which FORCE still reports a cancellation
  std::optional<Time> rejected_at_;                         ///< last audit event of a rejected change
};

}  // namespace tandem::server
