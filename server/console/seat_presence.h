#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "proto/spec/lesson.h"
#include "proto/wire/wire_messages.h"

namespace tandem::console {

/// Says which seats of a recording have a participant, from the samples in its rows: a recording repeats the last
/// values of a seat to its end, and has zeros for a seat that no participant took.
class SeatPresence {
 public:
  /// A seat whose last new sample is older is free [s].
  static constexpr double kSampleAgeMax = 0.25;

  SeatPresence() = default;
  explicit SeatPresence(const SceneSpec& scene)
      : age_max_(static_cast<std::uint32_t>(kSampleAgeMax * scene.tick_hz)), seats_(scene.seats.size()) {}

  /// Looks at the samples of a row. In the first row, the tick of a sample gives its age. @pre rows come in the order
  /// of their ticks
  void add(const Lesson& lesson, std::size_t row) {
    tick_ = lesson.tick[row];
    for (std::size_t i = 0; i < seats_.size(); ++i) {
      const LessonSeat& from = lesson.seats[i];
      if (from.sample_tick.empty()) continue;
      Seat& seat = seats_[i];
      const std::uint32_t sample = from.sample_tick[row];
      seat.sampled |= sample > 0 || from.gate[row] != static_cast<std::uint8_t>(wire::GateState::kOff);
      if (!begun_ || sample != seat.sample) seat.heard = begun_ ? tick_ : sample;
      seat.sample = sample;
    }
    begun_ = true;
  }
  /// Whether a participant has the seat in the last row.
  [[nodiscard]] bool taken(std::size_t seat) const noexcept {
    const Seat& s = seats_[seat];
    return s.sampled && (tick_ <= s.heard || tick_ - s.heard <= age_max_);
  }
  /// Whether a row so far has a sample of the seat.
  [[nodiscard]] bool has_samples(std::size_t seat) const noexcept { return seats_[seat].sampled; }

 private:
  struct Seat {
    std::uint32_t sample = 0;  ///< tick of the last sample
    std::uint32_t heard = 0;   ///< first row with it
    bool sampled = false;
  };

  std::uint32_t age_max_ = 0, tick_ = 0;  // [ticks]
  bool begun_ = false;
  std::vector<Seat> seats_;
};

}  // namespace tandem::console
