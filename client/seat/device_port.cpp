#include "client/seat/device_port.h"

#include <algorithm>
#include <cmath>

namespace tandem::client {
namespace {

constexpr unsigned kInvalidReadingsMax = 3;  // replaced by the last valid one before the gate faults

/// Limits of a plausible reading: joints [rad or m] and [rad/s or m/s], tip [m] and [m/s], entries of J [m or 1].
constexpr double kJointMax = 100, kJointRateMax = 1000, kTipMax = 10, kTipSpeedMax = 100, kJacobianMax = 100;

/// True if all values are within the limits above. NaN is not plausible, because every comparison with NaN is false.
bool plausible(const hal::State& s, std::size_t joints) noexcept {
  for (std::size_t j = 0; j < joints; ++j)
    if (!(std::abs(s.q[j]) <= kJointMax) || !(std::abs(s.dq[j]) <= kJointRateMax)) return false;
  return (s.x.array().abs() <= kTipMax).all() && (s.dx.array().abs() <= kTipSpeedMax).all() &&
         (s.J.array().abs() <= kJacobianMax).all();
}

}  // namespace

bool DevicePort::update(const hal::State& device) noexcept {
  if (plausible(device, joints_) && !device.stale) {
    reading_ = device;
    invalid_readings_ = 0;
  } else {
    ++invalid_readings_;
    if (device.stale) reading_.tau_out = device.tau_out;
  }
  q_ = map_.position(reading_);
  v_ = map_.velocity(reading_);
  delivered_.advance(joints_, reading_.q, reading_.tau_out);
  return invalid_readings_ <= kInvalidReadingsMax;
}

void DevicePort::fill(const AxisArray& wanted, wire::Telemetry& out) const noexcept {
  const auto put = [](std::array<double, 3>& to, const hal::Vec3& from) { std::copy_n(from.data(), 3, to.begin()); };
  out.q = reading_.q;
  put(out.x, reading_.x);
  put(out.f_cmd, tip_force(wanted));
  put(out.f_out, reading_.f_out);
  put(out.f_env, reading_.f_env);
  out.penetration_m = reading_.penetration;
  out.delivered_j = delivered_.total();
}

}  // namespace tandem::client
