#include "netsim/system/session_notes.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "common/base/format.h"
#include "common/setup/device_stiffness.h"
#include "netsim/engine/event_times.h"
#include "netsim/models/link_text.h"
#include "netsim/system/simulation.h"

namespace tandem::netsim {
namespace {

/// Returns everything with a time: events of all seats' networks, the script, and the faults.
std::vector<EventTime> asked_for(const SimulationConfig& setup) {
  std::vector<EventTime> all;
  if (!setup.replay) {  // a replay decides alone; these are not used then
    all = event_times(setup.network, setup.events);
    std::ranges::move(first_of_repeated(setup.network), std::back_inserter(all));
    for (const auto& [seat, link] : setup.seat_networks) {
      std::vector<EventTime> its = event_times(link, {});
      std::ranges::move(first_of_repeated(link), std::back_inserter(its));
      for (EventTime& own : its) {
        own.description += ", for " + seat;
        all.push_back(std::move(own));
      }
    }
  }
  for (const Fault& f : setup.faults) {
    const std::string kind = "the fault " + std::string(name(f.kind));
    all.push_back({f.at, f.at + f.length, {}, false, kind, kind + (f.seat.empty() ? "" : " of " + f.seat)});
  }
  std::ranges::stable_sort(all, {}, &EventTime::at);
  return all;
}

std::string missed(const EventTime& event, const SessionSpan& span) {
  const EventFate fate = fate_of(event, span.begin, span.end);
  if (fate == EventFate::kNotReached)
    return format("%s at %g s came after the end of the run, %.3f s", event.kind.c_str(), seconds(event.at),
                  seconds(span.end));
  if (fate == EventFate::kBeforeStart)
    return format("%s at %g s was over before the session began, at %.3f s of network time", event.kind.c_str(),
                  seconds(event.at), seconds(span.begin));
  return {};
}

/// Explains a change of address: the seat's line counts datagrams that the server accepted, the network's block those
/// that the network carried. After the change the two counts differ, and both are correct.
std::string rebind_note(const NetworkEvent& event, const std::string& seat) {
  return format(
      "%s has a new address from %g s on: the server validates it before it sends forces there, so its datagrams "
      "meanwhile go to the old address and are lost from %g s on; the hand is released for that time",
      seat.c_str(), seconds(event.at), seconds(event.at + event.rebind->dead_after));
}

/// Reports a softened spring between a simulated device and its seat; empty if the spring is as written.
std::string softened_note(const SceneSpec& scene, std::size_t seat) {
  const rpc::DeviceFacts device = setup::simulated_device(scene, seat);
  const std::string words =
      setup::softened_text(setup::with_limited_stiffness(seat_setup(scene, seat), device), device);
  return words.empty() ? words : scene.seats[seat].name + ": " + words;
}

}  // namespace

double granted_stiffness(const SceneSpec& scene, std::size_t seat) {
  return std::min(scene.coupling.k_c,
                  setup::stiffness_for(seat_setup(scene, seat), setup::simulated_device(scene, seat)));
}

SessionSpan session_span(const Simulation& simulation) {
  const Duration end = simulation.now() - Time{};
  const auto& session = simulation.session();
  return {end - from_seconds(session.clock().time() +
                             static_cast<double>(session.clock().stopped_ticks()) / simulation.scene().tick_hz),
          end};
}

std::vector<std::string> session_notes(const SimulationConfig& setup, const SessionSpan& span) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < setup.scene.seats.size(); ++i)
    if (std::string note = softened_note(setup.scene, i); !note.empty()) notes.push_back(std::move(note));
  for (const EventTime& event : asked_for(setup))
    if (std::string note = missed(event, span); !note.empty()) notes.push_back(std::move(note));
  if (setup.replay) return notes;
  for (const SeatSpec& seat : setup.scene.seats) {
    const auto its = [&](const NetworkEvent& e) {
      return e.rebind && e.at < span.end &&
             (e.clients.empty() || std::ranges::find(e.clients, seat.name) != e.clients.end());
    };
    const auto first = std::ranges::find_if(setup.events, its);  // later events change nothing any more
    if (first != setup.events.end()) notes.push_back(rebind_note(*first, seat.name));
  }
  return notes;
}

std::string endless_scene_error(const std::string& scene, const std::string& remedy) {
  return "the scene " + scene + " has no end (it gives no duration_s), so its run in virtual time would not end; " +
         remedy;
}

std::vector<std::string> late_notes(const SimulationConfig& setup) {
  std::vector<std::string> notes;
  const double length = setup.scene.duration;
  for (const EventTime& event : asked_for(setup))
    if (seconds(event.at) >= length)
      notes.push_back(
          format("%s at %g s will not come, unless the session of %g s begins later than at %g s of network time",
                 event.kind.c_str(), seconds(event.at), length, seconds(event.at) - length));
  return notes;
}

std::string network_listing(const SimulationConfig& setup, const std::string& indent) {
  const std::string deeper = indent + "  ";
  const bool own_only = !setup.scene.seats.empty() && setup.seat_networks.size() == setup.scene.seats.size();
  std::string text;
  if (!own_only)
    text += indent + (setup.seat_networks.empty() ? "network of every seat\n" : "network of every other seat\n") +
            link_text(setup.network, deeper);
  for (const auto& [seat, link] : setup.seat_networks)
    text += indent + "network of " + seat + "\n" + link_text(link, deeper);
  for (const NetworkEvent& e : setup.events) {
    text += indent + format("network at %.3f s: ", seconds(e.at)) + event_text(e) + "\n";
    if (e.link) text += link_text(*e.link, deeper);
  }
  for (const auto& [seat, e] : setup.endpoints) {
    constexpr std::array kWake{"on every tick", "late by up to", "as a recorded logger"};
    text += indent + format("clock of %s: %+.3f ms, %+.1f ppm, ", seat.c_str(), seconds(e.offset) * 1e3, e.drift_ppm) +
            "wakes " + kWake[static_cast<std::size_t>(e.wake.kind)];
    if (e.wake.kind == WakeSpec::Kind::kUniform) text += format(" %.3f ms", seconds(e.wake.late_max) * 1e3);
    for (const auto& step : e.steps)
      text += format(", jumps by %+.3f ms at %.3f s", seconds(step.by) * 1e3, seconds(step.at));
    text += "\n";
  }
  return text;
}

}  // namespace tandem::netsim
