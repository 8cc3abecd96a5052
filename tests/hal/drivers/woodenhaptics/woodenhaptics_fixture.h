#pragma once

#include <memory>

#include "hal/drivers/woodenhaptics/woodenhaptics_driver.h"
#include "tests/hal/drivers/woodenhaptics/mechanisms.h"
#include "tests/hal/emulation/devices/hid_model_pipe.h"
#include "tests/hal/emulation/devices/woodenhaptics_model.h"

namespace tandem::test {

/// A driver connected to a board model in virtual time; the arm starts in its calibration pose.
struct WoodenHapticsFixture {
  explicit WoodenHapticsFixture(hal::woodenhaptics::WoodenHapticsOptions options = {.spec = wooden_2015(),
                                                                                    .enable_motors = true},
                                hal::emulation::WoodenHapticsModelParams params = {})
      : model(at_calibration(options.spec, params)),
        time(model),
        pipe(model, time),
        driver({"woodenhaptics", "0001"}, pipe, time, options) {
    model.place(model.tip());
  }
  static hal::emulation::WoodenHapticsModelParams at_calibration(const WoodenHapticsSpec& spec,
                                                                 hal::emulation::WoodenHapticsModelParams params) {
    params.spec = spec;
    const hal::woodenhaptics::Kinematics k(spec);
    const auto& c = spec.calibration_counts;
    params.start = k.tip(k.angles({c[0], c[1], c[2]}));
    return params;
  }
  hal::Result<> bring_up() {
    QuietBringUp watcher;
    return driver.bring_up(watcher);
  }
  /// Performs one exchange at the next whole millisecond.
  std::expected<hal::Exchange, hal::Errc> step(const hal::Vec3& effort = hal::Vec3::Zero(), bool homing = false) {
    next = std::max(next + std::chrono::milliseconds{1}, time.now());
    time.wait_until(next);
    hal::ServoCommand command{.seq = ++seq, .effort = {effort[0], effort[1], effort[2]}, .homing = homing};
    return driver.exchange(command, state);
  }
  /// Homes the board by its calibration button, as the user does.
  bool home() {
    (void)step();
    model.press_calibration();
    for (int i = 0; i < 20 && !driver.homed(); ++i) (void)step();
    return driver.homed();
  }
  /// Moves the tip along a straight line at `speed` [m/s].
  bool walk_to(const hal::Vec3& x, double speed = 0.3) {
    const hal::Vec3 from = model.tip();
    const int steps = static_cast<int>((x - from).norm() / (speed * 1e-3)) + 1;
    for (int i = 1; i <= steps; ++i) {
      if (!model.place(from + (x - from) * i / steps) || !step()) return false;
    }
    return true;
  }

  hal::emulation::WoodenHapticsModel model;
  HidModelClock time;
  HidModelPipe pipe;
  hal::woodenhaptics::WoodenHapticsDriver driver;
  hal::State state;
  Time next{};
  std::uint64_t seq = 0;
};

}  // namespace tandem::test
