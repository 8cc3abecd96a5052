#pragma once

#include <string>
#include <vector>

#include "netsim/score/tracks.h"

/// How hands of one tool work together: an instructor takes it, two hands agree or oppose.
namespace tandem::netsim::score {

/// An instructor's seat took the tool from another seat.
struct Intervention {
  std::size_t seat = 0, from_seat = 0;  ///< indices of the instructor's seat and of the seat that held the tool before
  std::size_t begin = 0, end = 0;       ///< elements of the grid, [begin, end)
  double from_s = 0, to_s = 0;          ///< session time [s]
  std::string cause;                    ///< audited event or scene timeline; "not recorded" otherwise
  /// Mean cosine between the force on the other hand and its velocity [-1, 1]: below 0 the force opposed the motion.
  /// NaN: that hand did not move, or felt no force.
  double opposition = kUnknown;
};

/// Returns the interventions at a tool, in time.
/// @param seats  tracks of all MASTER seats, by index of the seat
[[nodiscard]] std::vector<Intervention> interventions_at(const Lesson& lesson, const LessonGrid& grid,
                                                         const std::vector<SeatTrack>& seats, std::size_t tool,
                                                         const ScoreOptions& options);

/// Two hands.
struct PairScore {
  std::size_t first = 0, second = 0;  ///< indices of the seats
  /// Mean of max(0, -cosine) of the two forces over the time in which both hands feel force [0, 1]; 0: never opposed.
  double conflict = kUnknown;
  double both_feel_s = 0;  ///< that time [s]
  bool one_person = false;
  /// Time in which both hands move over the time in which at least one does [0, 1]; for two hands of one person.
  double both_move_share = kUnknown;
  /// Correlation of both speeds [-1, 1]; for two hands of one person.
  double speed_correlation = kUnknown;
};

[[nodiscard]] PairScore pair_score(const LessonGrid& grid, const SeatTrack& first, const SeatTrack& second,
                                   bool one_person, const ScoreOptions& options);

}  // namespace tandem::netsim::score
