#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "common/base/time.h"

namespace tandem::client {

/// Decides when the reader of a steady stream of datagrams looks into its socket next. A reader that sleeps until just
/// after the next datagram is due needs no wake-up by the kernel. On the sender's computer the sender would pay for it.
///
/// The pace predicts arrivals: an early datagram moves the prediction at once, a late one by an eighth of its
/// lateness. Therefore, it stays near the earliest arrivals, and follows the drift of the sender's clock. While no
/// datagram comes, the reader waits for it in the socket.
class ReadPace {
 public:
  static constexpr Duration kGuard = std::chrono::microseconds(300);   ///< from the predicted arrival to the look
  static constexpr Duration kAgain = std::chrono::milliseconds(1);     ///< between looks for a datagram that is late
  static constexpr Duration kPatience = std::chrono::milliseconds(3);  ///< of such looks, after the first one

  struct Wait {
    Duration longest{};         ///< until the next look; at most that of the constructor
    bool for_datagram = false;  ///< an arriving datagram ends the wait
  };

  /// @param period   between two datagrams, above 0
  /// @param longest  time between two looks, above 0
  ReadPace(Duration period, Duration longest) noexcept : period_(period), longest_(longest) {}

  /// Enters an arrival. Of several since the last look, the newest suffices.
  /// @param arrived  as the kernel stamped it; the time of the look would be a prediction of itself
  void on_arrival(Time arrived) noexcept {
    if (predicted_) {
      const Duration gone = arrived - *predicted_;
      const Duration late = gone - (gone + period_ / 2) / period_ * period_;  // to the nearest predicted arrival
      arrived -= late > Duration::zero() ? late - late / kShare : Duration::zero();
    }
    predicted_ = arrived;
  }
  /// Forgets all arrivals, because the last one has no time.
  void restart() noexcept { predicted_.reset(); }

  /// Returns how the reader waits before its next look.
  [[nodiscard]] Wait wait(Time now) const noexcept {
    if (!predicted_) return {longest_, true};
    const Time due = *predicted_ + period_ + kGuard;
    if (now < due) return {std::min(due - now, longest_), false};
    if (now < due + kPatience) return {std::min(kAgain, longest_), false};
    return {longest_, true};
  }

 private:
  static constexpr Duration::rep kShare = 8;

  Duration period_, longest_;
  std::optional<Time> predicted_;  ///< arrival of the newest datagram, as predicted
};

}  // namespace tandem::client
