#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

/// Orderly end of a connection, counted in ticks: the gate ramps out for `kRampTime`, then CLOSE is sent in
/// `kRepeats` ticks, because single datagrams may be lost.
class CloseOut {
 public:
  static constexpr double kRampTime = 0.15;  ///< [s]
  static constexpr std::uint32_t kRepeats = 20;

  /// @param dt  tick [s]
  void begin(wire::CloseReason why, double dt) noexcept {
    begun_ = true;
    reason_ = why;
    ticks_left_ = static_cast<std::uint32_t>(std::lround(kRampTime / dt)) + kRepeats + 1;
  }
  /// Advances by one tick. @return true in the tick that ends the close-out
  bool step() noexcept {
    if (ticks_left_ == 0) return false;
    return --ticks_left_ == 0;
  }

  [[nodiscard]] bool begun() const noexcept { return begun_; }
  [[nodiscard]] bool over() const noexcept { return begun_ && ticks_left_ == 0; }
  [[nodiscard]] bool in_progress() const noexcept { return ticks_left_ > 0; }
  /// CLOSE is due; also after the end, until the owner frees the connection.
  [[nodiscard]] bool sends_close() const noexcept { return begun_ && ticks_left_ <= kRepeats; }
  [[nodiscard]] wire::CloseReason reason() const noexcept { return reason_; }

 private:
  bool begun_ = false;
  std::uint32_t ticks_left_ = 0;
  wire::CloseReason reason_ = wire::CloseReason::kDone;
};

/// Close-outs of a whole session and of single seats whose participants were removed.
struct CloseOuts {
  CloseOut session;
  std::array<CloseOut, kSeatsMax> seats{};

  /// The close-out whose CLOSE is due to a seat: the session's, else the seat's own; null if none is due.
  [[nodiscard]] const CloseOut* due(std::size_t seat) const noexcept {
    return session.sends_close() ? &session : seats[seat].sends_close() ? &seats[seat] : nullptr;
  }
};

}  // namespace tandem::server
