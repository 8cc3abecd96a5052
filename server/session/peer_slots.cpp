#include "server/session/peer_slots.h"

#include <utility>

namespace tandem::server {

namespace {
constexpr Duration kSilenceMax = std::chrono::seconds(2);  // after this silence the slot is free and nothing is sent
constexpr unsigned kCloseRepeats = 20;                     // ticks, because single datagrams may be lost
}  // namespace

void PeerSlots::Peer::update(Time now) noexcept {
  if (stage == Stage::kConnected && connection->silence(now) > kSilenceMax)
    stage = closes_left > 0 ? Stage::kFree : Stage::kSilent;
}

JoinResult PeerSlots::admit(Time now, std::unique_ptr<transport::SecureChannel>& link, std::size_t& place,
                            bool every_tick) noexcept {
  if (session_end_->begun()) return JoinResult::kSessionOver;
  for (Peer& v : peers_) v.update(now);
  const auto least = std::ranges::min_element(peers_, {}, &Peer::stage);  // a silent peer keeps its slot if it can
  if (least->stage == Stage::kConnected) return JoinResult::kSeatTaken;
  std::unique_ptr<transport::SecureChannel> before = least->connection ? least->connection->release_link() : nullptr;
  least->connection.emplace(now, std::exchange(link, std::move(before)), tick_);
  least->stage = Stage::kConnected;
  any_ = true;
  least->every_tick = every_tick;
  any_every_tick_ |= every_tick;
  least->send_due = false;
  least->closes_left = 0;
  place = static_cast<std::size_t>(least - peers_.begin());
  return JoinResult::kAccepted;
}

std::size_t PeerSlots::places_free(Time now) const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(
      peers_, [&](const Peer& v) { return v.stage != Stage::kConnected || v.connection->silence(now) > kSilenceMax; }));
}

bool PeerSlots::remove(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (place >= peers_.size() || !peers_[place].holds(cid)) return false;
  Peer& v = peers_[place];
  if (v.stage == Stage::kSilent) {
    v.stage = Stage::kFree;
    return true;
  }
  removing_ = true;
  v.closes_left = kCloseRepeats;
  v.close_reason = why;
  return true;
}

bool PeerSlots::on_tick(Time now, bool turn_every_tick, bool turn) noexcept {
  any_ = any_every_tick_ = removing_ = false;
  bool answers = false;
  for (Peer& v : peers_) {
    v.update(now);
    if (v.stage != Stage::kConnected) continue;
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
    if (--peer.closes_left == 0) peer.stage = Stage::kFree;
    return peer.close_reason;
  }
  if (session_end_->sends_close()) return session_end_->reason();
  return std::nullopt;
}

}  // namespace tandem::server
