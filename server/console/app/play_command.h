#pragma once

#include "common/io/command_line.h"

namespace tandem::console {

/// Adds the command `play FILE [FILE]`: the page with the player only, without any server.
void add_play_command(const io::Command& root);

}  // namespace tandem::console
