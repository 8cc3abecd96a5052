#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

/// Commands that repeat a run, as the report prints them: they can be typed as they stand.
namespace tandem::netsim::demo {

/// How the programs in `folder` are named by a person who stands in `here`: a path below `here`, nothing where the shell
/// finds them (PATH), otherwise the whole path; ends with a slash unless empty.
[[nodiscard]] std::string program_prefix(const std::filesystem::path& folder, const std::filesystem::path& here,
                                         const std::string& search_path);

/// Options of `tandem-netsim proxy` (and `run`, for the bad network) that make the network of a setting.
[[nodiscard]] std::vector<std::string> impairment_options(Setting setting);

/// In virtual time: one command.
[[nodiscard]] std::vector<std::string> virtual_commands(const RunPlan& plan, const std::string& prefix);

/// In real time: server, network, trainer, trainee, each for a terminal of its own, in this order. The ports are fixed.
[[nodiscard]] std::vector<std::string> real_commands(const RunPlan& plan, const std::string& prefix);

}  // namespace tandem::netsim::demo
