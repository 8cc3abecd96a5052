#include "server/session/peer_slots.h"

#include <utility>

namespace tandem::server {

namespace {
constexpr Duration kSilenceMax = std::chrono::seconds(2);  // after this silence the slot is free and nothing is sent
constexpr unsigned kCloseRepeats = 20;                     // ticks, because single datagrams may be lost
}  // namespace

JoinResult PeerSlots::admit(Time now, std::unique_ptr<transport::SecureChannel>& link, std::size_t& place,
                            bool every_tick) noexcept {
  if (session_end_->begun()) return JoinResult::kSessionOver;
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    Peer& v = peers_[i];
    if (v.connected && v.connection->silence(now) <= kSilenceMax) continue;
    std::unique_ptr<transport::SecureChannel> before = v.connection ? v.connection->release_link() : nullptr;
    v.connection.emplace(now, std::exchange(link, std::move(before)), tick_);
    v.connected = any_ = true;
    v.every_tick = every_tick;
    any_every_tick_ |= every_tick;
    v.send_due = false;
    v.closes_left = 0;
    place = i;
    return JoinResult::kAccepted;
  }
  return JoinResult::kSeatTaken;
}

std::size_t PeerSlots::places_free(Time now) const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(
      peers_, [&](const Peer& v) { return !v.connected || v.connection->silence(now) > kSilenceMax; }));
}

bool PeerSlots::remove(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (place >= peers_.size() || !peers_[place].connected || peers_[place].connection->link().own_cid() != cid)
    return false;
  removing_ = true;
  peers_[place].closes_left = kCloseRepeats;
  peers_[place].close_reason = why;
  return true;
}

bool PeerSlots::on_tick(Time now, bool turn_every_tick, bool turn) noexcept {
  any_ = any_every_tick_ = removing_ = false;
  bool answers = false;
  for (Peer& v : peers_) {
    v.connected = v.connected && v.connection->silence(now) <= kSilenceMax;
    if (!v.connected) continue;
    any_ = true;
    any_every_tick_ |= v.every_tick;
    removing_ |= v.closes_left > 0;
    const bool closes = v.closes_left > 0 || session_end_->sends_close();
    if ((!(v.every_tick ? turn_every_tick : turn) && !closes) || !v.connection->proven_address()) continue;
    v.send_due = may_send_ = true;
    answers |= !closes;
  }
  return answers;
}

std::optional<wire::CloseReason> PeerSlots::close_reason(Peer& peer) const noexcept {
  if (peer.closes_left > 0) {
    peer.connected = --peer.closes_left > 0;
    return peer.close_reason;
  }
  if (session_end_->sends_close()) return session_end_->reason();
  return std::nullopt;
}

}  // namespace tandem::server
