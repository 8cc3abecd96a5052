#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "netsim/score/lesson_scores.h"

/// Lessons with numbers that a reader can compute by hand.
namespace tandem::netsim::score {

/// Adds values to a lesson row by row.
struct LessonMaker {
  Lesson lesson;

  /// One tool, followed by all seats; no phases; no force limit unless set.
  explicit LessonMaker(const std::vector<std::string>& seats = {"trainee"}, double rate_hz = 1000) {
    SceneSpec& scene = lesson.scene;
    scene.name = "made";
    scene.tick_hz = rate_hz;
    scene.gate.force_max = 1e6;
    for (const std::string& name : seats) {
      SeatSpec seat;
      seat.name = name;
      seat.role = name == "trainer" ? Role::kInstructor : Role::kTrainee;
      seat.device.force_peak = 1e6;
      scene.follow[scene.seats.size()][0] = 1;
      scene.seats.push_back(seat);
    }
    ToolSpec tool;
    tool.name = "tool";
    scene.tools.push_back(tool);
    lesson.seats.resize(seats.size());
    lesson.tools.resize(1);
  }

  /// Adds ticks [0, n); columns stay empty.
  LessonMaker& ticks(std::uint32_t n) {
    for (std::uint32_t k = 0; k < n; ++k) lesson.tick.push_back(k);
    return *this;
  }
  [[nodiscard]] double time(std::size_t row) const { return lesson.tick[row] / lesson.scene.tick_hz; }
  template <class Value>
  void fill(std::vector<Value>& column, const std::function<Value(double)>& value_at) const {
    column.clear();
    for (std::size_t r = 0; r < lesson.rows(); ++r) column.push_back(value_at(time(r)));
  }
  LessonMaker& hand(std::size_t seat, const std::function<LessonTriple(double)>& x) {
    fill<LessonTriple>(lesson.seats[seat].x, x);
    return *this;
  }
  LessonMaker& force(std::size_t seat, const std::function<LessonTriple(double)>& f) {
    fill<LessonTriple>(lesson.seats[seat].f, f);
    return *this;
  }
  LessonMaker& authority(std::size_t seat, const std::function<double(double)>& alpha) {
    fill<double>(lesson.seats[seat].alpha, alpha);
    return *this;
  }
  LessonMaker& tool(const std::function<LessonTriple(double)>& x, const std::function<LessonTriple(double)>& f_env) {
    fill<LessonTriple>(lesson.tools[0].x, x);
    fill<LessonTriple>(lesson.tools[0].f_env, f_env);
    return *this;
  }
  [[nodiscard]] LessonScores scores(const ScoreOptions& options = {}) const {
    auto scored = score_lesson(lesson, options);
    return scored ? std::move(*scored) : LessonScores{};
  }
};

/// Value of a metric; NaN if seat or part are missing.
inline double value_of(const LessonScores& scores, const std::string& seat, Metric metric,
                       const std::string& part = "whole") {
  const SeatScore* const score = scores.seat(seat);
  const PartScore* const found = score == nullptr ? nullptr : score->part(part);
  return found == nullptr ? kUnknown : of(found->values, metric);
}

/// A minimum-jerk motion from 0 to 1 in time 1 [Flash & Hogan 1985].
inline double minimum_jerk(double t) {
  const double s = std::fmin(std::fmax(t, 0), 1);
  return s * s * s * (10 + s * (-15 + 6 * s));
}

}  // namespace tandem::netsim::score
