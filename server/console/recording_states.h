#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "proto/rpc/rpc_limits.h"
#include "proto/spec/lesson.h"
#include "server/console/recording_outline.h"
#include "server/console/seat_presence.h"
#include "server/console/session_picture.h"

/// States of a recording as the page draws them: those of message `state` (PROTOCOL.md), 60 per second. Nothing is
/// interpolated: a period without a row has no state.
namespace tandem::console {

/// Periods of equal length from the first tick on. A piece is what a page asks for at once.
class RecordingPeriods {
 public:
  static constexpr double kRateMax = 60, kPieceSeconds = 10;

  /// @param first  tick of the first row
  /// @param last   tick of the last row, at least `first`
  RecordingPeriods(double tick_hz, std::uint32_t first, std::uint32_t last) noexcept;

  [[nodiscard]] double rate() const noexcept { return rate_; }  ///< [Hz]
  [[nodiscard]] std::uint32_t per_piece() const noexcept { return per_piece_; }
  [[nodiscard]] std::uint32_t pieces() const noexcept { return pieces_; }
  /// First tick of a period.
  [[nodiscard]] std::uint64_t tick(std::uint64_t period) const noexcept;
  /// First tick of a piece; that of the next one is its end.
  [[nodiscard]] std::uint64_t piece_tick(std::uint64_t piece) const noexcept { return tick(piece * per_piece_); }

 private:
  double tick_hz_, rate_;
  std::uint32_t first_, per_piece_ = 1, pieces_ = 1;
};

/// Picture of one row. Values that the recording has not are unknown, and those of a free seat.
/// @param base  scene, and status with the names of persons
/// @param presence  has the row as its last one
/// @param link  number of rows of `lesson.links` that were used; rows come in the order of time
[[nodiscard]] LivePicture picture_of(const Lesson& lesson, std::size_t row, const LivePicture& base,
                                     const SeatPresence& presence, std::size_t& link);

/// Scene and persons of a recording, for `picture_of` and `scene_json`.
/// @param id  number of the session for the page
[[nodiscard]] LivePicture recording_base(const Lesson& head, const rpc::Id& id);

/// Returns `{"piece": N, "states": [...]}`, where `n` of a state is the number of its period, from 1.
/// @param lesson  has the rows of the piece, and perhaps others
[[nodiscard]] std::string piece_json(const RecordingPeriods& periods, std::uint32_t piece, const Lesson& lesson,
                                     const LivePicture& base);

}  // namespace tandem::console
