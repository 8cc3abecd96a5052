#pragma once

#include <string>

namespace tandem::server {

/// Adds the main scores of a session to its report, computed from its recording as `tandem-netsim score` does: prints
/// them, and puts them into the JSON of the report as `scores`.
/// @param recording  complete file, NAME.mcap; the further files of a long session lie beside it
/// @param report     JSON file of the report, which is replaced; empty: none
/// @param quiet      prints nothing
/// @return the error, empty if none. The report stays as it was then.
[[nodiscard]] std::string add_scores(const std::string& recording, const std::string& report, bool quiet);

}  // namespace tandem::server
