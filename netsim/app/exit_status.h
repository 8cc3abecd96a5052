#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace tandem::netsim {

/// Prints the problems of a command's result files to standard error.
/// @param problems  of io::OutputFile::close, one per file; empty: every byte was written
/// @param good      whether the results themselves are good
/// @return io::kExitDone if the results are good and completely written, else io::kExitTrouble
[[nodiscard]] int exit_status(std::string_view command, std::initializer_list<std::string> problems, bool good);

}  // namespace tandem::netsim
