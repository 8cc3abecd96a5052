#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::server {

/// Something that people may ask about later: who changed what, and when. Plain data; an ordinary thread writes it down.
struct AuditEvent {
  enum class What : std::uint8_t {
    kJoin,           ///< `seat` was taken
    kLeave,          ///< its client said so
    kLoss,           ///< nothing was heard of it for too long, or it hears nothing; until kBack
    kBack,
    kIsolated,       ///< what it sent, under its own keys, can only be a mistake or malice: it is not engaged; until kReadmitted
    kReadmitted,
    kForbidden,      ///< it asked for what its role may not; at most one a second of each seat
    kAuthority,      ///< weights over `tool`, decided and announced: `before`, `after`, `version` is the new one
    kStop,           ///< of the session
    kPause,
    kResume,         ///< of the session; `version` is the number of the stop it ended
    kOwnStop,        ///< of one hand
    kOwnResume,
    kFault,          ///< the control step gave what is no number, twice within a second
    kInstructorAway, ///< an instructor is lost for 10 s; authority stays as it is
    kRestored,       ///< the session came back from a checkpoint; `version` is its epoch
    kGathered,       ///< after that: everybody needed is back, or (`seat`) an instructor goes on without
    kFlood,          ///< more datagrams than its rate allows, for more than 2 s; the excess is dropped
    kRemoved,        ///< its person was sent away, and the seat is free
    kPassive,        ///< the server does not keep its time: all hands are let go until kInTime
    kInTime,
    kAuthorityRefused,    ///< not `after`: the link of `party` is too old; at most one a second
    kAuthorityCalledOff,  ///< what was announced, `before`, is not carried out for that reason: `after` stays
    kAuthorityPutOff,     ///< a scene's change, `after`, waits for the link of `party`
  };
  /// Nobody's seat: the scene's timeline, the control plane, or the session itself.
  static constexpr std::uint8_t kNoSeat = 255, kTimeline = 254, kControlPlane = 253;

  What what = What::kJoin;
  std::uint8_t seat = kNoSeat;   ///< who
  std::uint8_t tool = 0, masters = 0;
  std::uint8_t party = kNoSeat;  ///< whose link
  std::uint32_t version = 0;
  std::uint32_t tick = 0;        ///< of the session
  Time at{};
  std::array<double, kMastersMax> before{}, after{};  ///< authority by master
};
static_assert(std::is_trivially_copyable_v<AuditEvent>);

/// For people and logs: `join`, ...
[[nodiscard]] constexpr const char* to_text(AuditEvent::What what) noexcept {
  constexpr const char* kNames[] = {"join",  "leave",  "loss",     "back",       "isolated", "readmitted", "forbidden", "authority", "stop",
                                    "pause", "resume", "own-stop", "own-resume", "fault",    "instructor-away", "restored", "gathered", "flood", "removed",
                                    "passive", "in-time", "authority-refused", "authority-called-off", "authority-put-off"};
  return what <= AuditEvent::What::kAuthorityPutOff ? kNames[static_cast<std::size_t>(what)] : "?";
}

/// Events that wait for whoever writes them. Full: the newest is dropped and counted, as what began a trouble tells more than its end.
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
