#pragma once

#include <string>
#include <vector>

#include "netsim/quality/quality_text.h"
#include "server/report/report.h"

namespace tandem::netsim {

/// Returns the report of a run as JSON, with every seat's network quality beside its link, and the notes.
/// @param scores  main scores as JSON (netsim/score/score_output.h); empty: the report has none
[[nodiscard]] std::string run_json(const server::RunReport& report, const std::vector<NamedLink>& links,
                                   const std::vector<std::string>& notes, bool interrupted,
                                   const std::string& scores = {});

}  // namespace tandem::netsim
