#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "netsim/score/score_options.h"
#include "netsim/score/triple.h"

/// The rows of a lesson on an even grid of session ticks, as filters and derivatives need them.
namespace tandem::netsim::score {

/// Consecutive elements [begin, end).
struct Stretch {
  std::size_t begin = 0, end = 0;
  [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
};

/// Returns what is wrong with the columns of a lesson, or an empty text: no seat or tool, a column of another length,
/// ticks that do not increase. A column may be empty: its values are unknown.
[[nodiscard]] std::string lesson_problem(const Lesson& lesson);

/// Ticks in which the session ran. Gaps of at most `bridge_s` are filled; a longer one, or a stop, begins a new
/// stretch. Beyond 2^26 elements no gap is filled.
class LessonGrid {
 public:
  /// @pre lesson_problem(lesson) is empty
  LessonGrid(const Lesson& lesson, double bridge_s);

  [[nodiscard]] double rate() const noexcept { return rate_; }  ///< [Hz]
  [[nodiscard]] double dt() const noexcept { return 1 / rate_; }
  [[nodiscard]] std::size_t size() const noexcept { return tick_.size(); }
  [[nodiscard]] std::uint32_t tick(std::size_t k) const noexcept { return tick_[k]; }
  [[nodiscard]] double time(std::size_t k) const noexcept { return tick_[k] / rate_; }  ///< session time [s]
  [[nodiscard]] std::size_t row(std::size_t k) const noexcept { return row_[k]; }       ///< the row at or before it
  [[nodiscard]] bool has_row(std::size_t k) const noexcept { return weight_[k] == 0; }  ///< false: filled
  [[nodiscard]] std::span<const Stretch> stretches() const noexcept { return stretches_; }

  /// Values of a column, interpolated; NaN where unknown. An unknown run of at most `bridge_s` is filled. An empty
  /// column: all NaN.
  [[nodiscard]] std::vector<LessonTriple> values(const std::vector<LessonTriple>& column) const;
  [[nodiscard]] std::vector<double> values(const std::vector<double>& column) const;
  /// Values of the row at or before each element; `missing` for an empty column.
  template <class Value>
  [[nodiscard]] std::vector<Value> held(const std::vector<Value>& column, Value missing) const {
    std::vector<Value> out(size(), missing);
    if (!column.empty())
      for (std::size_t k = 0; k < out.size(); ++k) out[k] = column[row_[k]];
    return out;
  }
  /// Stretches of elements for which `use` is true; none reaches over a gap.
  [[nodiscard]] std::vector<Stretch> runs(const std::function<bool(std::size_t)>& use) const;

 private:
  double rate_;
  std::size_t bridge_;  ///< [ticks]
  std::vector<std::uint32_t> tick_;
  std::vector<std::size_t> row_;
  std::vector<float> weight_;  ///< of the next row
  std::vector<Stretch> stretches_;
};

}  // namespace tandem::netsim::score
