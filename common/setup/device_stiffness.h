#pragma once

#include <string>

#include "proto/control_messages.h"
#include "proto/seat_setup.h"

/// The one spring of a seat that meets its device: k_c of a master, k_s of a SLAVE seat. A device that cannot render what the scene asks for
/// gets a softer one. Server and client reckon by the same lines: the server tells the stiffness, the client takes no more than its device allows.
namespace tandem::setup {

/// @return largest stiffness for this device [N/m]; infinity where no force comes of it, or the scene says unsafe_gains
[[nodiscard]] double stiffness_for(const SeatSetup& setup, const control::DeviceFacts& device) noexcept;

/// The same setup, its spring no stiffer than the device renders.
[[nodiscard]] SeatSetup softened(SeatSetup setup, const control::DeviceFacts& device);

/// What a person is told of a softened spring, with cause and numbers; empty where the device renders what the scene asks for.
/// @param setup  as `softened` gave it
[[nodiscard]] std::string softened_words(const SeatSetup& setup, const control::DeviceFacts& device);

/// What the server takes a device for: one that the scene itself describes tells nothing before it is told which it is to be.
[[nodiscard]] control::DeviceFacts completed(control::DeviceFacts device, const SimDeviceSpec& described) noexcept;

}  // namespace tandem::setup
