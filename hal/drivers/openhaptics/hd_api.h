#pragma once

#include <cstdint>

/// The calls of the vendor's HDAPI that Tandem uses, with its C interface on 64-bit Linux.
/// The declarations are Tandem's own, from published facts. This tree contains nothing of the vendor and builds without
/// it.
namespace tandem::hal::openhaptics {

using Handle = std::uint32_t;
inline constexpr Handle kInvalidHandle = 0xffffffff;

/// Error record, returned by value: three words.
struct ErrorInfo {
  std::uint32_t code = 0;  ///< 0: no error
  std::int32_t internal = 0;
  Handle device = kInvalidHandle;
};
static_assert(sizeof(ErrorInfo) == 12);

/// @return 0: done, 1: call again in the next cycle
using Callback = std::uint32_t (*)(void* data);

struct Api {
  Handle (*init_device)(const char* name) = nullptr;
  void (*disable_device)(Handle) = nullptr;
  void (*make_current)(Handle) = nullptr;
  void (*begin_frame)(Handle) = nullptr;
  void (*end_frame)(Handle) = nullptr;
  ErrorInfo (*get_error)() = nullptr;  ///< removes the newest error from the stack and returns it
  const char* (*error_text)(std::uint32_t code) = nullptr;
  void (*enable)(std::uint32_t what) = nullptr;
  void (*get_int)(std::uint32_t what, std::int32_t* into) = nullptr;
  void (*get_double)(std::uint32_t what, double* into) = nullptr;
  void (*set_double)(std::uint32_t what, const double* values) = nullptr;
  const char* (*get_string)(std::uint32_t what) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  void (*set_scheduler_rate)(unsigned long hz) = nullptr;
  unsigned long (*schedule)(Callback, void* data, std::uint16_t priority) = nullptr;  ///< hdScheduleAsynchronous
  void (*unschedule)(unsigned long) = nullptr;
  std::uint32_t (*check_calibration)() = nullptr;
  void (*update_calibration)(std::uint32_t style) = nullptr;
};

namespace id {
inline constexpr std::uint32_t kButtons = 0x2000, kEncoders = 0x2010, kPosition = 0x2050, kVelocity = 0x2051,
                               kVersion = 0x2500, kModel = 0x2501, kSerial = 0x2504, kWorkspaceUsable = 0x2551,
                               kInputDof = 0x2553, kOutputDof = 0x2554, kCalibrationStyle = 0x2555, kForceMax = 0x2603,
                               kForceContinuous = 0x2604,
                               kMotorTemperature = 0x2605,  // [0, 1] of each motor, predicted by the library; up to six
    kForce = 0x2700;
inline constexpr std::uint32_t kForceOutput = 0x4000, kForceClamping = 0x4001, kForceRamping = 0x4002,
                               kForceLimit = 0x4003;
inline constexpr std::uint32_t kCalibrationOk = 0x5000, kCalibrationUpdate = 0x5001, kCalibrationManual = 0x5002;
inline constexpr std::uint32_t kStyleEncoderReset = 1, kStyleAuto = 2, kStyleInkwell = 4;
}  // namespace id

namespace error {
inline constexpr std::uint32_t kUnknownHandle = 0x0104, kWarmMotors = 0x0200, kForceError = 0x0204,
                               kDeviceFault = 0x0300, kAlreadyInitiated = 0x0301, kCommunication = 0x0302,
                               kCommunicationConfig = 0x0303, kLicence = 0x0600;
}  // namespace error

/// Converts positions and forces from HDAPI (x right, y up, z towards the user) to HAL (x right, y away, z up). Units
/// are unchanged.
inline void to_hal(const double hd[3], double hal[3]) noexcept {
  hal[0] = hd[0];
  hal[1] = -hd[2];
  hal[2] = hd[1];
}
inline void to_hd(const double hal[3], double hd[3]) noexcept {
  hd[0] = hal[0];
  hd[1] = hal[2];
  hd[2] = -hal[1];
}

}  // namespace tandem::hal::openhaptics
