#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "server/session/audit_trail.h"
#include "server/session/checkpoint.h"
#include "server/session/participants.h"
#include "server/session/requester.h"
#include "server/session/start_condition.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// Stop, pause and resume of a session: the one path for requests by datagram, requests by control connection, and
/// faults that the session detects. StopLatch has the rules; this class also resumes a session that waits after a
/// restart, and emits the audit events.
class StopControl {
 public:
  /// All arguments must outlive this.
  StopControl(const SceneSpec& scene, const Participants& participants, StartCondition& start,
              AuditTrail& audit) noexcept
      : seats_(scene.seats.size()),
        participants_(&participants),
        start_(&start),
        audit_(&audit),
        latch_(scene.has_instructor()) {}
  /// Restores the stop of a checkpoint, and counts this restore. A session that waits for its seats raises the stop
  /// again when it resumes.
  /// @param saved_at  time of the checkpoint, by the clock of this server
  /// @pre the start condition is restored
  void restore(const Checkpoint& from, Time saved_at = {}) noexcept;
  /// Writes number, level and author of the stop that a restart restores.
  /// @param now  time of the checkpoint
  void save(Checkpoint& to, Time now = {}) const noexcept TANDEM_REALTIME;

  /// Stops all hands. A role that may only pause pauses them.
  /// @param wanted  highest level
  /// @return the level that was requested; nothing if the role may not stop
  std::optional<StopLatch::Level> request(Time now, const Requester& by,
                                          StopLatch::Level wanted = StopLatch::Level::kStopped,
                                          const StopLatch::Words& words = {}) noexcept;
  /// Ends the stop, or ends the waiting after a restart.
  /// @param number  number of the stop to end, see StopLatch::stops
  /// @return kDone also if the session resumed into the stop that was on before a restart
  CommandResult resume(Time now, const Requester& by, std::uint32_t number) noexcept;
  /// Resumes after a restart. Time continues from the checkpoint; a stop that was on then is raised again, under a new
  /// number. @param seat  origin of the audit event, @param number  its version
  void resume_after_restart(Time now, std::uint8_t seat, std::uint32_t number) noexcept;
  /// Stops the session because its control step is defective.
  void stop_for_fault(Time now) noexcept;

  /// Turns the level of a seat's request in STATE into edges. @return true at a rising edge
  [[nodiscard]] bool rising_edge(std::size_t seat, bool wish) noexcept { return latch_.rising_edge(seat, wish); }
  /// Another client has taken the seat.
  void clear_seat(std::size_t seat) noexcept { latch_.clear_seat(seat); }
  [[nodiscard]] const StopLatch& latch() const noexcept { return latch_; }
  /// Stops, pauses and resumes that were carried out so far, also those that changed nothing.
  [[nodiscard]] std::uint32_t orders() const noexcept { return orders_; }
  /// Restores of the session so far; nullopt: an older release has restored it, which did not count them.
  [[nodiscard]] const std::optional<RestoreCounts>& restores() const noexcept { return restores_; }

 private:
  std::size_t seats_;
  const Participants* participants_;
  StartCondition* start_;
  AuditTrail* audit_;
  StopLatch latch_;
  StopLatch::Latest before_;  ///< of the checkpoint, for the stop that is raised again
  std::optional<RestoreCounts> restores_ = RestoreCounts{};
  std::uint32_t orders_ = 0;
};

}  // namespace tandem::server
