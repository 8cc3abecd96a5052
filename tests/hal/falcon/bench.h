#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/falcon/falcon_driver.h"
#include "hal/falcon/falcon_line.h"
#include "hal/wire/falcon_model.h"
#include "hal/wire/usb_model_pipe.h"

namespace tandem::hal::falcon {

/// Takes what a person would be shown; cancels after a number of looks.
struct Watcher final : BringUp {
  void progress(std::string_view step, double fraction) override { steps.emplace_back(std::string(step), fraction); }
  [[nodiscard]] bool cancelled() const noexcept override {
    if (looks_left > 0) --looks_left;
    return looks_left == 0;
  }
  std::vector<std::pair<std::string, double>> steps;
  mutable int looks_left = -1;  ///< 0: cancelled; negative: never
};

/// Bytes that are nobody's firmware: the model runs any image of the right size.
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

inline wire::FalconModelSpec ready_model() {
  wire::FalconModelSpec spec;
  spec.running = spec.homed = true;
  return spec;
}

/// A driver on a pipe into its model, in virtual time.
struct Bench {
  explicit Bench(const wire::FalconModelSpec& model_spec = {}, const FalconSpec& spec = calibrated(),
                 bool with_firmware = true)
      : model(model_spec),
        clock(model),
        pipe(model, clock, kFalconOut, kFalconIn),
        driver(*FalconDriver::make({"falcon", "1-2"}, pipe, clock,
                                   {spec, with_firmware ? std::optional(some_firmware()) : std::nullopt})) {}

  /// One exchange of the servo, beginning on the millisecond.
  std::expected<Exchange, Errc> tick(const Orders& orders = {}) {
    const auto result = driver.exchange(orders, state);
    next += std::chrono::milliseconds(1);
    if (next < clock.now()) next = clock.now();
    clock.wait_until(next);
    return result;
  }
  void begin() { next = clock.now(); }
  /// Pulls the grip out and pushes it in, asking for homing all the while.
  void home() {
    begin();
    for (const double y : {-0.06, 0.03, 0.0}) {
      for (int i = 0; i < 300; ++i) {
        model.mechanics().set_pull({.k = 300, .b = 10, .m = 0.2, .x = Vec3(0, y, 0)});
        (void)tick({.homing = true});
      }
    }
  }

  wire::FalconModel model;
  wire::ModelClock clock;
  wire::UsbModelPipe pipe;
  FalconDriver driver;
  State state;
  Time next{};
};

}  // namespace tandem::hal::falcon
