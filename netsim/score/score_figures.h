#pragma once

#include <vector>

#include "netsim/plot/svg_plot.h"
#include "netsim/score/path_picture.h"
#include "netsim/score/score_output.h"
#include "netsim/score/tracks.h"

/// Figures of a learner's report.
namespace tandem::netsim::score {

/// Signals of a lesson from one seat.
struct SeatView {
  const Lesson& lesson;
  const LessonScores& scores;
  LessonGrid grid;
  std::vector<SeatTrack> seats;  ///< all MASTER seats
  std::size_t own = 0;           ///< index of the learner's seat
  ToolTrack tool;
  std::vector<Part> parts;

  /// @param own  index of a MASTER seat
  SeatView(const Lesson& of, const LessonScores& with, std::size_t own_seat);
};

/// Path of the hand, cut where the holder of the tool changes, and of the tool.
[[nodiscard]] std::vector<PathPiece> path_pieces(const SeatView& view);
/// The same in three planes.
[[nodiscard]] plot::Figure planes_figure(const SeatView& view);
/// Speed, force and authority over time; contact is shaded, missing samples are marked.
[[nodiscard]] plot::Figure time_figure(const SeatView& view);
/// Values over the sessions with median and pass mark; at most `most` curves. No panel if there are fewer than two
/// sessions.
[[nodiscard]] plot::Figure curves_figure(const ScoreResult& result, std::size_t most);

}  // namespace tandem::netsim::score
