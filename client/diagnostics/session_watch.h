#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "client/seat/client_channel.h"
#include "common/base/time.h"
#include "common/transport/secure_channel.h"
#include "proto/wire/telemetry_codec.h"

namespace tandem::client {

/// Client end of watching a session (proto/wire/session_telemetry.h): keeps the slot with WATCH, and holds the newest
/// TELEMETRY. The link of one seat and the authority over one tool come with each; it keeps the newest of all of them.
/// Sans-I/O; no heap after construction.
class SessionWatch {
 public:
  /// @param layout  numbers of the scene
  /// @param tick    of the scene
  SessionWatch(const wire::TelemetryLayout& layout, Duration tick, const transport::SecureChannel::Params& link);

  /// Handles one received datagram. @param arrived  arrival time on this machine's monotonic clock
  /// @return it is a TELEMETRY that is newer than all before
  bool on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept;
  /// Writes the next datagram that is due; call it at least every 100 ms, and after datagrams arrived.
  [[nodiscard]] std::optional<std::size_t> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;
  /// Ends the watch: sends CLOSE three times, so that the server frees the slot at once.
  void leave() noexcept;

  /// Newest TELEMETRY; nullopt: none arrived.
  [[nodiscard]] const std::optional<wire::SessionTelemetry>& newest() const noexcept { return newest_; }
  /// Newest link of each seat, and authority over each tool; unknown until their first turn.
  [[nodiscard]] const wire::WatchedLink& link_of(std::size_t seat) const noexcept { return links_[seat]; }
  [[nodiscard]] const wire::WatchedAuthority& authority_over(std::size_t tool) const noexcept {
    return authorities_[tool];
  }
  /// Reason for which the server ended the watch; nullopt: it did not.
  [[nodiscard]] std::optional<wire::CloseReason> closed() const noexcept { return closed_; }
  /// Time since the newest TELEMETRY, or since the first call of `poll_transmit` if none arrived.
  [[nodiscard]] Duration silence(Time now) const noexcept;
  /// Datagrams received, lost and dropped so far.
  [[nodiscard]] const transport::SecureChannelStats& statistics() const noexcept { return channel_.link().stats(); }

 private:
  wire::TelemetryCodec codec_;
  ClientChannel channel_;
  Duration tick_;
  std::optional<Time> began_, arrived_;
  Time next_watch_{};
  unsigned close_due_ = 0;
  std::optional<wire::SessionTelemetry> newest_;
  std::array<wire::WatchedLink, kSeatsMax> links_{};
  std::array<wire::WatchedAuthority, kToolsMax> authorities_{};
  std::optional<wire::CloseReason> closed_;
};

}  // namespace tandem::client
