#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/base/time.h"

namespace tandem::client {

/// Tracks outages of the server from the point of view of one client. Pure: the caller passes the time.
class ServerWatch {
 public:
  /// @param now      start of the watch; the server counts as present then
  /// @param backoff  silence before the first reconnect
  ServerWatch(Time now, Duration backoff) noexcept
      : present_at_(now), checked_at_(now), connected_at_(now), backoff_(backoff) {}

  /// Takes one observation. A stall of this program is not a silence of the server.
  /// @param present  the server acknowledges datagrams of this client
  /// @return length of the outage that ends now [s]; nullopt: none ends
  std::optional<double> update(Time now, bool present) noexcept {
    if (now - checked_at_ > kStall) present_at_ += now - checked_at_;
    checked_at_ = now;
    present_ = present;
    if (!present) return std::nullopt;
    const double absent = absence(now);
    present_at_ = now;
    if (!in_outage_) return std::nullopt;
    in_outage_ = false;
    longest_s_ = std::max(longest_s_, absent);
    return absent;
  }
  /// Time since the server was last present [s].
  [[nodiscard]] double absence(Time now) const noexcept { return seconds(now - present_at_); }
  /// True if the client should reconnect now. A new connection gets time for its first FORCE.
  [[nodiscard]] bool reconnect_due(Time now) const noexcept {
    return !present_ && now - std::max(present_at_, connected_at_) >= backoff_;
  }
  /// Shortens the silence before the next reconnect, for a server that has announced its end.
  void hasten(Duration backoff) noexcept { backoff_ = std::min(backoff_, backoff); }
  /// The client starts to reconnect. @param backoff  silence before the next reconnect  @return true if an outage
  /// begins
  bool on_reconnect(Duration backoff) noexcept {
    backoff_ = backoff;
    const bool begins = !in_outage_;
    in_outage_ = true;
    return begins;
  }
  /// The servo thread is given a new connection.
  void on_connected(Time now) noexcept {
    connected_at_ = now;
    ++connections_;
  }
  /// Whether a status was made before the newest connection, and so says nothing about it.
  /// @param reconnects  of the status
  [[nodiscard]] bool outdated(std::uint32_t reconnects) const noexcept { return reconnects < connections_; }
  /// Longest outage, which may last still [s].
  [[nodiscard]] double longest_s() const noexcept {
    return in_outage_ ? std::max(longest_s_, absence(checked_at_)) : longest_s_;
  }

 private:
  static constexpr Duration kStall = std::chrono::milliseconds(400);  ///< time between two updates that shows a stall

  Time present_at_, checked_at_, connected_at_;
  Duration backoff_;
  std::uint32_t connections_ = 0;  ///< after the first
  bool present_ = true, in_outage_ = false;
  double longest_s_ = 0;
};

}  // namespace tandem::client
