#include "server/session/link_test_peers.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

namespace {
constexpr Duration kSilenceMax = std::chrono::seconds(2);  // after this silence the slot is free and nothing is sent
constexpr unsigned kCloseRepeats = 20;                     // ticks, because single datagrams may be lost
}  // namespace

JoinResult LinkTestPeers::admit(Time now, std::unique_ptr<transport::SecureChannel>& link,
                                std::size_t& place) noexcept {
  if (session_end_->begun()) return JoinResult::kSessionOver;
  for (std::size_t i = 0; i < kMax; ++i) {
    Peer& v = peers_[i];
    if (v.connected && v.connection->silence(now) <= kSilenceMax) continue;
    std::unique_ptr<transport::SecureChannel> before = v.connection ? v.connection->release_link() : nullptr;
    v.connection.emplace(now, std::exchange(link, std::move(before)), tick_);
    v.connected = any_ = true;
    v.send_due = false;
    v.closes_left = 0;
    place = i;
    return JoinResult::kAccepted;
  }
  return JoinResult::kSeatTaken;
}

std::size_t LinkTestPeers::places_free(Time now) const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(
      peers_, [&](const Peer& v) { return !v.connected || v.connection->silence(now) > kSilenceMax; }));
}

bool LinkTestPeers::remove(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (place >= kMax || !peers_[place].connected || peers_[place].connection->link().own_cid() != cid) return false;
  peers_[place].closes_left = kCloseRepeats;
  peers_[place].close_reason = why;
  return true;
}

bool LinkTestPeers::on_datagram(Time now, const PeerAddress& from, const transport::Header& header,
                                std::span<const std::byte> bytes, PathTokens& tokens) noexcept {
  const auto found = std::ranges::find_if(
      peers_, [&](const Peer& v) { return v.connected && v.connection->link().own_cid() == header.cid; });
  if (found == peers_.end()) return false;
  Connection& connection = *found->connection;
  const auto opened = connection.open(now, from, header, bytes, codec_);
  if (!opened) return true;
  if (opened->type == wire::Type::kLinkProbe) {
    const auto decoded = codec_.decode_link_probe(opened->plaintext);
    if (!decoded) {
      connection.link().drop_body();
    } else if (opened->newer) {
      connection.on_accepted_message(now, from, *opened, decoded->preamble, tokens);
    }
  } else if (opened->type == wire::Type::kClose && codec_.decode_close(opened->plaintext)) {
    found->connected = false;
  } else {
    connection.link().drop_body();
  }
  return true;
}

void LinkTestPeers::on_tick(Time now) noexcept {
  any_ = false;
  for (Peer& v : peers_) {
    v.connected = v.connected && v.connection->silence(now) <= kSilenceMax;
    v.send_due = v.connected && v.connection->proven_address();
    any_ |= v.connected;
  }
}

std::optional<Transmit> LinkTestPeers::poll_transmit(Time now, std::uint32_t tick,
                                                     std::span<std::byte> buffer) noexcept {
  for (Peer& v : peers_) {
    if (!v.connected) continue;
    if (const auto challenge = v.connection->poll_challenge(now, tick, codec_, buffer)) return challenge;
    if (!v.send_due) continue;
    v.send_due = false;
    if (v.closes_left > 0) {
      v.connected = --v.closes_left > 0;
      const Transmit last =
          v.connection->seal(now, tick, wire::Type::kClose, wire::CloseMessage{v.close_reason}, codec_, buffer);
      if (last.size > 0) return last;
      continue;
    }
    const transport::SecureChannelStats& s = v.connection->link().stats();
    const wire::LinkReport report{static_cast<std::uint32_t>(s.accepted), static_cast<std::uint32_t>(s.late)};
    const Transmit out = session_end_->sends_close()
                             ? v.connection->seal(now, tick, wire::Type::kClose,
                                                  wire::CloseMessage{session_end_->reason()}, codec_, buffer)
                             : v.connection->seal(now, tick, wire::Type::kLinkReport, report, codec_, buffer);
    if (out.size > 0) return out;
  }
  return std::nullopt;
}

}  // namespace tandem::server
