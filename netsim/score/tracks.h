#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "netsim/score/lesson_grid.h"

/// Signals of hands and tools on the grid, filtered once for all parts of a lesson.
namespace tandem::netsim::score {

/// A plane that a tool touches.
struct Surface {
  int axis = 0;            ///< normal: 0 x, 1 y, 2 z
  double at = 0;           ///< [m]
  bool from_below = true;  ///< the free side is below `at`
};

/// The tool that a seat follows first.
struct ToolTrack {
  std::vector<LessonTriple> x, f_env;  ///< tip [m]; force of the environment [N]; as recorded
  std::vector<double> force;           ///< |f_env| [N], NaN: unknown
  std::vector<double> penetration;     ///< [m]
  std::vector<std::uint8_t> contact;   ///< 1: above the contact force; interruptions below 20 ms are filled
  std::vector<AxisArray> q;            ///< joints; empty: a virtual tool, or unknown
  std::vector<Stretch> changes;        ///< changes of authority of any seat, [begin, end] with end included as end - 1
  bool has_surface = false;
  Surface surface;
};

/// A hand.
struct SeatTrack {
  std::size_t seat = 0, tool = 0;         ///< indices in the scene
  std::vector<LessonTriple> x_raw, x, v;  ///< tip [m], filtered tip [m], its velocity [m/s]
  std::vector<double> speed;              ///< |v|; NaN: unknown
  std::vector<LessonTriple> f_raw, f;     ///< force delivered to the hand [N], and filtered
  std::vector<double> force;              ///< |f|; NaN: unknown
  std::vector<double> alpha;              ///< authority over the tool; NaN: unknown
  std::vector<AxisArray> q;               ///< joints; empty: unknown
  std::vector<double> turn;  ///< angle to the element before, from filtered orientations [rad]; empty or NaN: unknown
};

/// Returns the first tool that a seat follows; 0 if it follows none.
[[nodiscard]] std::size_t first_tool_of(const SceneSpec& scene, std::size_t seat) noexcept;

[[nodiscard]] SeatTrack seat_track(const Lesson& lesson, const LessonGrid& grid, std::size_t seat,
                                   const ScoreOptions& options);
[[nodiscard]] ToolTrack tool_track(const Lesson& lesson, const LessonGrid& grid, std::size_t tool,
                                   const ScoreOptions& options);

}  // namespace tandem::netsim::score
