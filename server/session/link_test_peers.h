#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "proto/wire/wire_codec.h"
#include "server/session/peer_slots.h"

namespace tandem::server {

/// Clients that test their link to this server (proto/wire/link_test_messages.h). Their data reaches no seat, tool or
/// report. The session sends one LINK_REPORT per tick to each of them, at its validated address.
class LinkTestPeers {
 public:
  static constexpr std::size_t kMax = 4;

  /// @param layout       of the scene's first seat
  /// @param session_end  close-out of the session; must outlive this
  LinkTestPeers(const wire::BodyLayout& layout, Duration tick, const CloseOut& session_end)
      : slots_(kMax, tick, session_end), codec_(layout) {}

  [[nodiscard]] PeerSlots& slots() noexcept { return slots_; }
  /// False if no peer is connected: no call has anything to do then.
  [[nodiscard]] bool any() const noexcept { return slots_.any(); }
  /// @return false if the header names no link-test peer
  /// @param header  of the datagram `bytes`
  bool on_datagram(Time now, const PeerAddress& from, const transport::Header& header, std::span<const std::byte> bytes,
                   PathTokens& tokens) noexcept TANDEM_REALTIME {
    return slots_.on_datagram(now, from, header, bytes, tokens, wire::Type::kLinkProbe,
                              [this](std::span<const std::byte> in) { return codec_.decode_link_probe(in); });
  }
  /// Removes silent peers, and marks a LINK_REPORT as due for the others.
  void on_tick(Time now) noexcept TANDEM_REALTIME { static_cast<void>(slots_.on_tick(now, true, true)); }
  /// Writes the next datagram; nullopt if none is due.
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::uint32_t tick,
                                                      std::span<std::byte> buffer) noexcept TANDEM_REALTIME {
    return slots_.poll_transmit(now, tick, buffer, [&](Connection& to) {
      const transport::SecureChannelStats& s = to.link().stats();
      const wire::LinkReport report{static_cast<std::uint32_t>(s.accepted), static_cast<std::uint32_t>(s.late)};
      return to.seal(now, tick, wire::Type::kLinkReport, report, codec_, buffer);
    });
  }

 private:
  PeerSlots slots_;
  wire::Codec codec_;
};

}  // namespace tandem::server
