#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/path_spec.h"
#include "netsim/poisson_intervals.h"

namespace tandem::netsim {

/// The link-up gate: functions of time alone, so all clients of a schedule are down at the same time.
class OutageGate {
 public:
  enum class State : std::uint8_t {
    kUp,
    kDropped,
    kHoldFull,
    kNewest,  ///< held until `at`, unless a newer one of its flow comes before that
  };
  struct Passage {
    State state = State::kUp;
    Time at;  ///< kUp, kNewest: when the datagram is past the gate: now, or the end of the outage that holds it
  };

  /// @param key      of the moments of random outages of this link
  /// @param all_key  of those that all links have together
  OutageGate(const std::vector<OutageSpec>& outages, RandomKey key, RandomKey all_key);
  explicit OutageGate(const std::vector<OutageSpec>& outages, RandomKey key = RandomKey{0})
      : OutageGate(outages, key, key) {}

  /// @param now   never decreasing [Time{} or later]
  /// @param size  payload [bytes]
  Passage enter(Time now, std::size_t size) noexcept {
    return outages_.empty() ? Passage{State::kUp, now} : enter_any(now, size);
  }

  /// Goes on where `before` was: what it holds stays held.
  void take_over(const OutageGate& before) noexcept {
    held_until_ = before.held_until_;
    newest_until_ = before.newest_until_;
    held_bytes_ = before.held_bytes_;
  }

  /// The end of the outage of `spec` that covers `t`, if any. Half open: down in [start, start + length).
  [[nodiscard]] static std::optional<Time> end_of(const OutageSpec& spec, Time t) noexcept;

 private:
  struct Outage {
    OutageSpec spec;
    std::optional<std::size_t> random;  ///< its place in random_; else scheduled
    RandomKey length_key{0};            ///< of drawn lengths of what is scheduled again and again
  };
  Passage enter_any(Time now, std::size_t size) noexcept;
  [[nodiscard]] std::optional<Time> end_of(const Outage& outage, Time t) noexcept;
  [[nodiscard]] bool just_begun(const Outage& outage, Time t) noexcept;

  std::vector<Outage> outages_;
  std::vector<PoissonIntervals> random_;
  Time held_until_{};
  Time newest_until_{};  ///< the link stays down until then, and something waits that a newer one may replace
  std::uint64_t held_bytes_ = 0;
};

}  // namespace tandem::netsim
