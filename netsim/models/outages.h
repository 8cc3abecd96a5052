#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/path_spec.h"
#include "netsim/models/poisson_intervals.h"

namespace tandem::netsim {

/// Link-up gate. Outages are functions of time only, so that all clients of a schedule are down at the same time.
class OutageGate {
 public:
  /// Treatment of a datagram at the gate.
  enum class State : std::uint8_t {
    kUp,
    kDropped,
    kHoldFull,
    kNewest,  ///< held until `at`, unless a newer datagram of its flow arrives earlier
  };
  /// Result for one datagram.
  struct Passage {
    State state = State::kUp;
    Time at;  ///< kUp, kNewest: time at which the datagram passes the gate: now, or the end of the outage that holds it
  };

  /// @param key      key of the random outages of this link
  /// @param all_key  key of the random outages common to all links
  OutageGate(const std::vector<OutageSpec>& outages, RandomKey key, RandomKey all_key);
  explicit OutageGate(const std::vector<OutageSpec>& outages, RandomKey key = RandomKey{0})
      : OutageGate(outages, key, key) {}

  /// @param now   Time{} or later, non-decreasing over calls
  /// @param size  payload [bytes]
  Passage enter(Time now, std::size_t size) noexcept {
    return outages_.empty() ? Passage{State::kUp, now} : enter_any(now, size);
  }

  /// Takes over the state of `before`: held datagrams stay held.
  void replace(const OutageGate& before) noexcept {
    held_until_ = before.held_until_;
    newest_until_ = before.newest_until_;
    held_bytes_ = before.held_bytes_;
  }

  /// Returns the end of the outage of `spec` that covers `t`; empty if none does. Half open: down in [start, start +
  /// length).
  [[nodiscard]] static std::optional<Time> end_of(const OutageSpec& spec, Time t) noexcept;

 private:
  struct Outage {
    OutageSpec spec;
    std::optional<std::size_t> random;  ///< index in random_; empty: scheduled
    RandomKey length_key{0};            ///< key of the drawn lengths of periodic outages
  };
  Passage enter_any(Time now, std::size_t size) noexcept;
  [[nodiscard]] std::optional<Time> end_of(const Outage& outage, Time t) noexcept;
  [[nodiscard]] bool in_start_loss_window(const Outage& outage, Time t) noexcept;

  std::vector<Outage> outages_;
  std::vector<PoissonIntervals> random_;
  Time held_until_{};
  Time newest_until_{};  ///< the link is down until then, and a waiting datagram may be replaced
  std::uint64_t held_bytes_ = 0;
};

}  // namespace tandem::netsim
