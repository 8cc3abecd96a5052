#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::io {

/// What every program of ours does with its command line: parses it, runs what was chosen, turns mistakes into exit code 2 (also a
/// command that does not exist, with the nearest that does) and an exception that nobody expected into 1.
/// @param action  set by the chosen subcommand; its result is the exit code
[[nodiscard]] int run_program(CLI::App& app, const std::function<int()>& action, int argc, char** argv);

}  // namespace tandem::io
