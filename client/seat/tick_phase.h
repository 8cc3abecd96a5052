#pragma once

#include <cstdint>

#include "common/base/time.h"
#include "common/transport/link_timing.h"

namespace tandem::client {

/// Shifts the ticks of a client until its STATE messages arrive shortly before the ticks of the server that use them.
/// Without it, the phase between two clocks of one rate is arbitrary: a STATE waits for up to a whole tick, and the
/// FORCE that answers it misses the client's next tick. The difference of the clocks is followed too.
///
/// Each FORCE states how long the newest STATE had waited. The wait is an angle on the circle of one tick, so its mean
/// and its spread sigma are those of directions (Mardia and Jupp, Directional Statistics, 2000, ch. 2.3). The wait
/// aimed at is 3 sigma, within a sixth and a half of a tick. Beyond a resultant length of 0.5 (sigma of 0.19 ticks) the
/// network varies more than a shift could save, and no tick is shifted.
class TickPhase {
 public:
  /// @param tick  period of the ticks of client and server
  explicit TickPhase(Duration tick) noexcept : tick_(tick) {}

  /// Records the newest FORCE, unless that is recorded. Called once per tick, after the tick's datagrams were received.
  void observe(const transport::LinkTiming& timing, Time now) noexcept;
  /// Records a FORCE that has arrived.
  /// @param waited  time for which the server had received nothing newer than the STATE that it answers, 0 or more
  /// @param loop    time since that STATE was sent
  void record(Duration waited, Duration loop) noexcept;
  /// Returns by how much the next tick is later than one period after this one: at most 1 % of the period, negative
  /// for earlier. Called once per tick.
  [[nodiscard]] Duration next_shift() noexcept;
  /// Forgets what was recorded: the server is another one.
  void restart() noexcept { *this = TickPhase{tick_}; }

 private:
  static constexpr int kSamples = 100;        ///< FORCE messages per measurement
  static constexpr int kTicksPerShift = 100;  ///< a tick is shifted by its 100th part at most
  void plan(Duration loop) noexcept;

  Duration tick_;
  Time heard_{};                    ///< arrival of the FORCE that was observed last
  double cosines_ = 0, sines_ = 0;  ///< sums over the directions of this measurement
  int count_ = 0;
  std::int64_t ignored_ = 0;  ///< FORCE messages to come that answer a STATE from before the end of the shift
  Duration left_{};           ///< part of the planned shift that is still to be made
};

}  // namespace tandem::client
