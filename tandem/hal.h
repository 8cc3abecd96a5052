#pragma once

#include "common/base/axes.h"
#include "common/base/command_lifetime.h"
#include "common/base/time.h"
#include "hal/core/device.h"
#include "hal/core/driver.h"
#include "hal/core/driver_guard.h"
#include "hal/core/port_map.h"
#include "hal/core/servo_core.h"
#include "hal/io/device_thread.h"
#include "hal/io/open_sim_device.h"
#include "hal/io/sim_servo.h"
#include "hal/sim/sim_device.h"
#include "proto/spec/scene_spec.h"

/// @file
/// Haptic devices. CMake target `Tandem::hal`; depends on Eigen and threads.
///
/// | part | classes |
/// |---|---|
/// | a device with its own servo thread | tandem::hal::Device, tandem::hal::ServoClient |
/// | readings, commands, capabilities | tandem::hal::State, tandem::hal::Command, tandem::hal::DeviceCaps |
/// | a driver of one kind of hardware | tandem::hal::Driver, run by tandem::hal::ServoCore and DeviceThread |
/// | a device whose time the caller advances | tandem::hal::SteppedDevice, run live by tandem::hal::SimServo |
/// | simulated Touch or single axis with a hand | tandem::hal::SimDevice, tandem::hal::open_sim_device |
/// | joints of a device, axes of a port | tandem::hal::PortMap |
///
/// Frame of every device: right-handed, x right, y away from the user, z up. Units are SI. Example of a device written
/// by hand: tests/examples/01_device.cpp.
namespace tandem::hal {

using sim::GroundTruth;
using sim::SimDevice;
using sim::SimSetup;

}  // namespace tandem::hal
