#pragma once

#include "common/base/time.h"

namespace tandem::server {

/// Whether a client behaves. What it sends under its own keys and cannot be meant (numbers out of range, wrong lengths, jumps no hand
/// can make) is a broken program or a hostile one: its spring acts on nothing from that tick on, until it has behaved for a while.
class Conduct {
 public:
  static constexpr Duration kBehaves = std::chrono::seconds(1);
  static constexpr Duration kBetweenComplaints = std::chrono::seconds(1);

  void offend(Time now) noexcept {
    last_ = now;
    offended_ = true;
  }
  [[nodiscard]] bool isolated(Time now) const noexcept { return offended_ && now - last_ < kBehaves; }

  /// He asked for what his role may not. @return whether this is worth an event: one a second is
  [[nodiscard]] bool forbidden(Time now) noexcept {
    if (complained_ && now - complaint_ < kBetweenComplaints) return false;
    complained_ = true;
    complaint_ = now;
    return true;
  }

 private:
  Time last_{}, complaint_{};
  bool offended_ = false, complained_ = false;
};

}  // namespace tandem::server
