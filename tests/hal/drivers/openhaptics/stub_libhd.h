#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// State behind the libHD.so for tests: devices by name, an error stack, a scheduler that the test runs cycle by cycle.
/// It checks the rules of the interface (frames, current device, one scheduler) and records violations.
namespace tandem::test {

struct StubDevice {
  std::string name = "Default Device";
  std::array<double, 3> x{}, v{}, force{};  ///< HDAPI frame [mm], [mm/s], [N]
  std::array<std::int32_t, 6> encoders{};
  std::int32_t buttons = 0, sensed = 6, actuated = 3, style = 4;
  std::uint32_t calibration = 0x5000;
  double force_max = 3.3, force_continuous = 0.88;
  std::array<double, 6> heat{0.1, 0.1, 0.1, 0, 0, 0};
  bool tells_heat = true;
  std::array<double, 6> workspace{-160, -120, -70, 160, 120, 70};
  bool initialised = false, unplugged = false, held = false;  ///< held: as after another program's unclean exit
  bool force_enabled = false, force_set = false;
  std::uint32_t init_error = 0;   ///< error of every call, if not 0
  std::uint32_t reset_error = 0;  ///< error of every calibration, if not 0
  std::uint32_t cycle_error = 0;  ///< error raised once, at the end of the next frame
  unsigned touched = 0;           ///< calls with this device as the current one
  unsigned frames = 0, calibrations = 0;
};

struct StubError {
  std::uint32_t code;
  std::int32_t internal;
  std::uint32_t device;
};

struct StubHd {
  std::vector<StubDevice> devices;
  std::vector<StubError> errors;
  std::uint32_t current = 0xffffffff;
  std::uint32_t in_frame = 0xffffffff;
  bool running = false, scheduler_fails = false;
  std::uint32_t (*callback)(void*) = nullptr;
  void* data = nullptr;
  unsigned callbacks = 0;           ///< largest number of callbacks scheduled at a time
  std::vector<std::string> broken;  ///< violated rules

  void reset() { *this = StubHd{}; }
  /// Runs one servo cycle.
  void cycle() {
    if (running && callback != nullptr) callback(data);
  }
};

}  // namespace tandem::test

extern "C" tandem::test::StubHd* stub_hd();
