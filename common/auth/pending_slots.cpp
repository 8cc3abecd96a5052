#include "common/auth/pending_slots.h"

#include <algorithm>
#include <tuple>

namespace tandem::auth {

template <class Key>
void PendingSlots::Served<Key>::serve(const Key& key, std::uint64_t serial) {
  serials_[key] = serial;
  if (serials_.size() <= kRemembered) return;
  serials_.erase(std::ranges::min_element(serials_, {}, [](const auto& entry) { return entry.second; }));
}

PendingSlots::Placed PendingSlots::arrive(const Origin& origin, bool returning, Time now) {
  const auto [network, new_network] = networks_.try_emplace(origin.network);
  const auto [address, new_address] = addresses_.try_emplace(origin);
  if (new_network) network->second.served = networks_served_.at(origin.network);
  if (new_address) address->second.served = addresses_served_.at(origin);
  ++network->second.held;
  ++address->second.held;
  const Id id = ++last_id_;
  entries_.emplace_hint(entries_.end(), id, Entry{now, Stage::kSilent, returning, network, address});
  silent_.insert(silent_.end(), id);
  if (returning) ++returning_;
  const std::size_t reserved = Limits::reserved(limits_.places);
  if (!returning && entries_.size() - returning_ > limits_.places - reserved)
    return {id, close_one(now, id, [](const Entry& e) { return !e.returning; })};
  if (entries_.size() <= limits_.places) return {id, std::nullopt};
  const bool all = returning_ > reserved;
  return {id, close_one(now, id, [all](const Entry& e) { return all || !e.returning; })};
}

void PendingSlots::first_byte(Id id) noexcept {
  const auto found = entries_.find(id);
  if (found == entries_.end() || found->second.stage != Stage::kSilent) return;
  found->second.stage = Stage::kWaiting;
  silent_.erase(id);
  ++waiting_;
}

PendingSlots::Entries::iterator PendingSlots::next_to_serve(bool returning_only) {
  auto best = entries_.end();
  std::tuple<std::uint64_t, std::uint64_t> least;
  for (auto i = entries_.begin(); i != entries_.end(); ++i) {
    const Entry& e = i->second;
    if (e.stage != Stage::kWaiting || (returning_only && !e.returning)) continue;
    const std::tuple served{e.network->second.served, e.address->second.served};
    if (best == entries_.end() || served < least) std::tie(best, least) = std::tuple{i, served};
  }
  return best;
}

std::optional<PendingSlots::Placed> PendingSlots::next_handshake(Time now) {
  if (waiting_ == 0 || handshakes_.wait(now) > Duration::zero()) return std::nullopt;
  auto next = returning_served_last_ ? entries_.end() : next_to_serve(true);
  returning_served_last_ = next != entries_.end();
  if (next == entries_.end()) next = next_to_serve(false);
  (void)handshakes_.take(now);
  Entry& entry = next->second;
  entry.network->second.served = entry.address->second.served = ++serial_;
  networks_served_.serve(entry.network->first, serial_);
  addresses_served_.serve(entry.address->first, serial_);
  entry.stage = Stage::kHandshake;
  --waiting_;
  ++in_handshake_;
  if (entry.returning) ++returning_in_handshake_;
  const std::size_t reserved = Limits::reserved(limits_.pending);
  if (!entry.returning && in_handshake_ - returning_in_handshake_ > limits_.pending - reserved)
    return Placed{next->first, close_one(now, next->first,
                                         [](const Entry& e) { return e.stage == Stage::kHandshake && !e.returning; })};
  if (in_handshake_ <= limits_.pending) return Placed{next->first, std::nullopt};
  const bool all = returning_in_handshake_ > reserved;
  return Placed{next->first, close_one(now, next->first, [all](const Entry& e) {
                  return e.stage == Stage::kHandshake && (all || !e.returning);
                })};
}

template <class Compete>
std::optional<PendingSlots::Id> PendingSlots::close_one(Time now, Id newcomer, const Compete& compete) {
  for (auto& [key, group] : networks_) group.members = group.silent = 0;
  for (auto& [key, group] : addresses_) group.members = group.silent = 0;
  for (const auto& [id, e] : entries_) {
    if (!compete(e)) continue;
    ++e.network->second.members;
    ++e.address->second.members;
    if (!silent_too_long(e, now)) continue;
    ++e.network->second.silent;
    ++e.address->second.silent;
  }
  // Compared from the left: silence first (unless it is all that its network holds), then the slots of network and
  // address. Among equals the first in the order of arrival, which is the oldest.
  auto worst = entries_.end();
  std::tuple<bool, std::size_t, std::size_t, bool> most;
  for (auto i = entries_.begin(); i != entries_.end(); ++i) {
    const Entry& e = i->second;
    if (i->first == newcomer || !compete(e)) continue;
    const Group &network = e.network->second, &address = e.address->second;
    const bool silent = silent_too_long(e, now), first = silent && network.members > 1;
    const std::tuple weight{first, first ? network.silent : network.members, first ? address.silent : address.members,
                            silent};
    if (worst == entries_.end() || weight > most) std::tie(worst, most) = std::tuple{i, weight};
  }
  if (worst == entries_.end()) return std::nullopt;
  const Id id = worst->first;
  erase(worst);
  return id;
}

std::optional<PendingSlots::Id> PendingSlots::evict(Time now) {
  const bool all = returning_ > Limits::reserved(limits_.places);
  return close_one(now, 0, [all](const Entry& e) { return all || !e.returning; });
}

void PendingSlots::leave(Id id) {
  if (const auto found = entries_.find(id); found != entries_.end()) erase(found);
}

void PendingSlots::erase(Entries::iterator entry) {
  Entry& e = entry->second;
  if (e.stage == Stage::kSilent) silent_.erase(entry->first);
  if (e.stage == Stage::kWaiting) --waiting_;
  if (e.stage == Stage::kHandshake) {
    --in_handshake_;
    if (e.returning) --returning_in_handshake_;
  }
  if (e.returning) --returning_;
  if (--e.network->second.held == 0) networks_.erase(e.network);
  if (--e.address->second.held == 0) addresses_.erase(e.address);
  entries_.erase(entry);
}

Time PendingSlots::due(const Entry& entry) const noexcept {
  const Duration first_byte =
      under_pressure() ? std::min(limits_.first_byte, limits_.first_byte_pressed) : limits_.first_byte;
  return entry.arrived + (entry.stage == Stage::kSilent ? std::min(first_byte, limits_.deadline) : limits_.deadline);
}

// All connections of a stage have the same limit, so the oldest is due first. The limit of the first byte is at most
// the deadline.
std::optional<PendingSlots::Id> PendingSlots::expire(Time now) {
  if (entries_.empty()) return std::nullopt;
  auto first = entries_.begin();
  if (now < due(first->second) && !silent_.empty()) first = entries_.find(*silent_.begin());
  if (now < due(first->second)) return std::nullopt;
  const Id id = first->first;
  erase(first);
  return id;
}

std::optional<Time> PendingSlots::next_event(Time now) {
  if (entries_.empty()) return std::nullopt;
  Time next = due(entries_.begin()->second);
  if (!silent_.empty()) next = std::min(next, due(entries_.find(*silent_.begin())->second));
  if (waiting_ > 0) next = std::min(next, now + handshakes_.wait(now));
  return next;
}

}  // namespace tandem::auth
