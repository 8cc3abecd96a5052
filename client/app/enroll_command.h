#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::client {

/// Adds `enroll`, which sets `action` when it was chosen.
void add_enroll_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
