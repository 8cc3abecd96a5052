#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "proto/wire/wire_codec.h"
#include "server/session/close_out.h"
#include "server/session/connection.h"
#include "server/session/seat_catalogue.h"

namespace tandem::server {

/// Clients without a seat that exchange datagrams with a session, in a fixed number of slots: link-test peers and
/// watchers. Each sends one type of datagram, which keeps its slot, and gets one type in return, at its validated
/// address. Nothing that they send reaches a seat or a tool. A peer that was silent for too long gets nothing, and its
/// slot is free. Its next datagram connects it again, unless another peer has the slot by then.
class PeerSlots {
 public:
  /// @param count        number of slots
  /// @param tick         shortest interval between two datagrams of a peer
  /// @param session_end  close-out of the session; must outlive this
  PeerSlots(std::size_t count, Duration tick, const CloseOut& session_end)
      : peers_(count), tick_(tick), session_end_(&session_end) {}

  /// Admits a peer to a free slot.
  /// @param link        in: the peer's channel; out: the channel that the slot held before
  /// @param place       out: index of the slot
  /// @param every_tick  the peer may get a datagram at every tick
  /// @return kAccepted, kSeatTaken (all slots are in use) or kSessionOver
  [[nodiscard]] JoinResult admit(Time now, std::unique_ptr<transport::SecureChannel>& link, std::size_t& place,
                                 bool every_tick = true) noexcept;
  /// Number of free slots.
  [[nodiscard]] std::size_t places_free(Time now) const noexcept;
  /// False if no peer is connected: no call has anything to do then.
  [[nodiscard]] bool any() const noexcept { return any_; }
  /// A connected peer may get a datagram at every tick.
  [[nodiscard]] bool any_every_tick() const noexcept { return any_every_tick_; }
  /// Removes a peer: it receives CLOSE, then its slot is free. A silent one cannot connect again.
  /// @return false if the slot does not hold connection `cid`
  bool remove(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept;

  /// Takes a datagram. CLOSE frees the slot.
  /// @param header  of the datagram `bytes`
  /// @param asks    the type that these peers send
  /// @param decode  checks its plaintext, and returns a Received<Message> or an error
  /// @return false if the header names no peer
  template <class Decode>
  bool on_datagram(Time now, const PeerAddress& from, const transport::Header& header, std::span<const std::byte> bytes,
                   PathTokens& tokens, wire::Type asks, Decode&& decode) noexcept {
    const auto found = std::ranges::find_if(peers_, [&](const Peer& v) { return v.holds(header.cid); });
    if (found == peers_.end()) return false;
    may_send_ = true;  // a challenge
    Connection& connection = *found->connection;
    const auto opened = connection.open(now, from, header, bytes, codec_);
    if (!opened) return true;
    if (opened->type == asks) {
      const auto decoded = decode(opened->plaintext);
      if (!decoded) {
        connection.link().drop_body();
      } else if (opened->newer) {
        connection.on_accepted_message(now, from, *opened, decoded->preamble, tokens);
        found->stage = Stage::kConnected;
        any_ = true;
        any_every_tick_ |= found->every_tick;
      }
    } else if (opened->type == wire::Type::kClose && codec_.decode_close(opened->plaintext)) {
      found->stage = Stage::kFree;
    } else {
      connection.link().drop_body();
    }
    return true;
  }

  /// A peer gets CLOSE, at every tick.
  [[nodiscard]] bool closing() const noexcept { return removing_ || session_end_->sends_close(); }
  /// Frees the slots of peers that have been silent for more than 2 s, and marks the datagrams of this tick. A tick
  /// without a turn of any peer needs no call, unless `closing`.
  /// @param turn_every_tick  an answer is due to peers that may get one at every tick
  /// @param turn             an answer is due to the others
  /// @return whether an answer is due to a peer
  bool on_tick(Time now, bool turn_every_tick, bool turn) noexcept TANDEM_REALTIME;

  /// False: `poll_transmit` has nothing to send.
  [[nodiscard]] bool may_send() const noexcept { return may_send_; }
  /// Writes the next datagram, CLOSE at the end of the session; nullopt if none is due.
  /// @param answer  seals the answer to a peer with this connection
  template <class Answer>
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer,
                                                      Answer&& answer) noexcept {
    if (!may_send_) return std::nullopt;
    for (Peer& v : peers_) {
      if (v.stage != Stage::kConnected) continue;
      if (const auto challenge = v.connection->poll_challenge(now, tick, codec_, buffer)) return challenge;
      if (!v.send_due) continue;
      v.send_due = false;
      const std::optional<wire::CloseReason> closes = close_reason(v);
      const Transmit out =
          closes ? v.connection->seal(now, tick, wire::Type::kClose, wire::CloseMessage{*closes}, codec_, buffer)
                 : answer(*v.connection);
      if (out.size > 0) return out;
    }
    may_send_ = false;
    return std::nullopt;
  }

 private:
  enum class Stage : std::uint8_t {
    kFree,    ///< never held, or its peer has left or was removed
    kSilent,  ///< free too, but its peer may connect again
    kConnected,
  };
  struct Peer {
    std::optional<Connection> connection;  ///< kept after the peer has left, until another joins
    Stage stage = Stage::kFree;
    bool send_due = false, every_tick = true;
    unsigned closes_left = 0;  ///< CLOSE datagrams still to send to a removed peer
    wire::CloseReason close_reason = wire::CloseReason::kRemoved;

    [[nodiscard]] bool holds(std::uint32_t cid) const noexcept {
      return stage != Stage::kFree && connection->link().own_cid() == cid;
    }
    /// Changes to kSilent if the peer is silent. A peer that is being removed then leaves.
    void update(Time now) noexcept;
  };
  /// Why the datagram that is due is CLOSE; nullopt: it is an answer.
  [[nodiscard]] std::optional<wire::CloseReason> close_reason(Peer& peer) const noexcept;

  std::vector<Peer> peers_;
  bool any_ = false, any_every_tick_ = false;  ///< a peer is connected, or was at the last `on_tick`
  bool removing_ = false;                      ///< a removed peer may still get CLOSE
  bool may_send_ = false;                      ///< something may be due since `poll_transmit` found nothing
  wire::Codec codec_;                          ///< of PATH and CLOSE, whose layout is always the same
  Duration tick_;
  const CloseOut* session_end_;
};

}  // namespace tandem::server
