#include "netsim/score/parts.h"

#include <algorithm>

#include "netsim/score/tracks.h"

namespace tandem::netsim::score {
namespace {

void add_part(std::vector<Part>& parts, Part part) {
  if (std::ranges::find(part.mask, 1) != part.mask.end()) parts.push_back(std::move(part));
}

}  // namespace

double authority_of(const Lesson& lesson, std::size_t master, std::size_t tool, std::size_t row) noexcept {
  if (master < kMastersMax && !lesson.tools[tool].alpha.empty()) return lesson.tools[tool].alpha[row][master];
  const std::vector<double>& own = lesson.seats[master].alpha;
  return own.empty() || first_tool_of(lesson.scene, master) != tool ? kUnknown : own[row];
}

std::vector<Part> parts_of(const Lesson& lesson, const LessonGrid& grid, std::size_t tool,
                           const ScoreOptions& options) {
  const std::size_t n = grid.size();
  std::vector<Part> parts;
  add_part(parts, {Part::Kind::kWhole, "whole", "Whole lesson", std::vector<std::uint8_t>(n, 1)});
  std::vector<std::uint8_t> none(n, 1);
  bool authority_known = false;
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) {
    const SeatSpec& seat = lesson.scene.seats[i];
    if (seat.kind != SeatKind::kMaster) continue;
    std::vector<std::uint8_t> mask(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double alpha = authority_of(lesson, i, tool, grid.row(k));
      authority_known = authority_known || alpha == alpha;
      // Authority adds up to 1 with rounding errors.
      mask[k] = alpha >= options.authority - 1e-9 ? 1 : 0;
      none[k] = mask[k] != 0 ? 0 : none[k];
    }
    add_part(parts, {Part::Kind::kHeldBy, "held:" + seat.name, seat.name + " holds the tool", std::move(mask)});
  }
  if (authority_known)
    add_part(parts, {Part::Kind::kShared, "shared", "No seat holds the tool alone", std::move(none)});
  for (const PhaseSpec& phase : lesson.scene.phases) {
    std::vector<std::uint8_t> mask(n);
    for (std::size_t k = 0; k < n; ++k) mask[k] = grid.time(k) >= phase.from - 1e-9 && grid.time(k) < phase.to - 1e-9;
    add_part(parts, {Part::Kind::kPhase, "phase:" + phase.name, "Phase " + phase.name, std::move(mask)});
  }
  return parts;
}

}  // namespace tandem::netsim::score
