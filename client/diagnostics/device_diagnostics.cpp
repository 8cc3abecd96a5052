#include "client/diagnostics/device_diagnostics.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"
#include "common/base/stiffness_limit.h"

namespace tandem::client {
namespace {

using Finding = DeviceDiagnostics::Finding;
using Kind = Finding::Kind;

constexpr double kMoved = 0.01;            ///< [m] smallest tip range of a user who was asked to move the device
constexpr std::int32_t kCountsMoved = 20;  ///< smallest range of an encoder that moves
constexpr unsigned kBatteryLow = 20;       ///< [%]
constexpr double kRateGood = 0.97;         ///< smallest good rate, as a share of the nominal rate
constexpr double kGivesWay = 0.0005;       ///< [m] smallest displacement that counts as motion along a push
constexpr const char* kAxisNames[] = {"x", "y", "z"};

}  // namespace

void DeviceDiagnostics::update(const hal::State& state) noexcept {
  if (state.battery_percent) battery_ = state.battery_percent;  // also in stale readings
  if (state.stale) {
    ++stale_;
    return;
  }
  if (!state.x.allFinite() || !state.dx.allFinite()) {
    ++not_finite_;
    return;
  }
  if (readings_++ == 0) {
    raw_min_ = raw_max_ = state.raw;
    low_ = high_ = state.x;
  }
  for (std::size_t i = 0; i < kAxesMax; ++i) {
    raw_min_[i] = std::min(raw_min_[i], state.raw[i]);
    raw_max_[i] = std::max(raw_max_[i], state.raw[i]);
  }
  low_ = low_.cwiseMin(state.x);
  high_ = high_.cwiseMax(state.x);
  fastest_ = std::max(fastest_, state.dx.norm());
  pressed_ |= state.buttons;
  if (homed_ && !state.homed) ++origin_lost_;
  homed_ = state.homed;
  ever_homed_ = ever_homed_ || homed_;
}

std::vector<Finding> DeviceDiagnostics::findings(const hal::DeviceStats& stats, double seconds) const {
  std::vector<Finding> all;
  const auto say = [&](Kind kind, std::string words) { all.push_back({kind, std::move(words)}); };
  if (readings_ == 0) {
    say(Kind::kTrouble,
        "the device is visible but silent: no complete answer came. Unplug it, wait ten seconds, plug it in; another "
        "program may hold it; on a hub with little power, plug it into the machine");
    return all;
  }
  if (caps_.needs_firmware) say(Kind::kGood, "its firmware runs");
  if (battery_)
    say(*battery_ < kBatteryLow ? Kind::kNotice : Kind::kGood,
        format(*battery_ < kBatteryLow ? "battery %u %%: charge it" : "battery %u %%", unsigned{*battery_}));
  const double rate = seconds > 0 ? static_cast<double>(readings_) / seconds : 0;
  const bool own_pace = caps_.input == hal::InputKind::kRate;
  if (own_pace || rate >= kRateGood * caps_.nominal_hz) {
    say(Kind::kGood, format("%.0f readings a second (nominal %.0f)", rate, caps_.nominal_hz));
  } else {
    say(Kind::kTrouble,
        format("only %.0f readings a second of %.0f: the machine is busy, or the device hangs on a slow hub; "
               "real-time priority helps (README, real-time)",
               rate, caps_.nominal_hz));
  }
  if (stats.round_trip_p50_s > 0)
    say(Kind::kGood, format("an exchange takes %.2f ms (p50), %.2f ms (p99), %.2f ms at most",
                            1e3 * stats.round_trip_p50_s, 1e3 * stats.round_trip_p99_s, 1e3 * stats.round_trip_max_s));
  if (stats.unanswered > 0 || stats.resyncs > 0)
    say(stats.unanswered > stats.ticks / 100 ? Kind::kTrouble : Kind::kNotice,
        format("%llu exchanges without a complete answer, %llu searches for the beginning of a frame: check cable and "
               "hub, and end other programs that use the device",
               static_cast<unsigned long long>(stats.unanswered), static_cast<unsigned long long>(stats.resyncs)));
  if (not_finite_ > 0)
    say(Kind::kTrouble, format("%llu readings were not finite: calibration file or kinematics do not fit this device",
                               static_cast<unsigned long long>(not_finite_)));
  if (own_pace) {
    if (fastest_ > 0) {
      say(Kind::kGood, format("it moves: up to %.2f m/s", fastest_));
    } else {
      say(Kind::kNotice, "it reported only rest: push the cap during the examination");
    }
    return all;
  }

  const std::size_t joints = std::min(caps_.joints, kAxesMax);
  std::string frozen;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < joints; ++i) {
    const bool alive = raw_max_[i] - raw_min_[i] >= kCountsMoved;
    moved += alive ? 1 : 0;
    if (!alive) frozen += (frozen.empty() ? "" : ", ") + std::to_string(i + 1);
  }
  const double way = (high_ - low_).maxCoeff();
  if (moved == 0) {
    say(Kind::kTrouble, ever_homed_ || caps_.homing == hal::Homing::kNone
                            ? "no encoder moved: either the grip was not moved, or the firmware does not run (unplug "
                              "it and load the firmware again)"
                            : "the position stays at the pose of an uncalibrated device: the grip was not moved, or "
                              "the device was not homed since it was plugged in");
  } else if (moved < joints) {
    say(Kind::kTrouble, "the encoder of joint " + frozen +
                            " did not move while the others did: its cable or plug, or the "
                            "grip was moved along the others only: move it in all directions and examine again");
  } else {
    say(Kind::kGood, format("all %zu encoders move; the tip went %.0f x %.0f x %.0f mm", joints,
                            1e3 * (high_[0] - low_[0]), 1e3 * (high_[1] - low_[1]), 1e3 * (high_[2] - low_[2])));
    if (way < kMoved)
      say(Kind::kNotice, "the tip moved less than a centimetre: move it further to be sure of its calibration");
  }
  if (caps_.homing == hal::Homing::kNone) {
    say(Kind::kGood, "needs no homing");
  } else if (origin_lost_ > 0) {
    say(Kind::kTrouble,
        format("the origin was lost %llu times: it was moved faster than it can count, or its power is weak",
               static_cast<unsigned long long>(origin_lost_)));
  } else {
    say(homed_ ? Kind::kGood : Kind::kNotice, homed_ ? "homed" : "not homed: it gives no force until it is homed");
  }
  if (std::ranges::none_of(caps_.axis, [](const hal::AxisLimit& axis) { return axis.peak.has_value(); })) {
    say(Kind::kGood, "it gives no force: it has no motors, or does not report their force");
  } else if (caps_.force_calibrated) {
    static constexpr const char* kFrom[] = {"an unknown source", "the datasheet", "the device itself",
                                            "its calibration file", "its model"};
    say(Kind::kGood,
        format("force scale calibrated; limits from %s", kFrom[static_cast<std::size_t>(caps_.axis[0].from)]));
  } else {
    say(Kind::kNotice,
        "its force scale was never measured: forces are limited to a tenth of the peak; hal/README.md shows how to "
        "measure it with a known mass");
  }
  if (std::ranges::any_of(caps_.axis, [](const hal::AxisLimit& axis) { return axis.peak.value_or(0) > 0; })) {
    const double damping = caps_.damping.value_or(kDampingUnknown),
                 latency = caps_.latency.value_or(caps_.simulated ? 0 : kLatencyUnknown);
    say(caps_.damping ? Kind::kGood : Kind::kNotice,
        format("renders springs up to %.0f N/m at 1000 Hz: b / (T/2 + t_d) of its damping b %g N s/m%s and its latency "
               "t_d %g ms%s",
               stiffness_limit(damping, latency, 1e-3), damping, caps_.damping ? "" : ", assumed as it is not known",
               1e3 * latency, caps_.latency ? "" : ", assumed as it is not known"));
  }
  static constexpr const char* kGravity[] = {"no gravity compensation", "gravity is compensated by this program",
                                             "the device compensates gravity itself"};
  say(Kind::kGood, kGravity[static_cast<std::size_t>(caps_.gravity)]);
  if (std::ranges::any_of(caps_.axis, [](const hal::AxisLimit& axis) { return axis.peak.value_or(0) > 0; })) {
    if (caps_.watchdog)
      say(Kind::kNotice, format("if this program and its watchdog process are both killed, the device itself releases "
                                "the force after %lld ms: too late for a hand; "
                                "keep its power switch within reach",
                                static_cast<long long>(caps_.watchdog->count())));
    else
      say(Kind::kNotice,
          "nothing is known of a watchdog in the device: if this program and its watchdog process are both killed, or "
          "the cable is "
          "pulled, assume that its motors keep their last force; keep its power switch within reach");
  }
  if (caps_.buttons > 0)
    say(pressed_ != 0 ? Kind::kGood : Kind::kNotice, pressed_ != 0
                                                         ? format("buttons seen: mask 0x%x", pressed_)
                                                         : std::string("no button was pressed while it was examined"));
  return all;
}

ForceTest::ForceTest(const hal::DeviceCaps& caps, Time begin) noexcept
    : axes_(std::min<std::size_t>(caps.tip_axes, 3)), begin_(begin) {}

hal::Vec3 ForceTest::step(Time now, const hal::State& state) noexcept {
  const Duration period = kPush + kRest;
  const Duration since = now - begin_;
  if (since < Duration::zero() || finished(now)) return hal::Vec3::Zero();
  const auto index = static_cast<std::size_t>(since / period);
  const Duration into = since % period;
  Push& push = push_[index];
  const auto axis = static_cast<Eigen::Index>(index / 2);
  const double sign = index % 2 == 0 ? 1.0 : -1.0;
  if (into < kRest) {  // the user's hand comes to rest before each push
    push.from = state.x;
    return hal::Vec3::Zero();
  }
  const hal::Vec3 way = state.x - push.from;
  push.along = sign * way[axis];
  hal::Vec3 across = way;
  across[axis] = 0;
  push.sideways = across.norm();
  push.given += sign * state.f_out[axis];
  ++push.samples;
  hal::Vec3 force = hal::Vec3::Zero();
  force[axis] = sign * kForce;
  return force;
}

bool ForceTest::finished(Time now) const noexcept {
  return now - begin_ >= (kPush + kRest) * static_cast<Duration::rep>(pushes());
}

std::vector<Finding> ForceTest::findings() const {
  std::vector<Finding> all;
  for (std::size_t i = 0; i < pushes(); ++i) {
    const Push& push = push_[i];
    const std::string name = std::string(i % 2 == 0 ? "+" : "-") + kAxisNames[i / 2];
    const double given = push.samples > 0 ? push.given / static_cast<double>(push.samples) : 0;
    const std::string numbers = format("%.2f N were sent, the tip went %.1f mm along and %.1f mm across", given,
                                       1e3 * push.along, 1e3 * push.sideways);
    if (given < kForce / 10) {
      all.push_back({Kind::kTrouble, "force along " + name + ": " + numbers +
                                         ": hardly any force left this program; is the "
                                         "device homed and its peak force known?"});
    } else if (push.along < -kGivesWay) {
      all.push_back({Kind::kTrouble, "force along " + name + ": " + numbers +
                                         ": it pushed the WRONG WAY. Do not use this "
                                         "device: a motor's direction or a cable is wrong"});
    } else if (push.along < kGivesWay) {
      all.push_back(
          {Kind::kNotice, "force along " + name + ": " + numbers +
                              ": the tip did not move; it is held firmly, at its stop, or the motors have no power"});
    } else if (push.sideways > push.along) {
      all.push_back(
          {Kind::kNotice, "force along " + name + ": " + numbers +
                              ": more across than along; either motors are swapped, or a hand moved the grip"});
    } else {
      all.push_back({Kind::kGood, "force along " + name + ": " + numbers});
    }
  }
  return all;
}

}  // namespace tandem::client
