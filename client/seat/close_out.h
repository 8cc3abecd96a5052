#pragma once

#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// End of a seat's connection. Either the server closes it, or the seat leaves: its force ramps to zero, then it sends
/// three CLOSE datagrams, because one may be lost.
class CloseOut {
 public:
  static constexpr unsigned kCloses = 3;

  void leave() noexcept { leaving_ = true; }
  [[nodiscard]] bool leaving() const noexcept { return leaving_; }
  /// True once either end has closed the connection, for `reason`.
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  [[nodiscard]] wire::CloseReason reason() const noexcept { return reason_; }

  /// The server closed the connection.
  void on_close(wire::CloseReason reason) noexcept {
    closed_ = true;
    reason_ = reason;
  }
  /// A new connection replaced this one. A seat that is leaving stays closed.
  void on_reconnect() noexcept { closed_ = closed_ && leaving_; }
  /// The gate gives no force. A leaving seat sends CLOSE from now on.
  void on_released() noexcept {
    if (leaving_ && due_ == 0 && !closed_) due_ = kCloses;
  }
  /// Returns whether the seat must send a CLOSE now. The last one closes the connection.
  [[nodiscard]] bool take_close() noexcept {
    if (due_ == 0) return false;
    if (--due_ == 0) on_close(wire::CloseReason::kLeaving);
    return true;
  }

 private:
  bool leaving_ = false, closed_ = false;
  unsigned due_ = 0;  ///< CLOSE datagrams still to be sent
  wire::CloseReason reason_ = wire::CloseReason::kDone;
};

}  // namespace tandem::client
