#pragma once

#include <string>

namespace tandem::client {

/// Runs the motor check of `doctor --confirm-motors`. Asks the user for consent, runs MotorCheck on the device, shows
/// the findings and stores the result in the motor registry of the workstation. No force before the user agrees; a
/// signal ends the check with zero force.
/// @param device  device specification of --device, already validated
/// @param state   state directory of the registry, as given by --state
/// @return 0: all motors are right and the result is on disk; 1: otherwise; 2: this device has nothing to confirm
int confirm_motors(const std::string& device, const std::string& state);

}  // namespace tandem::client
