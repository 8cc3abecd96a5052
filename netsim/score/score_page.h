#pragma once

#include <string>

#include "netsim/score/score_output.h"

namespace tandem::netsim::score {

/// Report for a learner as one self-contained HTML page: the last lesson of `result` from the learner's seat
/// (ScoreResult::seat), with path, force, authority, events, scores in plain words, links, evaluators' notes and
/// sheets. It prints on A4. All texts of the recording are escaped.
/// @param lesson  that lesson
[[nodiscard]] std::string score_page(const Lesson& lesson, const ScoreResult& result, const std::string& version);

}  // namespace tandem::netsim::score
