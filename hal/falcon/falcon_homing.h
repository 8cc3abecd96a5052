#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "hal/falcon/falcon_frame.h"

namespace tandem::hal {

/// Finding the origin: the host sets the homing bit in every frame, a person pulls the grip fully out and pushes it in, and
/// the device raises one flag per leg and restarts its counts. Decides the bit, follows the flags, and notices firmware
/// that was loaded badly: it answers, but its counts never change.
class FalconHoming {
 public:
  /// As long as a person may do nothing before silent encoders are taken for frozen ones. Once only: who went for a coffee
  /// is not to find the firmware loaded again and again.
  static constexpr Duration kFrozenAfter = std::chrono::seconds(30);

  enum class Verdict : std::uint8_t {
    kUnhomed,
    kJustHomed,  ///< counts have a new origin
    kHomed,
    kDropped,  ///< was homed, and is not any more
    kFrozen,   ///< the firmware is to be loaded again
  };

  /// After bring-up.
  void begin() noexcept {
    asked_ = homed_ = moved_ = watching_ = edge_ = false;
  }
  /// The bit of the next frame. Once asked for it stays on, homed or not; after flags dropped it goes off for one frame, so
  /// that a device that looks for its edge sees one.
  [[nodiscard]] bool bit(bool asked) noexcept {
    asked_ = asked_ || asked;
    if (edge_) return edge_ = false;
    return asked_;
  }
  /// The bit as it was last decided, for frames outside the exchange.
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
      // The new origin itself changes the counts: only what came before it counts as movement.
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
  bool suspected_ = false;  ///< outlives begin(): reloading did not help, or nobody was there
  Time since_{};
  std::array<std::int16_t, 3> first_{};
};

}  // namespace tandem::hal
