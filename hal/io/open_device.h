#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hal/device.h"
#include "hal/sim/sim_device.h"
#include "proto/scene_spec.h"

namespace tandem::hal {

/// A simulated device that somebody else moves through time.
struct OpenedSim {
  DeviceId id;
  std::unique_ptr<sim::SimDevice> device;
  std::string note;  ///< for a person: hand, recording, factor applied to it
};

/// The same with a thread of its own. `sim` lives as long as `device`; use only what it declares thread-safe.
struct LiveSim {
  std::unique_ptr<Device> device;
  sim::SimDevice* sim = nullptr;
  std::string note;
};

/// Opens the device a person named with `--device`:
///   sim                                        the seat's own device and hand
///   sim:hand=NAME                              none leader relaxed resting letting_go tremor keyboard
///   sim:keyboard                               the same as hand=keyboard
///   sim:motion=FILE.csv[,columns=P][,rec=N][,scale=auto|S][,axes=+x+y+z][,end=hold|loop]
///   sim:model=touch|linear[,...]               instead of the seat's device model
/// @param base, hand, environment  what the scene says of the seat; another hand than the scene's gets its model's
/// impedance, and a hand that a person moves (keyboard, recording) also none of the scene's script: it is never relaxed by it
/// @param start                    `State::sampled_at` of the first reading
/// Error: names the wrong word, the nearest valid one and all valid ones; or what is wrong with the recording.
[[nodiscard]] Result<OpenedSim> open_stepped(std::string_view spec, const SimDeviceSpec& base, const HandSpec& hand,
                                             const EnvironmentSpec& environment = {}, Time start = {});

/// Gives an opened device a servo thread of its own, not yet started.
[[nodiscard]] LiveSim make_live(OpenedSim opened, Duration period = std::chrono::milliseconds(1));

}  // namespace tandem::hal
