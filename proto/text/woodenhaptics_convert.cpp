#include "proto/text/woodenhaptics_convert.h"

#include <cmath>
#include <utility>

#include "proto/schema/woodenhaptics.pb.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;

constexpr double kMilli = 1e-3;

void check_parts(const pb::WoodenHapticsFile& in, MessageValidator& validator, const std::string& key) {
  for (const auto& [given, what] :
       {std::pair{in.has_base(), "base { ... }: its motor"},
        {in.has_shoulder(), "shoulder { ... }: its motor"},
        {in.has_elbow(), "elbow { ... }: its motor"},
        {in.has_arm(), "arm { ... }: its lengths"},
        {in.has_current(),
         "current { max_a: ... continuous_a: ... firmware_full_scale_a: ... amplifier_full_scale_a: ... }: currents "
         "have no defaults; 2, 1, 3, 3 A are cautious"},
        {in.has_limits(), "limits { force_n: ... radius_mm: ... }: the published 5 N and 100 mm, or your own"}}) {
    if (!given) validator.error(key, std::string("needs ") + what);
  }
  if (in.protocol() == pb::WoodenHapticsFile::UNKNOWN) {
    validator.error(child_path(key, "protocol"), "must be V1, V2 or RAW64");
  }
  if (in.has_measured() && in.measured().empty()) {
    validator.error(child_path(key, "measured"),
                    "is empty: name the author, date and method of the measurement, or leave it out");
  }
  if (in.protocol() == pb::WoodenHapticsFile::V1 && in.stylus_on_encoder_d()) {
    validator.error(child_path(key, "stylus_on_encoder_d"), "a V1 board has no encoder d");
  }
}

WoodenProtocol protocol_from(pb::WoodenHapticsFile::Protocol in) {
  return in == pb::WoodenHapticsFile::V1   ? WoodenProtocol::kV1
         : in == pb::WoodenHapticsFile::V2 ? WoodenProtocol::kV2
                                           : WoodenProtocol::kRaw64;
}

/// Checks that the two arms reach the origin of the workspace with the elbow still bent.
void check_reach(const WoodenHapticsSpec& spec, MessageValidator& validator, const std::string& key) {
  const double far = std::hypot(spec.origin[0], spec.origin[1], spec.origin[2] - spec.link[0]);
  const double longest = spec.link[1] + spec.link[2], shortest = std::abs(spec.link[1] - spec.link[2]);
  if (far >= longest || far <= shortest) {
    validator.error(child_path(key, "arm"), "its origin is " + text::number_text(std::round(far * 1e4) / 10) +
                                                " mm from the shoulder; the arms reach from " +
                                                text::number_text(std::round(shortest * 1e4) / 10) + " to " +
                                                text::number_text(std::round(longest * 1e4) / 10) + " mm");
  }
}

}  // namespace

WoodenHapticsSpec woodenhaptics_from(const pb::WoodenHapticsFile& in, MessageValidator& validator,
                                     const std::string& key) {
  check_parts(in, validator, key);
  WoodenHapticsSpec spec;
  spec.protocol = protocol_from(in.protocol());
  const std::array<const pb::WoodenMotor*, 3> motors{&in.base(), &in.shoulder(), &in.elbow()};
  for (std::size_t i = 0; i < 3; ++i) {
    spec.capstan[i] = motors[i]->capstan_mm() * kMilli;
    spec.body[i] = motors[i]->body_mm() * kMilli;
    spec.torque_constant[i] = motors[i]->torque_constant_nm_a();
    spec.calibration_counts[i] = static_cast<std::int16_t>(motors[i]->calibration_counts());
    spec.encoder_direction[i] = motors[i]->encoder_reversed() ? -1 : 1;
    spec.motor_direction[i] = motors[i]->motor_reversed() ? -1 : 1;
  }
  const pb::WoodenArm& arm = in.arm();
  spec.link = {arm.height_mm() * kMilli, arm.upper_mm() * kMilli, arm.fore_mm() * kMilli};
  spec.origin = {arm.origin_x_mm() * kMilli, arm.origin_y_mm() * kMilli, arm.origin_z_mm() * kMilli};
  if (in.has_arm()) check_reach(spec, validator, key);
  spec.counts_per_turn = in.counts_per_turn();

  const pb::WoodenCurrent& current = in.current();
  const std::string current_key = child_path(key, "current");
  if (in.has_current()) {
    spec.current_max = current.max_a();
    spec.current_continuous = current.continuous_a();
    spec.firmware_full_scale = current.firmware_full_scale_a();
    spec.amplifier_full_scale = current.amplifier_full_scale_a();
  }
  if (spec.current_continuous > spec.current_max) {
    validator.error(child_path(current_key, "continuous_a"), "is above max_a, " + text::number_text(spec.current_max),
                    text::number_text(spec.current_continuous));
  }
  if (spec.current_max > spec.amplifier_full_scale) {
    validator.error(
        child_path(current_key, "max_a"),
        "is above what the amplifier makes, amplifier_full_scale_a " + text::number_text(spec.amplifier_full_scale),
        text::number_text(spec.current_max));
  }

  const pb::WoodenLimits& limits = in.limits();
  if (in.has_limits()) {
    spec.force_max = limits.force_n();
    spec.radius = limits.radius_mm() * kMilli;
  }
  if (limits.has_stiffness_n_m()) spec.stiffness_max = limits.stiffness_n_m();
  if (limits.has_damping_n_s_m()) spec.damping = limits.damping_n_s_m();
  if (limits.has_latency_ms()) spec.latency = kMilli * limits.latency_ms();
  if (limits.has_mass_kg()) spec.tip_mass = limits.mass_kg();

  const pb::WoodenWeight& weight = in.weight();
  spec.arm_mass = {weight.upper_kg(), weight.fore_kg()};
  spec.arm_mass_at = {weight.upper_at_mm() * kMilli, weight.fore_at_mm() * kMilli};
  spec.gravity = weight.carried();
  spec.stylus_on_encoder_d = in.stylus_on_encoder_d();
  spec.force_checked = in.has_measured();
  return spec;
}

}  // namespace tandem
