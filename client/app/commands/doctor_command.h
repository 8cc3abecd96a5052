#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `doctor`, which checks attached devices, and sets `action` when it was chosen.
void add_doctor_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
