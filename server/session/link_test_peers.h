#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "proto/wire/wire_codec.h"
#include "server/session/close_out.h"
#include "server/session/connection.h"
#include "server/session/seat_catalogue.h"

namespace tandem::server {

/// Clients that test their link to this server (proto/wire/link_test_messages.h). Their data reaches no seat, tool or
/// report. The session sends one LINK_REPORT per tick to each of them, at its validated address.
class LinkTestPeers {
 public:
  static constexpr std::size_t kMax = 4;

  /// @param layout       of the scene's first seat
  /// @param session_end  close-out of the session; must outlive this
  LinkTestPeers(const wire::BodyLayout& layout, Duration tick, const CloseOut& session_end)
      : codec_(layout), tick_(tick), session_end_(&session_end) {}

  /// Admits a peer to a free slot.
  /// @param link  in: the peer's channel; out: the channel that the slot held before
  /// @param place  out: index of the slot
  /// @return kAccepted, kSeatTaken (all slots are in use) or kSessionOver
  [[nodiscard]] JoinResult admit(Time now, std::unique_ptr<transport::SecureChannel>& link,
                                 std::size_t& place) noexcept;
  /// Number of free slots.
  [[nodiscard]] std::size_t places_free(Time now) const noexcept;
  /// False if no peer is connected: no call has anything to do then.
  [[nodiscard]] bool any() const noexcept { return any_; }
  /// Removes a peer: it receives CLOSE, then its slot is free. @return false if the slot does not hold connection
  /// `cid`
  bool remove(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept;
  /// @return false if the header names no link-test peer
  /// @param header  of the datagram `bytes`
  bool on_datagram(Time now, const PeerAddress& from, const transport::Header& header, std::span<const std::byte> bytes,
                   PathTokens& tokens) noexcept TANDEM_REALTIME;
  /// Removes peers that have been silent for more than 2 s, and marks a LINK_REPORT as due for the others.
  void on_tick(Time now) noexcept TANDEM_REALTIME;

  /// Writes the next datagram, CLOSE at the end of the session; nullopt if none is due.
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::uint32_t tick,
                                                      std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

 private:
  struct Peer {
    std::optional<Connection> connection;  ///< kept after the peer has left, until another joins
    bool connected = false, send_due = false;
    unsigned closes_left = 0;  ///< CLOSE datagrams still to send to a removed peer
    wire::CloseReason close_reason = wire::CloseReason::kRemoved;
  };
  std::array<Peer, kMax> peers_;
  bool any_ = false;  ///< a peer is connected, or was at the last tick
  wire::Codec codec_;
  Duration tick_;
  const CloseOut* session_end_;
};

}  // namespace tandem::server
