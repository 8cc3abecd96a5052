#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "hal/drivers/falcon/falcon_frame.h"

namespace tandem::hal {

/// Homing of a Falcon: the host sets the homing bit in every frame, and the user pulls the grip fully out and pushes it
/// in.
/// The device then raises one flag per leg and restarts its counts.
/// This class decides the bit, tracks the flags and detects badly loaded firmware: it replies, but its counts never
/// change.
class FalconHoming {
 public:
  /// Time without a change of counts after which the encoders count as frozen; the user may be inactive that long.
  /// The verdict is given only once: the firmware must not be loaded repeatedly while the user is away.
  static constexpr Duration kFrozenAfter = std::chrono::seconds(30);

  enum class Verdict : std::uint8_t {
    kUnhomed,
    kJustHomed,  ///< counts have a new origin
    kHomed,
    kDropped,  ///< was homed, is no longer
    kFrozen,   ///< the firmware must be loaded again
  };

  /// Restarts homing, after bring-up.
  void begin() noexcept { asked_ = homed_ = moved_ = watching_ = edge_ = false; }
  /// Returns the homing bit of the next frame. Once requested it stays set, homed or not.
  /// After the flags dropped it is cleared for one frame, so that a device that reacts to an edge sees one.
  [[nodiscard]] bool bit(bool asked) noexcept {
    asked_ = asked_ || asked;
    if (edge_) return edge_ = false;
    return asked_;
  }
  /// Returns the last decided bit, for frames outside the exchange.
  [[nodiscard]] bool armed() const noexcept { return asked_; }
  [[nodiscard]] bool homed() const noexcept { return homed_; }

  [[nodiscard]] Verdict read(const FalconReply& reply, Time now) noexcept {
    const bool homed = reply.homed == kFalconAllHomed;
    const bool was = homed_;
    homed_ = homed;
    if (was && !homed) {
      watching_ = false;
      edge_ = asked_;
      return Verdict::kDropped;
    }
    if (was) return Verdict::kHomed;
    if (!asked_) return homed ? Verdict::kJustHomed : Verdict::kUnhomed;
    if (homed) {
      // The new origin itself changes the counts: only changes before it count as movement.
      if (watching_ && !moved_) {
        homed_ = false;
        return Verdict::kFrozen;
      }
      return Verdict::kJustHomed;
    }
    if (!watching_) {
      watching_ = true;
      moved_ = false;
      since_ = now;
      first_ = reply.encoder;
      return Verdict::kUnhomed;
    }
    if (reply.encoder != first_) {
      moved_ = true;
      suspected_ = false;
    }
    if (!moved_ && !suspected_ && now - since_ >= kFrozenAfter) {
      suspected_ = true;
      return Verdict::kFrozen;
    }
    return Verdict::kUnhomed;
  }

 private:
  bool asked_ = false, homed_ = false, edge_ = false;
  bool watching_ = false, moved_ = false;
  bool suspected_ = false;  ///< kept by begin(): reloading did not help, or the user was inactive
  Time since_{};
  std::array<std::int16_t, 3> first_{};
};

}  // namespace tandem::hal
