#pragma once

#include <span>
#include <string>
#include <string_view>

#include "netsim/score/lesson_scores.h"

namespace tandem::console {

/// Why a metric of scores at a low rate is not fully trusted.
struct RateDoubt {
  netsim::score::Metric metric{};
  netsim::score::Trust trust{};
  std::string_view reason;
};

/// Returns the main scores of a lesson as members of a JSON object, without braces: `rate_hz`, `from_s`, `to_s`,
/// `metrics` with key, title and unit, `seats` with their parts, and `notes`. Each part has a cell per metric: text,
/// trust and reason as `tandem-netsim score` prints them. A value that is withheld or absent has no text.
/// @param doubts  beyond those of the scores themselves
[[nodiscard]] std::string score_members(const netsim::score::LessonScores& scores,
                                        std::span<const RateDoubt> doubts = {});

}  // namespace tandem::console
