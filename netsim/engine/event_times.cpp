#include "netsim/engine/event_times.h"

#include <algorithm>
#include <array>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

std::string ms_text(Duration length) {
  return length < std::chrono::seconds(10) ? format("%g ms", seconds(length) * 1e3) : format("%g s", seconds(length));
}

std::string outage_words(const OutageSpec& outage) {
  constexpr std::array kModes{"", ", held", ", held but for the newest"};
  return "outage of " + ms_text(outage.length) + kModes[static_cast<std::size_t>(outage.mode)];
}

/// Returns the outages of a link with the text of their direction, which is empty for those of both.
std::vector<std::pair<OutageSpec, std::string>> outages_of(const LinkSpec& link) {
  std::vector<std::pair<OutageSpec, std::string>> all;
  const bool both = link.up.outages == link.down.outages;
  for (const OutageSpec& outage : link.up.outages) all.emplace_back(outage, both ? "" : ", up");
  if (both) return all;
  for (const OutageSpec& outage : link.down.outages) all.emplace_back(outage, ", down");
  return all;
}

bool has_one_moment(const OutageSpec& outage) noexcept {
  return outage.period == Duration::zero() && outage.mean_gap == Duration::zero();
}

}  // namespace

std::string event_text(const NetworkEvent& event) {
  std::string text = event.outage   ? outage_words(*event.outage)
                     : event.rebind ? "new address, the old one dead after " + ms_text(event.rebind->dead_after)
                     : event.network.empty() ? std::string("another network")
                                             : "network " + event.network;
  if (event.direction) text += std::string(", ") + name(*event.direction);
  for (std::size_t i = 0; i < event.clients.size(); ++i) {
    const bool number = std::ranges::all_of(event.clients[i], [](char c) { return c >= '0' && c <= '9'; });
    text += (i == 0 ? ", for " : " and ") + std::string(number ? "client " : "") + event.clients[i];
  }
  return text;
}

std::vector<EventTime> event_times(const LinkSpec& base, std::span<const NetworkEvent> events) {
  std::vector<EventTime> all;
  for (const NetworkEvent& event : events) {
    const Duration until = event.outage ? event.at + event.outage->length : event.rebind ? event.at : Duration::max();
    all.push_back({event.at, until, event.clients, event.rebind.has_value(),
                   event.outage ? "the outage"
                   : event.link ? "the change of network"
                                : "the rebind",
                   event_text(event)});
  }
  for (const auto& [outage, way] : outages_of(base)) {
    if (!has_one_moment(outage)) continue;
    all.push_back({outage.start, outage.start + outage.length, {}, false, "the outage", outage_words(outage) + way});
  }
  std::ranges::stable_sort(all, {}, &EventTime::at);
  return all;
}

std::vector<EventTime> first_of_repeated(const LinkSpec& base) {
  std::vector<EventTime> all;
  for (const auto& [outage, way] : outages_of(base)) {
    if (outage.period == Duration::zero()) continue;
    all.push_back({outage.start,
                   Duration::max(),
                   {},
                   false,
                   "the first periodic outage",
                   outage_words(outage) + " every " + ms_text(outage.period) + way});
  }
  return all;
}

EventFate fate_of(const EventTime& event, Duration begin, Duration end) noexcept {
  if (event.at >= end) return EventFate::kNotReached;
  // A new address and a permanent change stay in effect, whenever they took place.
  if (!event.momentary && event.until <= begin) return EventFate::kBeforeStart;
  if (!event.momentary && event.until != Duration::max() && event.until > end) return EventFate::kStillActive;
  return EventFate::kApplied;
}

}  // namespace tandem::netsim
