#pragma once

#include <string>

namespace tandem::client {

/// Asks the person, then gives each motor of a device short pulses, sees whether it pushes the way its file says, tells the person, and
/// keeps the result in the book of the workstation (`doctor --confirm-motors`). No force before the person agreed; a signal ends it
/// with zeros.
/// @param device  the words after --device, already found good
/// @param state   folder of the book, as given by --state
/// @return 0: all motors are right and that is on disk; 1: not so; 2: this device has nothing to confirm
int confirm_motors(const std::string& device, const std::string& state);

}  // namespace tandem::client
