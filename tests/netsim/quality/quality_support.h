#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "netsim/quality/link_quality.h"
#include "tests/netsim/support.h"

/// Datagrams with known verdicts, for tests of quality monitors.
namespace tandem::netsim::test {

struct Sent {
  Time at;
  std::vector<Duration> delays = {};  ///< one, or one per copy; none: lost
};

struct Told {
  Time when;
  int kind;  ///< 0 sent (and lost), 1 arrived
  std::uint64_t index;
  Duration delay{};
};

/// Returns the events reported to a monitor, in order of time; at equal times sending first, then by number.
inline std::vector<Told> story(const std::vector<Sent>& all) {
  std::vector<Told> told;
  for (std::uint64_t i = 0; i < all.size(); ++i) {
    told.push_back({all[i].at, 0, i});
    for (const Duration delay : all[i].delays) told.push_back({all[i].at + delay, 1, i, delay});
  }
  std::stable_sort(told.begin(), told.end(),
                   [](const Told& a, const Told& b) { return std::pair{a.when, a.kind} < std::pair{b.when, b.kind}; });
  return told;
}

inline void tell(LinkQuality& quality, const Told& event, const std::vector<Sent>& all) {
  if (event.kind == 1) return quality.arrived(event.when - event.delay, event.when, event.index);
  quality.sent(event.when, event.index);
  if (all[event.index].delays.empty()) quality.lost(event.when, event.index);
}

inline LinkQuality judged(const std::vector<Sent>& all, Time from = Time{}) {
  LinkQuality quality{from};
  for (const Told& event : story(all)) tell(quality, event, all);
  return quality;
}

/// Returns `count` datagrams, one every millisecond from `begin`, all with the same delay.
inline std::vector<Sent> regular(std::size_t count, Duration delay, Time begin = Time{}) {
  std::vector<Sent> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back({begin + 1ms * static_cast<std::int64_t>(i), {delay}});
  return all;
}

}  // namespace tandem::netsim::test
