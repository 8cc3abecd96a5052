#include "tests/hal/emulation/devices/woodenhaptics_model.h"

#include <cmath>
#include <limits>

#include "hal/core/port_map.h"

namespace tandem::hal::emulation {
namespace {

constexpr Duration kSubstep = std::chrono::microseconds{250};
constexpr double kReach = 1.4;  ///< distance of the arm's stops, in radii of the workspace

/// Reads bytes independently of the driver's codec on purpose: two implementations of one description.
std::int16_t i16(std::span<const std::byte> b, std::size_t i) noexcept {
  return static_cast<std::int16_t>(std::to_integer<int>(b[2 * i]) + 256 * std::to_integer<int>(b[2 * i + 1]));
}

std::size_t report_length(WoodenProtocol protocol) noexcept {
  switch (protocol) {
    case WoodenProtocol::kV1:
      return 8;
    case WoodenProtocol::kV2:
      return 14;
    case WoodenProtocol::kRaw64:
      return 64;
  }
  return 0;
}

/// Returns a descriptor with vendor page 0xFFAB, usage 0x0200: one input and one output report of `bytes` bytes, no
/// report id.
std::vector<std::byte> descriptor_of(std::size_t bytes) {
  const std::array<unsigned, 26> d{0x06,
                                   0xAB,
                                   0xFF,
                                   0x0A,
                                   0x00,
                                   0x02,
                                   0xA1,
                                   0x01,
                                   0x75,
                                   0x08,
                                   0x15,
                                   0x00,
                                   0x26,
                                   0xFF,
                                   0x00,
                                   0x95,
                                   static_cast<unsigned>(bytes),
                                   0x09,
                                   0x01,
                                   0x81,
                                   0x02,
                                   0x09,
                                   0x02,
                                   0x91,
                                   0x02,
                                   0xC0};
  std::vector<std::byte> out;
  for (const unsigned b : d) out.push_back(static_cast<std::byte>(b));
  return out;
}

}  // namespace

WoodenHapticsModel::WoodenHapticsModel(const WoodenHapticsModelParams& params)
    : params_(params),
      kinematics_(params.spec),
      descriptor_(descriptor_of(report_length(params.spec.protocol))),
      tip_(params.start) {
  if (const auto q = kinematics_.inverse(tip_)) q_ = *q;
  power_up();
}

WoodenHapticsModel::WoodenHapticsModel(const WoodenHapticsModelParams& params, const HandSpec& hand,
                                       std::shared_ptr<const sim::RecordedMotion> motion)
    : WoodenHapticsModel(params) {
  hand_ = std::make_unique<sim::Hand>(hand, params.start, std::move(motion));
}

void WoodenHapticsModel::power_up() noexcept {
  amplifiers_ = false;
  calibration_latched_ = false;
  current_ma_ = {};
  for (std::size_t i = 0; i < 6; ++i) zero_[i] = count(i);
  queue_.clear();
  report_due_ = now_ + params_.answer_after;
}

void WoodenHapticsModel::unplug() noexcept {
  plugged_in_ = false;
  amplifiers_ = false;
  queue_.clear();
  report_due_.reset();
}

void WoodenHapticsModel::plug_in() noexcept {
  plugged_in_ = true;
  power_up();
}

std::uint16_t WoodenHapticsModel::vendor_id() const noexcept {
  return params_.spec.protocol == WoodenProtocol::kRaw64 ? 0x16C0 : 0x1234;
}
std::uint16_t WoodenHapticsModel::product_id() const noexcept {
  return params_.spec.protocol == WoodenProtocol::kRaw64 ? 0x0486 : 0x0006;
}
std::string_view WoodenHapticsModel::manufacturer() const noexcept {
  return params_.spec.protocol == WoodenProtocol::kRaw64 ? "Teensyduino" : "mbed.org";
}
std::string_view WoodenHapticsModel::product() const noexcept {
  return params_.spec.protocol == WoodenProtocol::kRaw64 ? "Teensyduino RawHID" : "HID DEVICE";
}

std::int32_t WoodenHapticsModel::count(std::size_t motor) const noexcept {
  if (motor >= 3) return 0;  // the gimbal never turns
  if (faults.frozen_encoders) return frozen_[motor];
  const int i = static_cast<int>(motor);
  return static_cast<std::int32_t>(std::lround(q_[i] / kinematics_.angle_per_count()[i]));
}

TransferResult WoodenHapticsModel::report_out(std::span<const std::byte> report) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  if (faults.stalled_out) return std::unexpected(TransferStatus::kStall);
  if (report.size() != report_length(params_.spec.protocol)) {
    ++refused_reports_;
    return report.size();  // the bus accepts the report, the firmware ignores it
  }
  HostReport& seen = remembered_[host_reports_++ % kRemembered];
  seen = {now_, {i16(report, 0), i16(report, 1), i16(report, 2)}, false};
  heard_at_ = now_;
  amplifiers_ = true;
  const bool v1 = params_.spec.protocol == WoodenProtocol::kV1;
  if (!v1 && i16(report, 3) == 1) {
    seen.preset = true;
    for (std::size_t i = 0; i < 3; ++i) {
      zero_[i] = count(i) - i16(report, 4 + i);
      zero_[3 + i] = -i16(report, i);
    }
    calibration_latched_ = false;
    current_ma_ = {};
  } else {
    current_ma_ = seen.current_ma;
  }
  if (!v1 && !report_due_) report_due_ = now_ + params_.answer_after + faults.late;
  return report.size();
}

TransferResult WoodenHapticsModel::report_in(std::span<std::byte> into) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  return queue_.pop(into);
}

TransferResult WoodenHapticsModel::feature_set(std::span<const std::byte>) noexcept {
  return std::unexpected(plugged_in_ ? TransferStatus::kStall : TransferStatus::kGone);
}
TransferResult WoodenHapticsModel::feature_get(std::span<std::byte>) noexcept {
  return std::unexpected(plugged_in_ ? TransferStatus::kStall : TransferStatus::kGone);
}

void WoodenHapticsModel::send_report() noexcept {
  if (faults.silent) return;
  if (faults.lost_reports > 0) {
    --faults.lost_reports;
    return;
  }
  std::array<std::byte, 64> bytes{};
  const auto put = [&](std::size_t i, int value) {
    const auto u = static_cast<unsigned>(value) & 0xffffu;
    bytes[2 * i] = static_cast<std::byte>(u % 256);
    bytes[2 * i + 1] = static_cast<std::byte>(u / 256);
  };
  const bool v1 = params_.spec.protocol == WoodenProtocol::kV1;
  for (std::size_t i = 0; i < (v1 ? 3u : 6u); ++i) {
    put(i, count(i) - zero_[i] + (i == 3 && stylus_ ? 10000 : 0));
  }
  if (!v1) put(6, calibration_latched_ ? 1 : 0);
  std::size_t length = report_length(params_.spec.protocol);
  if (faults.odd_reports > 0) {
    --faults.odd_reports;
    length = std::min(faults.odd_length, bytes.size());
  }
  queue_.push(std::span(bytes).first(length));
}

void WoodenHapticsModel::advance(Duration dt) noexcept {
  const Time end = now_ + std::max(dt, Duration{0});
  const bool watchdog = params_.spec.protocol != WoodenProtocol::kRaw64;
  if (!faults.frozen_encoders) {
    for (std::size_t i = 0; i < 3; ++i) frozen_[i] = count(i);
  }
  while (now_ < end) {
    Time next = std::min(end, now_ + kSubstep);
    if (report_due_ && *report_due_ > now_) next = std::min(next, *report_due_);
    if (plugged_in_ && amplifiers_ && watchdog && heard_at_ + kWatchdog > now_)
      next = std::min(next, heard_at_ + kWatchdog);
    move(seconds(next - now_));
    now_ = next;
    if (watchdog && amplifiers_ && now_ - heard_at_ >= kWatchdog) amplifiers_ = false;
    if (plugged_in_ && report_due_ && now_ >= *report_due_) {
      send_report();
      const bool v1 = params_.spec.protocol == WoodenProtocol::kV1;
      report_due_ = v1 ? std::optional(now_ + params_.period) : std::nullopt;
    }
  }
}

void WoodenHapticsModel::move(double dt) noexcept {
  sim::HandPull pull;
  if (hand_) pull = hand_->advance(tip_, dt);
  if (held_ || !(dt > 0.0)) return;
  Vec3 force = motor_force() + pull.force;
  if (params_.weight) {
    const Vec3 holding = kinematics_.holding_effort(q_);
    Jacobian j = Jacobian::Zero();
    j.leftCols<3>() = kinematics_.jacobian(q_);
    force -= solve_tip_force(j, {holding[0], holding[1], holding[2]}, 3);
  }
  // Implicit in the hand's spring and all damping, so that the step is stable for every stiffness of the hand.
  const double b = params_.damping + pull.b;
  const Vec3 stretch = pull.x + 0.5 * dt * pull.v - tip_ - 0.5 * dt * velocity_;
  const double inertia = params_.mass + pull.m + dt * b + 0.25 * dt * dt * pull.k;
  const Vec3 change = dt / inertia * (force + pull.k * stretch + pull.b * pull.v - b * velocity_);
  const Vec3 before = velocity_;
  velocity_ += change;
  const Vec3 wanted = tip_ + 0.5 * dt * (before + velocity_);
  const auto q = kinematics_.inverse(wanted);
  if (!q || !(wanted.norm() <= kReach * params_.spec.radius)) {
    velocity_.setZero();  // the arm is at its stops
    return;
  }
  tip_ = wanted;
  q_ = *q;
}

bool WoodenHapticsModel::place(const Vec3& tip) noexcept {
  const auto q = kinematics_.inverse(tip);
  if (!q) return false;
  tip_ = tip;
  q_ = *q;
  velocity_.setZero();
  held_ = true;
  return true;
}

void WoodenHapticsModel::set_hand_time(std::optional<double> session) noexcept {
  if (hand_) hand_->set_session_time(session);
}

Vec3 WoodenHapticsModel::motor_effort() const noexcept {
  Vec3 effort = Vec3::Zero();
  if (!amplifiers_) return effort;
  const WoodenHapticsSpec& s = params_.spec;
  for (std::size_t i = 0; i < 3; ++i) {
    const double duty = std::clamp(current_ma_[i] / (1000.0 * s.firmware_full_scale), -1.0, 1.0);
    const double motor_torque = duty * s.amplifier_full_scale * s.torque_constant[i];
    effort[static_cast<int>(i)] = s.motor_direction[i] * motor_torque * s.body[i] / s.capstan[i];
  }
  return effort;
}

Vec3 WoodenHapticsModel::motor_force() const noexcept {
  const Vec3 effort = motor_effort();
  Jacobian j = Jacobian::Zero();
  j.leftCols<3>() = kinematics_.jacobian(q_);
  return solve_tip_force(j, {effort[0], effort[1], effort[2]}, 3);
}

const WoodenHapticsModel::HostReport& WoodenHapticsModel::host_report(std::size_t back) const noexcept {
  return remembered_[(host_reports_ + kRemembered - 1 - back) % kRemembered];
}

}  // namespace tandem::hal::emulation
