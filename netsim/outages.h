#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// The link-up gate: functions of time alone, so all clients of a schedule are down at the same time.
class OutageGate {
 public:
  enum class State : std::uint8_t { kUp, kDropped, kHoldFull };
  struct Passage {
    State state = State::kUp;
    Time at;  ///< kUp: when the datagram is past the gate: now, or the end of the outage that holds it
  };

  explicit OutageGate(const std::vector<OutageSpec>& outages) : outages_(outages) {}

  /// @param now   never decreasing [Time{} or later]
  /// @param size  payload [bytes]
  Passage enter(Time now, std::size_t size) noexcept;

  /// The end of the outage of `spec` that covers `t`, if any. Half open: down in [start, start + length).
  [[nodiscard]] static std::optional<Time> end_of(const OutageSpec& spec, Time t) noexcept;

 private:
  std::vector<OutageSpec> outages_;
  Time held_until_{};
  std::uint64_t held_bytes_ = 0;
};

}  // namespace tandem::netsim
