#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/core/pipes.h"

namespace tandem::hal {

/// A cube on three orthogonal rails, over HID, in lock-step: one report of 8 bytes out, one of 8 bytes back.
///   host -> device  int16 x, y, z motor counts; uint8 command (1: set the counters to zero); uint8 0
///   device -> host  int16 x, y, z encoder counts; uint8 buttons; uint8 flags (1: counters were set to zero)
class CubeDriver final : public Driver {
 public:
  CubeDriver(DeviceId id, HidPipe& pipe, Clock& clock) : id_(std::move(id)), pipe_(pipe), clock_(clock) {
    caps_.joints = caps_.tip_axes = 3;
    caps_.prismatic = true;
    caps_.timing = Timing::kLockStep;
    caps_.homing = Homing::kManual;
    for (AxisLimit& axis : caps_.axis) {
      axis = {.peak = 4.0, .continuous = 1.5, .resolution = kMetresPerCount, .from = Provenance::kDatasheet};
    }
    caps_.buttons = 1;
  }

  const DeviceId& id() const noexcept override { return id_; }
  const DeviceCaps& caps() const noexcept override { return caps_; }

  // Anything a start-up needs: firmware, calibration. Here: does it answer at all?
  Result<> bring_up(BringUp& watcher) override {
    State state;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (watcher.cancelled()) return std::unexpected(DeviceError{Errc::kBadState, "cube: start-up was interrupted"});
      watcher.progress("waiting for the cube", double(attempt) / kAttempts);
      const auto how = exchange({}, state);
      if (how && *how != Exchange::kNothing) return {};
      if (!how && how.error() == Errc::kUnplugged) {
        return std::unexpected(DeviceError{Errc::kUnplugged, "cube: was unplugged while it started"});
      }
    }
    return std::unexpected(DeviceError{Errc::kTimeout, "cube: is there but does not answer; unplug it and plug it in"});
  }

  std::expected<Exchange, Errc> exchange(const ServoCommand& orders, State& state) noexcept override {
    std::array<std::byte, kReport> out{}, in{};
    Vec3 sent = Vec3::Zero();
    bool saturated = false;
    for (std::size_t i = 0; i < 3; ++i) {
      // Clamp before the conversion: a value that wraps around pushes the other way.
      const double wanted = std::isfinite(orders.effort[i]) ? orders.effort[i] * kCountsPerNewton : 0.0;
      const double counts = std::round(std::clamp(wanted, -kCountsMax, kCountsMax));
      saturated = saturated || std::abs(wanted) > kCountsMax;
      put(out, 2 * i, static_cast<std::int16_t>(counts));
      sent[static_cast<Eigen::Index>(i)] = counts / kCountsPerNewton;
    }
    out[6] = std::byte{orders.homing ? std::uint8_t{1} : std::uint8_t{0}};
    if (const auto written = pipe_.write(out); !written) return std::unexpected(written.error());
    const auto got = pipe_.read(in, kTimeout);
    if (!got) return std::unexpected(got.error());
    if (*got == 0) return Exchange::kNothing;
    if (*got != kReport) return std::unexpected(Errc::kFraming);

    const Time now = clock_.now();
    const double dt = readings_ > 0 ? std::max(seconds(now - read_at_), 1e-4) : 1.0;
    const Vec3 before = x_;
    for (std::size_t i = 0; i < 3; ++i) {
      state.raw[i] = get(in, 2 * i);
      x_[static_cast<Eigen::Index>(i)] = kMetresPerCount * state.raw[i];
    }
    state.x = x_;
    state.dx = readings_ > 0 ? Vec3{(x_ - before) / dt} : Vec3{Vec3::Zero()};
    for (std::size_t i = 0; i < 3; ++i) {
      state.q[i] = state.x[static_cast<Eigen::Index>(i)];
      state.dq[i] = state.dx[static_cast<Eigen::Index>(i)];
      state.tau_out[i] = acting_[static_cast<Eigen::Index>(i)];  // until this reading the order before it acted
    }
    state.J.leftCols<3>().setIdentity();
    state.f_out = acting_;
    state.echo_command = acting_seq_;
    state.seq = ++readings_;
    state.sampled_at = read_at_ = now;
    state.buttons = std::to_integer<unsigned>(in[6]);
    state.homed = (std::to_integer<unsigned>(in[7]) & 1U) != 0;
    state.saturated = saturated;
    acting_ = sent;
    acting_seq_ = orders.seq;
    return Exchange::kFresh;
  }

  void send_zeros() noexcept override {
    State unused;
    for (int i = 0; i < 3; ++i) {
      if (const auto how = exchange({}, unused); !how && how.error() == Errc::kUnplugged) return;
    }
  }

 private:
  static constexpr std::size_t kReport = 8;
  static constexpr double kMetresPerCount = 1e-5, kCountsPerNewton = 1000, kCountsMax = 32000;
  static constexpr Duration kTimeout = std::chrono::milliseconds(1);
  static constexpr int kAttempts = 10;

  static void put(std::span<std::byte, kReport> report, std::size_t at, std::int16_t value) noexcept {
    report[at] = static_cast<std::byte>(static_cast<std::uint16_t>(value) & 0xff);
    report[at + 1] = static_cast<std::byte>(static_cast<std::uint16_t>(value) >> 8);
  }
  static std::int16_t get(std::span<const std::byte, kReport> report, std::size_t at) noexcept {
    return static_cast<std::int16_t>(std::to_integer<unsigned>(report[at]) | std::to_integer<unsigned>(report[at + 1])
                                                                                 << 8);
  }

  DeviceId id_;
  HidPipe& pipe_;
  Clock& clock_;
  DeviceCaps caps_;
  std::uint64_t readings_ = 0, acting_seq_ = 0;
  Time read_at_{};
  Vec3 x_ = Vec3::Zero(), acting_ = Vec3::Zero();
};

}  // namespace tandem::hal
