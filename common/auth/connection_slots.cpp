#include "common/auth/connection_slots.h"

#include <algorithm>
#include <tuple>

namespace tandem::auth {

void ConnectionSlots::enter(Id id, const KeyFingerprint& key, const Source& source, Time now) {
  entries_.insert_or_assign(id, Entry{key, source, now, now});
}

void ConnectionSlots::set_busy(Id id, bool busy, Time now) {
  const auto found = entries_.find(id);
  if (found == entries_.end()) return;
  found->second.busy = busy;
  found->second.heard = now;
}

void ConnectionSlots::set_joined(Id id, bool joined, Time now) {
  const auto found = entries_.find(id);
  if (found == entries_.end() || found->second.joined == joined) return;
  found->second.joined = joined;
  found->second.heard = now;
}

std::size_t ConnectionSlots::joined() const noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(entries_, [](const auto& entry) { return entry.second.joined; }));
}

std::optional<ConnectionSlots::Closed> ConnectionSlots::close_one(Time now) {
  struct Held {
    std::size_t all = 0, settled = 0;
  };
  std::map<KeyFingerprint, Held> keys;
  std::map<Source, Held> sources;
  std::size_t bare = 0;
  const auto settled = [&](const Entry& e) { return now - e.entered >= limits_.settle; };
  for (const auto& [id, e] : entries_) {
    if (e.joined) continue;
    ++bare;
    for (Held* held : {&keys[e.key], &sources[e.source]}) {
      ++held->all;
      if (settled(e)) ++held->settled;
    }
  }
  const bool full = entries_.size() > limits_.places && bare > Limits::reserved(limits_.places);
  // Idle connections are closed first, then those of the key and of the source furthest beyond their limit. If slots
  // are short, those of the source and key with most connections follow. Among equals the one unused for longest is
  // closed.
  auto chosen = entries_.end();
  Cause cause{};
  std::tuple<std::size_t, std::size_t, Duration> most{};
  const auto offer = [&](Entries::iterator i, Cause why, std::size_t first, std::size_t second) {
    const std::tuple weight{first, second, now - i->second.heard};
    if (chosen != entries_.end() && (cause < why || (cause == why && weight <= most))) return;
    std::tie(chosen, cause, most) = std::tuple{i, why, weight};
  };
  for (auto i = entries_.begin(); i != entries_.end(); ++i) {
    const Entry& e = i->second;
    if (e.joined || e.busy) continue;
    const Held &key = keys[e.key], &source = sources[e.source];
    if (now - e.heard >= limits_.idle) offer(i, Cause::kIdle, 0, 0);
    if (settled(e) && key.settled > limits_.per_key) offer(i, Cause::kPerKey, key.settled, 0);
    if (settled(e) && source.settled > limits_.per_source) offer(i, Cause::kPerSource, source.settled, key.settled);
    if (full) offer(i, Cause::kFull, source.all, key.all);
  }
  if (chosen == entries_.end()) return std::nullopt;
  const Closed closed{chosen->first, cause};
  entries_.erase(chosen);
  return closed;
}

}  // namespace tandem::auth
