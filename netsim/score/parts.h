#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "netsim/score/lesson_grid.h"

/// Parts of a lesson that get scores of their own.
namespace tandem::netsim::score {

struct Part {
  enum class Kind : std::uint8_t { kWhole, kHeldBy, kShared, kPhase };
  Kind kind = Kind::kWhole;
  std::string key;                 ///< `whole`, `held:SEAT`, `shared`, `phase:NAME`
  std::string title;               ///< for reports
  std::vector<std::uint8_t> mask;  ///< on the grid; 1: in the part
  [[nodiscard]] bool has(std::size_t k) const noexcept { return mask[k] != 0; }
};

/// Returns the parts with at least one element, as a seat that follows `tool` sees them: the whole lesson; for each
/// master the time in which its authority over the tool is at least `options.authority`; the time in which no master
/// has as much, if authority is recorded; the phases of the scene. At a threshold of 0.5 or less, two masters may hold
/// a tool at the same time, and both get that time.
[[nodiscard]] std::vector<Part> parts_of(const Lesson& lesson, const LessonGrid& grid, std::size_t tool,
                                         const ScoreOptions& options);

/// Authority of a master over a tool in one row, NaN if unknown.
[[nodiscard]] double authority_of(const Lesson& lesson, std::size_t master, std::size_t tool, std::size_t row) noexcept;

}  // namespace tandem::netsim::score
