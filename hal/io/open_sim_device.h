#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "hal/core/device.h"
#include "hal/sim/sim_device.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal {

/// A simulated device whose time the caller advances.
struct OpenedSim {
  DeviceId id;                             ///< identity
  std::unique_ptr<sim::SimDevice> device;  ///< the device
  std::string note;                        ///< text for the user: hand, recording, scale factor applied to it
};

/// A simulated device with its own thread. `sim` is valid as long as `device`; call only its thread-safe functions.
struct LiveSim {
  std::unique_ptr<Device> device;  ///< the device with its thread
  sim::SimDevice* sim = nullptr;   ///< the same device inside its thread
  std::string note;                ///< text for the user
};

/// Reads the motion of a hand from a recording (MCAP): file, name of the seat (empty: the caller's own), the simulated
/// hand that follows it. Error: one line with the file.
using RecordingMotionReader = std::function<std::expected<std::shared_ptr<const sim::RecordedMotion>, std::string>(
    const std::string& file, const std::string& seat, const HandSpec& hand)>;

/// Opens the simulated device named by `--device`:
///   sim                                        the seat's own device and hand
///   sim:hand=NAME                              none leader relaxed resting letting_go tremor keyboard
///   sim:keyboard                               the same as hand=keyboard
///   sim:motion=FILE.csv[,columns=P][,rec=N][,scale=auto|S][,axes=+x+y+z][,end=hold|loop][,middle=zero|keep]
///   sim:motion=FILE.mcap[,seat=NAME]           a hand of a recording; needs `recordings`
///   sim:model=touch|linear[,...]               instead of the seat's device model
///
/// A hand other than the scene's uses the impedance of its own model. A hand moved by a user (keyboard, recording) also
/// ignores the scene's script for that hand.
/// @param spec                     words after `--device`
/// @param base, hand, environment  the seat's settings in the scene
/// @param start                    `State::sampled_at` of the first reading
/// @param recordings               reads recordings; empty: this program cannot
/// Error: names the invalid word, the nearest valid one and all valid ones, or the problem of the recording.
[[nodiscard]] Result<OpenedSim> open_sim_device(std::string_view spec, const SimDeviceSpec& base, const HandSpec& hand,
                                                const EnvironmentSpec& environment = {}, Time start = {},
                                                const RecordingMotionReader& recordings = {});

/// Gives an opened device its own servo thread, not yet started.
[[nodiscard]] LiveSim make_live(OpenedSim opened, Duration period = std::chrono::milliseconds(1));

}  // namespace tandem::hal
