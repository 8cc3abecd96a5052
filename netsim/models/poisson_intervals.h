#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/rng.h"
#include "common/base/time.h"

namespace tandem::netsim {

/// Distribution of interval lengths, evaluated at one uniform number.
struct LengthLaw {
  enum class Kind : std::uint8_t {
    kUniform,      ///< uniform in [`low`, `high`]; equal bounds give a fixed length
    kExponential,  ///< mean `low`
    kPareto,       ///< `low` (1 - u)^(-1/alpha)
    kParetoII,     ///< `low` ((1 - u)^(-1/alpha) - 1)
  };
  Kind kind = Kind::kUniform;
  double low = 0, high = 0;  ///< [ns]
  double alpha = 1;
  double cap = 0;  ///< longest length [ns]

  [[nodiscard]] double at(double u) const noexcept;
};

/// Intervals that begin as a Poisson process, as a function of time. Draws are keyed by time slot, so that results do
/// not depend on the number or order of queries.
class PoissonIntervals {
 public:
  /// Half-open interval of time [start, end).
  struct Interval {
    Time start, end;
  };

  /// @param rate_per_s  0: none; rate times cap at most 32
  PoissonIntervals(double rate_per_s, const LengthLaw& length, RandomKey key) noexcept;

  /// Returns `t`, or the end of the chain of overlapping intervals that covers `t`.
  [[nodiscard]] Time end_of_chain(Time t) noexcept { return rate_ > 0 ? chain_end(t) : t; }

  /// Returns whether an interval began in (t - window, t].
  /// @param window  at most the longest interval
  [[nodiscard]] bool begun_within(Time t, Duration window) noexcept;

  /// Calls `visit(interval)` for the intervals that begin in (after, upto]. Of ranges above 32 slots, only the last
  /// part is visited.
  template <typename Visit>
  void begun(Time after, Time upto, Visit visit) noexcept {
    const std::int64_t last = upto.time_since_epoch() / slot_length_;
    const std::int64_t first = std::max({after.time_since_epoch() / slot_length_, last - 32, std::int64_t{0}});
    for (std::int64_t number = first; number <= last; ++number) {
      const Slot& candidates = slot(number);
      for (std::size_t i = 0; i < candidates.count && candidates.intervals[i].start <= upto; ++i) {
        if (candidates.intervals[i].start > after) visit(candidates.intervals[i]);
      }
    }
  }

 private:
  /// On average at most rate * cap = 32 intervals begin per slot; P(Poisson(32) > 96) < 1e-18. Later ones are omitted.
  static constexpr std::size_t kPerSlotMax = 96;
  static constexpr std::size_t kSlotsCached = 4;  ///< power of two
  struct Slot {
    std::int64_t number = -1;
    std::size_t count = 0;
    std::array<Interval, kPerSlotMax> intervals{};
  };

  [[nodiscard]] Time chain_end(Time t) noexcept;
  [[nodiscard]] const Slot& slot(std::int64_t number) noexcept;

  double rate_;  ///< [1/s]
  LengthLaw length_;
  Duration slot_length_;
  RandomKey start_key_, length_key_;
  std::array<Slot, kSlotsCached> slots_{};
};

}  // namespace tandem::netsim
