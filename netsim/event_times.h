#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/script.h"

/// Whether what somebody asked for at a moment fell into the time that was lived: an event outside of it changed nothing,
/// and whoever reads the report must know.
namespace tandem::netsim {

/// Something asked for, as a stretch of network time.
struct EventTime {
  Duration at{};
  Duration until{};                       ///< Duration::max(): stays in force
  std::vector<std::string> clients = {};  ///< empty: all
  bool momentary = false;                 ///< happens at `at` only, to whoever is there: a new address
  std::string kind;                       ///< "the outage", "the change of network", "the rebind", "the fault PAUSE"
  std::string words;                      ///< with all its numbers: "outage of 400 ms, up, for trainee"
};

/// The events and the outages of `base` that have one moment (repeated and drawn ones do not), by time.
[[nodiscard]] std::vector<EventTime> event_times(const LinkSpec& base, std::span<const NetworkEvent> events);

/// The first of each periodic outage of `base`: who never met that one met none.
[[nodiscard]] std::vector<EventTime> first_of_repeated(const LinkSpec& base);

enum class EventFate : std::uint8_t {
  kCame,     ///< and was over, or stays for good
  kGoesOn,   ///< was not over at the end
  kBefore,   ///< over before the beginning
  kAfter,    ///< never came: the end was earlier
};
/// @param begin, end  of what was lived, network time
[[nodiscard]] EventFate fate_of(const EventTime& event, Duration begin, Duration end) noexcept;

/// The event in full, without its time: "outage of 400 ms, held, up, for trainee".
[[nodiscard]] std::string event_words(const NetworkEvent& event);

}  // namespace tandem::netsim
