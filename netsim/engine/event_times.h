#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/engine/schedule.h"

/// Checks whether requested network events fell into the time of a run. An event outside the run had no effect, and
/// reports must show that.
namespace tandem::netsim {

/// Requested event as an interval of network time.
struct EventTime {
  Duration at{};
  Duration until{};                       ///< Duration::max(): permanent
  std::vector<std::string> clients = {};  ///< empty: all
  bool momentary = false;                 ///< acts only at `at`, on connected clients (new address)
  std::string kind;                       ///< "the outage", "the change of network", "the rebind", "the fault PAUSE"
  std::string description;                ///< description with all numbers: "outage of 400 ms, up, for trainee"
};

/// Returns all events, and the outages of `base` with a fixed time, sorted by time. Periodic and random outages are
/// excluded.
[[nodiscard]] std::vector<EventTime> event_times(const LinkSpec& base, std::span<const NetworkEvent> events);

/// Returns the first occurrence of each periodic outage of `base`. A run that ends before it contains no outage of that
/// series.
[[nodiscard]] std::vector<EventTime> first_of_repeated(const LinkSpec& base);

/// Effect of an event on a run.
enum class EventFate : std::uint8_t {
  kApplied,      ///< took effect; ended during the run or permanent
  kStillActive,  ///< still active at the end of the run
  kBeforeStart,  ///< ended before the run began
  kNotReached,   ///< its time lies after the end of the run
};
/// Returns the fate of an event in a run.
/// @param begin, end  interval of the run, network time
[[nodiscard]] EventFate fate_of(const EventTime& event, Duration begin, Duration end) noexcept;

/// Returns the full description without the time: "outage of 400 ms, held, up, for trainee".
[[nodiscard]] std::string event_text(const NetworkEvent& event);

}  // namespace tandem::netsim
