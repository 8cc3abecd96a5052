#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/drivers/falcon/falcon_kinematics.h"
#include "hal/drivers/woodenhaptics/kinematics.h"
#include "tests/hal/emulation/devices/falcon_model.h"
#include "tests/hal/emulation/devices/woodenhaptics_model.h"

/// Recorder at a device's plug: the commands to its motors, frame by frame, and the work they did on the device at the
/// joints and at the tip.
/// It is placed in front of a device model and forwards everything.
namespace tandem::test {

/// Slices of the device's time in which its motion is taken as straight.
inline constexpr Duration kTapSlice = std::chrono::microseconds{250};

struct TrafficAccount {
  std::vector<hal::Vec3> told;  ///< joint effort of every received command [N m]
  double at_joints = 0;         ///< sum of tau . dq [J]
  double at_tip = 0;            ///< sum of F . dx, F = J^-T tau before and after [J]
  double power_error_max = 0;   ///< largest |F . v - tau . qdot| / (|F| |v|)
  double force_max = 0;         ///< largest |F| [N]

  /// Records a motion with `tau` held; `J` before and after.
  void moved(const hal::Vec3& tau, const hal::Vec3& dq, const hal::Vec3& dx, const Eigen::Matrix3d& before,
             const Eigen::Matrix3d& after, const hal::Vec3& v) {
    const hal::Vec3 from = before.transpose().lu().solve(tau), to = after.transpose().lu().solve(tau);
    at_joints += tau.dot(dq);
    at_tip += 0.5 * (from + to).dot(dx);
    force_max = std::max(force_max, to.norm());
    if (const double scale = to.norm() * v.norm(); scale > 0) {
      const hal::Vec3 rates = after.lu().solve(v);
      power_error_max = std::max(power_error_max, std::abs(to.dot(v) - tau.dot(rates)) / scale);
    }
  }
};

class FalconTrafficRecorder final : public hal::emulation::EmulatedUsbDevice {
 public:
  /// @param counts_per_nm  true scale of the motors behind the plug
  FalconTrafficRecorder(hal::emulation::FalconModel& model, double counts_per_nm)
      : model_(model), counts_per_nm_(counts_per_nm) {}
  [[nodiscard]] const TrafficAccount& account() const { return account_; }

  void advance(Duration dt) noexcept override {
    for (Duration left = dt; left > Duration{0}; left -= std::min(left, kTapSlice)) {
      const auto& m = model_.mechanics();
      const hal::Vec3 q = m.theta(), x = m.tip();
      const hal::Vec3 tau = effort(model_.order().motor);
      model_.advance(std::min(left, kTapSlice));
      const auto before = hal::falcon_pose_at(x), after = hal::falcon_pose_at(m.tip());
      if (before && after) account_.moved(tau, m.theta() - q, m.tip() - x, before->J, after->J, m.velocity());
    }
  }
  /// Sixteen bytes '<' ... '>': three motors of four nibbles each, lowest first, 0x41 added; positive pulls a thigh in.
  hal::emulation::TransferResult bulk_out(std::uint8_t ep, std::span<const std::byte> b) noexcept override {
    const auto byte = [&](std::size_t i) { return std::to_integer<unsigned>(b[i]); };
    if (b.size() == 16 && byte(0) == '<' && byte(15) == '>') {
      std::array<std::int16_t, 3> motor{};
      for (std::size_t i = 0; i < 12; ++i) {
        const unsigned so_far = static_cast<std::uint16_t>(motor[i / 4]);
        motor[i / 4] = static_cast<std::int16_t>(so_far | ((byte(1 + i) - 0x41) & 15u) << (4 * (i % 4)));
      }
      account_.told.push_back(effort(motor));
    }
    return model_.bulk_out(ep, b);
  }

  void unplug() noexcept override { model_.unplug(); }
  void plug_in() noexcept override { model_.plug_in(); }
  [[nodiscard]] bool plugged_in() const noexcept override { return model_.plugged_in(); }
  [[nodiscard]] std::span<const std::byte> device_descriptor() const noexcept override {
    return model_.device_descriptor();
  }
  [[nodiscard]] std::span<const std::byte> config_descriptor() const noexcept override {
    return model_.config_descriptor();
  }
  [[nodiscard]] std::string_view string(std::uint8_t index) const noexcept override { return model_.string(index); }
  hal::emulation::TransferResult control(const hal::emulation::SetupPacket& setup,
                                         std::span<std::byte> data) noexcept override {
    return model_.control(setup, data);
  }
  hal::emulation::TransferResult bulk_in(std::uint8_t ep, std::span<std::byte> into) noexcept override {
    return model_.bulk_in(ep, into);
  }

 private:
  [[nodiscard]] hal::Vec3 effort(const std::array<std::int16_t, 3>& motor) const {
    return hal::Vec3(-motor[0], -motor[1], -motor[2]) / counts_per_nm_;
  }
  hal::emulation::FalconModel& model_;
  double counts_per_nm_;
  TrafficAccount account_;
};

class BoardTrafficRecorder final : public hal::emulation::EmulatedHidDevice {
 public:
  BoardTrafficRecorder(hal::emulation::WoodenHapticsModel& model, const WoodenHapticsSpec& spec)
      : model_(model), kinematics_(spec) {}
  [[nodiscard]] const TrafficAccount& account() const { return account_; }

  void advance(Duration dt) noexcept override {
    for (Duration left = dt; left > Duration{0}; left -= std::min(left, kTapSlice)) {
      const hal::Vec3 q = model_.q(), x = model_.tip(), tau = model_.motor_effort();
      model_.advance(std::min(left, kTapSlice));
      account_.moved(tau, model_.q() - q, model_.tip() - x, kinematics_.jacobian(q), kinematics_.jacobian(model_.q()),
                     model_.velocity());
    }
  }
  hal::emulation::TransferResult report_out(std::span<const std::byte> report) noexcept override {
    const auto moved = model_.report_out(report);
    account_.told.push_back(model_.motor_effort());
    return moved;
  }

  void unplug() noexcept override { model_.unplug(); }
  void plug_in() noexcept override { model_.plug_in(); }
  [[nodiscard]] bool plugged_in() const noexcept override { return model_.plugged_in(); }
  [[nodiscard]] std::uint16_t vendor_id() const noexcept override { return model_.vendor_id(); }
  [[nodiscard]] std::uint16_t product_id() const noexcept override { return model_.product_id(); }
  [[nodiscard]] std::string_view manufacturer() const noexcept override { return model_.manufacturer(); }
  [[nodiscard]] std::string_view product() const noexcept override { return model_.product(); }
  [[nodiscard]] std::string_view serial() const noexcept override { return model_.serial(); }
  [[nodiscard]] std::span<const std::byte> report_descriptor() const noexcept override {
    return model_.report_descriptor();
  }
  hal::emulation::TransferResult report_in(std::span<std::byte> into) noexcept override {
    return model_.report_in(into);
  }
  hal::emulation::TransferResult feature_set(std::span<const std::byte> report) noexcept override {
    return model_.feature_set(report);
  }
  hal::emulation::TransferResult feature_get(std::span<std::byte> into) noexcept override {
    return model_.feature_get(into);
  }

 private:
  hal::emulation::WoodenHapticsModel& model_;
  hal::woodenhaptics::Kinematics kinematics_;
  TrafficAccount account_;
};

}  // namespace tandem::test
