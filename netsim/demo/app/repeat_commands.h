#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

/// Commands that repeat a run, as printed in the report; a user can paste them into a shell.
namespace tandem::netsim::demo {

/// Returns the prefix of the programs in `folder` for a shell in `here`. It is a path below `here`, nothing if the
/// shell finds them (PATH), otherwise the absolute path. It ends with a slash unless empty.
[[nodiscard]] std::string program_prefix(const std::filesystem::path& folder, const std::filesystem::path& here,
                                         const std::string& search_path);

/// Returns the options of `tandem-netsim proxy` (and `run`, for the bad network) that produce the network of a setting.
[[nodiscard]] std::vector<std::string> impairment_options(Setting setting);

/// Returns the command of a run in virtual time.
[[nodiscard]] std::vector<std::string> virtual_commands(const RunPlan& plan, const std::string& prefix);

/// Returns the commands of a run in real time: server, network, trainer, trainee, in this order. Each needs its own
/// terminal. The ports are fixed.
[[nodiscard]] std::vector<std::string> real_commands(const RunPlan& plan, const std::string& prefix);

}  // namespace tandem::netsim::demo
