#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// Moments at which the network hands nothing over, then everything at once: Wi-Fi scans, retransmission, handover.
/// A function of time: stalls are drawn per time slot, an exact Poisson process whatever the order of questions.
class Stalls {
 public:
  Stalls(const StallSpec& spec, RandomKey key) noexcept;

  /// When something that would leave at `t` leaves: `t`, or the end of the stall(s) that cover it.
  [[nodiscard]] Time release(Time t) noexcept { return rate_ > 0 ? release_held(t) : t; }

 private:
  /// At most rate * cap = 32 begin per slot on average; P(Poisson(32) > 96) < 1e-18, and then later ones are left out.
  static constexpr std::size_t kPerSlotMax = 96;
  static constexpr std::size_t kSlotsCached = 4;  ///< power of two
  struct Stall {
    Time start, end;
  };
  struct Slot {
    std::int64_t number = -1;
    std::size_t count = 0;
    std::array<Stall, kPerSlotMax> stalls{};
  };

  [[nodiscard]] Time release_held(Time t) noexcept;
  [[nodiscard]] const Slot& slot(std::int64_t number) noexcept;

  double rate_;                      ///< [1/s]
  double length_min_, alpha_, cap_;  ///< [ns], 1, [ns]
  Duration slot_length_;
  RandomKey start_key_, length_key_;
  std::array<Slot, kSlotsCached> slots_{};
};

}  // namespace tandem::netsim
