#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "common/base/axes.h"
#include "common/base/enumerator_count.h"
#include "common/base/time.h"

namespace tandem::server {

/// An auditable event: actor, change and time. Plain data; a thread without real-time duties writes the log.
struct AuditEvent {
  enum class What : std::uint8_t {
    kJoin,   ///< `seat` joined
    kLeave,  ///< its client ended the connection
    kLoss,   ///< its link is stale, in either direction; until kBack
    kBack,
    /// Its authenticated messages are invalid, by error or malice: it is not engaged; until kCleared.
    kQuarantined,
    kCleared,
    kForbidden,  ///< it requested an action that its role may not perform; at most one event per second and seat
    kAuthority,  ///< authority over `tool`, decided and announced: `before`, `after`; `version` is the new one
    kStop,       ///< of the session
    kPause,
    kResume,     ///< of the session; `version` is the number of the ended stop
    kLocalStop,  ///< of one seat
    kLocalResume,
    kFault,           ///< the control step produced a NaN or infinity twice within a second
    kInstructorAway,  ///< an instructor's link is lost for 10 s; authority does not change
    kRestored,        ///< the session was restored from a checkpoint; `version` is its epoch
    kAllBack,         ///< after kRestored: all required seats are back, or instructor `seat` resumed without them
    kFlood,           ///< more datagrams than the rate limit for more than 2 s; the excess is dropped
    kRemoved,         ///< its participant was removed; the seat is free
    kOverload,        ///< the server misses tick deadlines: all hands are disengaged until kOverloadCleared
    kOverloadCleared,
    kAuthorityRejected,   ///< `after` was rejected: the link of `party` is stale; at most one per second
    kAuthorityCancelled,  ///< the announced authority `before` is not applied for that reason; `after` stays
    kAuthorityDeferred,   ///< a change of the timeline, `after`, waits for the link of `party`
    kLeaseDoubtful,       ///< the server may not own the session any more: all hands are disengaged until kLeaseRenewed
    kLeaseRenewed,
  };
  /// Values of `seat` that are no seat: the session itself, the scene's timeline, and the control connection.
  static constexpr std::uint8_t kNoSeat = 255, kTimeline = 254, kControlPlane = 253;

  What what = What::kJoin;
  std::uint8_t seat = kNoSeat;  ///< origin of the event
  std::uint8_t tool = 0, masters = 0;
  std::uint8_t party = kNoSeat;  ///< seat with the stale link
  std::uint32_t version = 0;
  std::uint32_t tick = 0;   ///< of the session
  std::uint32_t order = 0;  ///< SessionCommand::order of the command that it follows from; 0: none
  Time at{};
  std::array<double, kMastersMax> before{}, after{};  ///< authority by master
};
static_assert(std::is_trivially_copyable_v<AuditEvent>);

/// Name in the audit log: `join`, ...
[[nodiscard]] constexpr const char* to_text(AuditEvent::What what) noexcept {
  constexpr std::array kNames{"join",
                              "leave",
                              "loss",
                              "back",
                              "quarantined",
                              "cleared",
                              "forbidden",
                              "authority",
                              "stop",
                              "pause",
                              "resume",
                              "local-stop",
                              "local-resume",
                              "fault",
                              "instructor-away",
                              "restored",
                              "all-back",
                              "flood",
                              "removed",
                              "overload",
                              "overload-cleared",
                              "authority-refused",
                              "authority-canceled",
                              "authority-deferred",
                              "lease-doubtful",
                              "lease-renewed"};
  static_assert(kNames.size() == enumerator_count<AuditEvent::What>());
  return static_cast<std::size_t>(what) < kNames.size() ? kNames[static_cast<std::size_t>(what)] : "?";
}

/// Queue of events for the thread that writes the log. If it is full, the newest event is dropped and counted, because
/// the first events of a problem are the most informative.
class AuditQueue {
 public:
  static constexpr std::size_t kCapacity = 256;
  void push(const AuditEvent& event) noexcept {
    if (count_ == kCapacity) {
      ++dropped_;
      return;
    }
    events_[(first_ + count_++) % kCapacity] = event;
  }
  [[nodiscard]] std::optional<AuditEvent> poll() noexcept {
    if (count_ == 0) return std::nullopt;
    const AuditEvent out = events_[first_];
    first_ = (first_ + 1) % kCapacity;
    --count_;
    return out;
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  std::array<AuditEvent, kCapacity> events_{};
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace tandem::server
