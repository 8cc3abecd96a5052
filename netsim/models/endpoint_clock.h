#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/spec_errors.h"

/// Endpoint effects that are not part of the network: clock offset and drift, and late wake-ups of control loops.
namespace tandem::netsim {

/// Timing of an endpoint's loop.
struct WakeSpec {
  enum class Kind : std::uint8_t {
    kExact,    ///< the loop runs on every tick
    kUniform,  ///< absolute deadlines: wake-up n occurs uniformly in [0, late_max] after n ticks
    /// Relative sleeping, as measured on a recorded 1 kHz robot logger. The step between wake-ups has median 1.02, p99
    /// 1.92 and max 2.77 ticks. Such a loop runs slower than its nominal rate.
    kMeasured,
  };
  Kind kind = Kind::kExact;
  Duration late_max{};  ///< kUniform [0, 1 s]
  Duration phase{};     ///< kUniform: all deadlines are later by this [0, 1 s]
  /// kUniform: the program shifts its deadlines as a client does that a timer of its machine paces
  /// (client/seat/tick_phase.h).
  bool shifts = false;

  friend bool operator==(const WakeSpec&, const WakeSpec&) = default;
};

/// Clock and wake-up timing of one endpoint.
struct EndpointSpec {
  /// Jump of the clock.
  struct Step {
    Duration at{};  ///< simulation time, ascending
    Duration by{};  ///< jump of the clock [-1 d, 1 d]

    friend bool operator==(const Step&, const Step&) = default;
  };
  Duration offset{};             ///< endpoint time minus simulation time at simulation time 0 [-1 d, 1 d]
  double drift_ppm = 0;          ///< rate error: endpoint seconds per simulation second, minus 1, in 1e-6 [-1000, 1000]
  std::vector<Step> steps = {};  ///< at most 64 entries
  WakeSpec wake = {};

  friend bool operator==(const EndpointSpec&, const EndpointSpec&) = default;
};

/// Returns all errors of the spec; empty if the spec is valid.
[[nodiscard]] std::vector<SpecError> problems(const EndpointSpec& spec);

/// Converts simulation time to endpoint time in exact integer arithmetic. Without backward steps the result never
/// decreases.
class EndpointClock {
 public:
  /// @throws std::invalid_argument listing all errors of the spec.
  explicit EndpointClock(const EndpointSpec& spec);

  /// Returns now + offset + drift (rounded down to the nanosecond) + all steps with step.at <= now.
  /// @param now  simulation time [Time{}, Time{} + 100 years]
  [[nodiscard]] Time at(Time now) const noexcept;

 private:
  Duration offset_;
  std::int64_t drift_e12_;  ///< drift in units of 1e-12
  std::vector<EndpointSpec::Step> steps_;
};

/// Wake-up times of an endpoint's loop, in simulation time. Wake-up 0 is the first one at or after `start`. Draws are
/// keyed by the wake-up number, so that they do not depend on other draws.
class WakeUps {
 public:
  /// @param tick  nominal period of the loop, above 0
  /// @throws std::invalid_argument if `spec` or `tick` is out of range.
  WakeUps(const WakeSpec& spec, Duration tick, Time start, RandomKey key);

  /// Returns whether the loop runs at `now`; call once per simulation tick. Each call yields at most one wake-up: a
  /// late loop skips missed deadlines instead of catching up.
  /// @param now  non-decreasing over calls
  [[nodiscard]] bool due(Time now) noexcept { return within(now, now).has_value(); }
  /// Returns the time in [since, now] at which the loop runs, with nanosecond resolution; empty if it does not run. For
  /// simulations that advance in ticks.
  /// @param since  the `now` of the previous call; an overdue wake-up occurs at `since`
  [[nodiscard]] std::optional<Time> within(Time since, Time now) noexcept;
  /// Moves the next wake-up and all after it. @param by  negative: earlier
  void shift(Duration by) noexcept {
    start_ += by;
    next_ += by;
  }

  [[nodiscard]] Time next() const noexcept { return next_; }                 ///< next wake-up
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }      ///< number of wake-ups so far
  [[nodiscard]] std::uint64_t skipped() const noexcept { return skipped_; }  ///< number of skipped deadlines

  /// Returns the step length of kMeasured at probability u in [0, 1), in loop ticks. Interpolates linearly between the
  /// measured points (0, 1), (0.5, 1.02), (0.99, 1.92), (1, 2.77).
  [[nodiscard]] static double measured_step(double u) noexcept;

 private:
  void schedule_next(Time woke) noexcept;
  [[nodiscard]] Time deadline(std::uint64_t n) const noexcept;

  WakeSpec spec_;
  Duration tick_;
  Time start_, next_;
  RandomKey key_;
  std::uint64_t number_ = 0;  ///< number of the next wake-up, used as its draw index
  std::uint64_t count_ = 0, skipped_ = 0;
};

}  // namespace tandem::netsim
