#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::netsim {

/// Adds `feel SCENE`, which measures what hands feel. If the user chooses it, `action` becomes the function to run; its
/// result is the exit code.
void add_feel_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
