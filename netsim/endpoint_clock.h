#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/findings.h"

/// What is not the network, yet equally real: endpoints whose clocks differ and whose loops wake up late.
namespace tandem::netsim {

/// When the loop of an endpoint runs.
struct WakeSpec {
  enum class Kind : std::uint8_t {
    kExact,    ///< on every tick
    kUniform,  ///< absolute deadlines: wake-up n comes uniform in [0, late_max] after n ticks
    /// Relative sleeping, as a recorded 1 kHz robot logger does it: from wake-up to wake-up it takes a step of median
    /// 1.02, p99 1.92, max 2.77 ticks (network.md 3.4). Such a loop runs slower than it was asked to.
    kMeasured,
  };
  Kind kind = Kind::kExact;
  Duration late_max{};  ///< kUniform [0, 1 s]

  friend bool operator==(const WakeSpec&, const WakeSpec&) = default;
};

/// One endpoint's own time, and when it wakes up.
struct EndpointSpec {
  struct Step {
    Duration at{};  ///< world time, ascending
    Duration by{};  ///< the clock jumps by so much [-1 d, 1 d]

    friend bool operator==(const Step&, const Step&) = default;
  };
  Duration offset{};             ///< own time minus world time at world time 0 [-1 d, 1 d]
  double drift_ppm = 0;          ///< own seconds per world second, minus 1 [-1000, 1000] 1e-6
  std::vector<Step> steps = {};  ///< at most 64
  WakeSpec wake = {};

  friend bool operator==(const EndpointSpec&, const EndpointSpec&) = default;
};

/// All mistakes; empty: the spec can be simulated.
[[nodiscard]] std::vector<SpecProblem> problems(const EndpointSpec& spec);

/// World time to an endpoint's own time. Exact integers; without steps backwards it never decreases.
class EndpointClock {
 public:
  /// @throws std::invalid_argument listing all problems of the spec.
  explicit EndpointClock(const EndpointSpec& spec);

  /// world + offset + drift (rounded down to the nanosecond) + all steps with step.at <= world.
  /// @param world  [Time{}, Time{} + 100 years]
  [[nodiscard]] Time at(Time world) const noexcept;

 private:
  Duration offset_;
  std::int64_t drift_e12_;  ///< drift in parts of 1e12
  std::vector<EndpointSpec::Step> steps_;
};

/// The moments at which an endpoint's loop runs, in world time. Wake-up 0 is the first one at or after `start`.
/// Keyed: the n-th draw is the same whatever else happens.
class WakeUps {
 public:
  /// @param tick  the period the loop asks for, above 0
  /// @throws std::invalid_argument if `spec` or `tick` is out of range.
  WakeUps(const WakeSpec& spec, Duration tick, Time start, RandomKey key);

  /// Whether the loop runs at `now`; call once per tick of the world. At most one wake-up per call: a loop that woke
  /// up late does not run twice to catch up, it skips what it missed.
  /// @param now  never decreasing
  [[nodiscard]] bool due(Time now) noexcept { return within(now, now).has_value(); }
  /// The same for a world that moves in ticks: the moment in [since, now] at which the loop runs, to the nanosecond.
  /// @param since  the `now` of the call before; a wake-up that was due earlier still comes at `since`
  [[nodiscard]] std::optional<Time> within(Time since, Time now) noexcept;

  [[nodiscard]] Time next() const noexcept { return next_; }                 ///< the wake-up to come
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }      ///< wake-ups so far
  [[nodiscard]] std::uint64_t skipped() const noexcept { return skipped_; }  ///< deadlines missed altogether

  /// Length of a step of kMeasured at probability u in [0, 1), in ticks of the loop: linear between the measured
  /// points (0, 1), (0.5, 1.02), (0.99, 1.92), (1, 2.77).
  [[nodiscard]] static double measured_step(double u) noexcept;

 private:
  void schedule_next(Time woke) noexcept;
  [[nodiscard]] Time deadline(std::uint64_t n) const noexcept;

  WakeSpec spec_;
  Duration tick_;
  Time start_, next_;
  RandomKey key_;
  std::uint64_t number_ = 0;  ///< of the wake-up to come: its draw
  std::uint64_t count_ = 0, skipped_ = 0;
};

}  // namespace tandem::netsim
