#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/drivers/falcon/falcon_driver.h"
#include "hal/drivers/falcon/falcon_ftdi.h"
#include "tests/hal/emulation/devices/falcon_model.h"
#include "tests/hal/emulation/devices/usb_model_pipe.h"

namespace tandem::hal::falcon {

/// Observer of a bring-up that records the messages to the user and cancels after a number of checks.
struct Watcher final : BringUp {
  void progress(std::string_view step, double fraction) override { steps.emplace_back(std::string(step), fraction); }
  [[nodiscard]] bool cancelled() const noexcept override {
    if (looks_left > 0) --looks_left;
    return looks_left == 0;
  }
  std::vector<std::pair<std::string, double>> steps;
  mutable int looks_left = -1;  ///< remaining checks; 0: cancelled; negative: never
};

/// Returns arbitrary bytes as firmware: the model runs any image of the right size.
inline FalconFirmware some_firmware(std::size_t size = 7324) {
  FalconFirmware firmware{.file = "falcon.bin", .image = {}, .sha256 = std::string(64, 'a')};
  for (std::size_t i = 0; i < size; ++i) firmware.image.push_back(static_cast<std::byte>((i * 37 + i / 61) & 0xFF));
  return firmware;
}

inline FalconSpec calibrated(double counts_per_nm = 10000) {
  FalconSpec spec;
  spec.counts_per_nm = {counts_per_nm, counts_per_nm, counts_per_nm};
  spec.measured = "the model's own";
  return spec;
}

inline emulation::FalconModelSpec ready_model() {
  emulation::FalconModelSpec spec;
  spec.running = spec.homed = true;
  return spec;
}

/// A driver with a pipe to its model, in virtual time.
struct FalconFixture {
  explicit FalconFixture(const emulation::FalconModelSpec& model_spec = {}, const FalconSpec& spec = calibrated(),
                         bool with_firmware = true)
      : model(model_spec),
        clock(model),
        pipe(model, clock, kFalconOut, kFalconIn),
        driver(*FalconDriver::make({"falcon", "1-2"}, pipe, clock,
                                   {spec, with_firmware ? std::optional(some_firmware()) : std::nullopt})) {}

  /// Performs one exchange of the servo, starting on the millisecond.
  std::expected<Exchange, Errc> tick(const ServoCommand& command = {}) {
    const auto result = driver.exchange(command, state);
    next += std::chrono::milliseconds(1);
    if (next < clock.now()) next = clock.now();
    clock.wait_until(next);
    return result;
  }
  void begin() { next = clock.now(); }
  /// Pulls the grip out and pushes it in while requesting homing.
  void home() {
    begin();
    for (const double y : {-0.06, 0.03, 0.0}) {
      for (int i = 0; i < 300; ++i) {
        model.mechanics().set_pull({.k = 300, .b = 10, .m = 0.2, .x = Vec3(0, y, 0)});
        (void)tick({.homing = true});
      }
    }
  }

  emulation::FalconModel model;
  emulation::ModelClock clock;
  emulation::UsbModelPipe pipe;
  FalconDriver driver;
  State state;
  Time next{};
};

}  // namespace tandem::hal::falcon
