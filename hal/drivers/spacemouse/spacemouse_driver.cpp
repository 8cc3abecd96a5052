#include "hal/drivers/spacemouse/spacemouse_driver.h"

#include <algorithm>
#include <utility>

namespace tandem::hal::spacemouse {
namespace {

constexpr int kReportsMax = 80;  ///< reports read per exchange; a hidraw queue holds 64

DeviceCaps puck_caps() {
  DeviceCaps caps;
  caps.joints = 6;
  caps.tip_axes = 3;
  caps.prismatic = true;
  caps.input = InputKind::kRate;
  caps.timing = Timing::kFreeRunning;
  caps.homing = Homing::kNone;
  caps.buttons = 32;
  caps.leds = 1;
  return caps;
}

}  // namespace

SpaceMouseDriver::SpaceMouseDriver(DeviceId id, HidPipe& pipe, Clock& clock, const SpaceMouseSpec& scaling,
                                   const SpaceMouseAxes& axes)
    : id_(std::move(id)), caps_(puck_caps()), pipe_(pipe), clock_(clock), motion_(scaling, axes) {}

Result<> SpaceMouseDriver::bring_up(BringUp& watcher) {
  watcher.progress("emptying the queue of the SpaceMouse", 0.0);
  lit_.reset();
  light_commanded_ = false;
  // Some units ignore "off" until they have received "on" once.
  for (const bool emptied : {false, true}) {
    const auto ok = emptied ? light(true) : take_reports();
    if (!ok) {
      return std::unexpected(
          DeviceError{ok.error(), std::string("the SpaceMouse stopped answering: ") + to_string(ok.error())});
    }
  }
  motion_.reset();
  counts_ = {};
  buttons_ = 0;
  watcher.progress("emptying the queue of the SpaceMouse", 1.0);
  return {};
}

std::expected<Exchange, Errc> SpaceMouseDriver::exchange(const ServoCommand& command, State& state) noexcept {
  if (const auto ok = take_reports(); !ok) return std::unexpected(ok.error());
  light_commanded_ = light_commanded_ || command.leds != 0;
  if (light_commanded_) {
    if (const auto ok = light((command.leds & 1u) != 0); !ok) return std::unexpected(ok.error());
  }
  const Time now = clock_.now();
  const Vec3 velocity = motion_.velocity(now), turning = motion_.angular_velocity(now);
  state.seq = ++readings_;
  state.echo_command = command.seq;
  state.sampled_at = now;
  state.q = {};
  state.tau_out = {};
  state.x.setZero();
  state.f_out.setZero();
  state.dx = velocity;
  state.J.setZero();
  state.J.leftCols<3>().setIdentity();
  for (std::size_t i = 0; i < 3; ++i) {
    state.dq[i] = velocity[static_cast<int>(i)];
    state.dq[3 + i] = turning[static_cast<int>(i)];
  }
  std::ranges::copy(counts_, state.raw.begin());
  state.buttons = buttons_;
  state.battery_percent = battery_;
  state.stale = motion_.stale(now);
  state.resynced = false;
  state.homed = true;
  state.saturated = std::any_of(command.effort.begin(), command.effort.end(), [](double e) { return e != 0.0; });
  return Exchange::kFresh;
}

std::expected<void, Errc> SpaceMouseDriver::take_reports() noexcept {
  std::array<std::byte, kSpaceMouseReportMax> bytes;
  for (int i = 0; i < kReportsMax; ++i) {
    const Moved moved = pipe_.read(bytes, Duration{0});
    if (!moved) return std::unexpected(moved.error());
    if (*moved == 0) return {};
    if (const auto report = parse_spacemouse_report(std::span(bytes).first(std::min(*moved, bytes.size())))) {
      note(*report, clock_.now());
    } else {
      ++odd_reports_;
    }
  }
  return {};
}

void SpaceMouseDriver::note(const SpaceMouseReport& report, Time at) noexcept {
  if (report.translation) {
    motion_.update_translation(at, *report.translation);
    std::ranges::copy(*report.translation, counts_.begin());
  }
  if (report.rotation) {
    motion_.update_rotation(at, *report.rotation);
    std::ranges::copy(*report.rotation, counts_.begin() + 3);
  }
  if (report.buttons) buttons_ = *report.buttons;
  if (report.battery_percent) battery_ = report.battery_percent;
}

/// Switches the light. Some products have none, so only kUnplugged counts as an error.
std::expected<void, Errc> SpaceMouseDriver::light(bool on) noexcept {
  if (lit_ == on) return {};
  const auto report = light_report(on);
  const Moved moved = pipe_.write(report);
  if (!moved && moved.error() == Errc::kUnplugged) return std::unexpected(Errc::kUnplugged);
  lit_ = on;
  return {};
}

}  // namespace tandem::hal::spacemouse
