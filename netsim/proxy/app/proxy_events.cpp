#include "netsim/proxy/app/proxy_events.h"

#include <algorithm>
#include <array>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

/// Returns the earliest arrival of a client that the event affects; Duration::max() if there was none.
Duration first_there(const EventTime& event, std::span<const ProxyClientStatus> clients, std::uint64_t seen) {
  Duration first = Duration::max();
  const auto meant = [&](std::uint64_t number) {
    return event.clients.empty() || std::ranges::find(event.clients, std::to_string(number)) != event.clients.end();
  };
  for (const ProxyClientStatus& client : clients)
    if (meant(client.number)) first = std::min(first, client.arrived);
  if (first != Duration::max() || clients.size() == seen) return first;
  for (std::uint64_t number = 1; number <= seen; ++number)
    if (meant(number)) return Duration::zero();
  return first;
}

std::string who(const EventTime& event) {
  if (event.clients.empty()) return "a client";
  std::string text = "client";
  for (std::size_t i = 0; i < event.clients.size(); ++i) text += (i == 0 ? " " : " or ") + event.clients[i];
  return text;
}

}  // namespace

const char* name(ProxyEvent::Fate fate) noexcept {
  constexpr std::array kNames{"applied", "unfinished", "no-target", "not-reached"};
  return kNames[static_cast<std::size_t>(fate)];
}

std::vector<ProxyEvent> proxy_events(const ProxyOptions& options, std::span<const ProxyClientStatus> clients,
                                     std::uint64_t seen, Duration end) {
  std::vector<ProxyEvent> all;
  for (EventTime& event : event_times(options.link, options.events)) {
    ProxyEvent& one = all.emplace_back(ProxyEvent{std::move(event), {}, {}});
    const EventFate fate = fate_of(one.event, Duration::zero(), end);
    const Duration there = first_there(one.event, clients, seen);
    const bool in_vain = one.event.momentary ? there > one.event.at : there >= one.event.until;
    if (fate == EventFate::kNotReached) {
      one.fate = ProxyEvent::Fate::kNotReached;
      one.reason = format("the proxy ended before it, at %.3f s", seconds(end));
    } else if (there == Duration::max()) {
      one.fate = ProxyEvent::Fate::kNoTarget;
      one.reason = one.event.clients.empty() ? "no client connected" : who(one.event) + " never connected";
    } else if (in_vain) {
      one.fate = ProxyEvent::Fate::kNoTarget;
      one.reason = who(one.event) + format(" connected later, at %.3f s", seconds(there));
    } else if (fate == EventFate::kStillActive) {
      one.fate = ProxyEvent::Fate::kStillActive;
      one.reason = format("it was not over when the proxy ended, at %.3f s", seconds(end));
    }
  }
  return all;
}

std::string events_text(std::span<const ProxyEvent> events) {
  std::string text;
  for (const ProxyEvent& one : events) {
    text += format("  event at %.3f s: ", seconds(one.event.at)) + one.event.description + ": " + name(one.fate);
    text += one.reason.empty() ? "\n" : "; " + one.reason + "\n";
  }
  return text;
}

}  // namespace tandem::netsim
