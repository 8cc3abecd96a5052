#pragma once

#include <string>

#include "proto/rpc/rpc_messages.h"
#include "proto/text/seat_setup.h"

/// Stiffness of the one spring of a seat that acts on its device: k_c of a master, k_s of a SLAVE seat. A device that
/// cannot render the stiffness of the scene gets a softer spring. Server and client use this same code: the server
/// sends the stiffness, and the client uses at most what its device allows.
namespace tandem::setup {

/// @return largest stiffness for this device [N/m]; infinity if the device renders no force or the scene sets
/// unsafe_gains
[[nodiscard]] double stiffness_for(const SeatSetup& setup, const rpc::DeviceFacts& device) noexcept;

/// Returns the same setup with its spring limited to the stiffness that the device renders.
[[nodiscard]] SeatSetup with_limited_stiffness(SeatSetup setup, const rpc::DeviceFacts& device);

/// Returns the message for users about a softened spring, with cause and numbers; empty where the device renders the
/// stiffness of the scene.
/// @param setup  as `with_limited_stiffness` returned it
[[nodiscard]] std::string softened_text(const SeatSetup& setup, const rpc::DeviceFacts& device);

/// Returns the simulated device of seat `seat`, as the server knows it.
[[nodiscard]] rpc::DeviceFacts simulated_device(const SceneSpec& scene, std::size_t seat);

/// Returns, for `--check`, one line for each seat whose simulated device gets a softer spring than the scene states:
/// key, granted and stated stiffness [N/m], and the reason. Empty: each seat gets the stiffness of the scene. A real
/// device declares its properties only at the join, so its stiffness cannot be known here.
[[nodiscard]] std::string granted_listing(const SceneSpec& scene);

/// Returns the device properties that the server uses. A simulated device described by the scene declares none itself,
/// because the client does not know the description before joining.
[[nodiscard]] rpc::DeviceFacts with_declared_properties(rpc::DeviceFacts device,
                                                        const SimDeviceSpec& described) noexcept;

}  // namespace tandem::setup
