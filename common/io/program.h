#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::io {

/// Runs a program from its command line: parses it and executes the chosen action. Usage errors end with exit code 2;
/// an unknown command is reported with its nearest match. Unexpected exceptions end with 1.
/// @param action  set by the chosen subcommand; its result is the exit code
[[nodiscard]] int run_program(CLI::App& app, const std::function<int()>& action, int argc, char** argv);

}  // namespace tandem::io
