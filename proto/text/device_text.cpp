#include "proto/text/device_text.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

#include "proto/schema/device.pb.h"
#include "proto/text/spacemouse_convert.h"
#include "proto/text/text_format_reader.h"
#include "proto/text/woodenhaptics_convert.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;

std::array<double, 3> counts_from(const pb::FalconCounts& in) { return {in.leg_1(), in.leg_2(), in.leg_3()}; }

std::optional<double> number(bool given, double value) { return given ? std::optional(value) : std::nullopt; }

FalconMassReading reading_from(const pb::FalconReading& in, MessageValidator& validator, const std::string& key) {
  if (!in.has_encoder()) validator.error(key, "needs encoder { leg_1: ... leg_2: ... leg_3: ... }");
  if (!in.has_motor_without()) validator.error(key, "needs motor_without { ... }: the motor commands without the mass");
  if (!in.has_motor_with()) validator.error(key, "needs motor_with { ... }: the motor commands with the mass");
  const double length = std::hypot(in.up_x(), in.up_y(), in.up_z());
  if (length < 0.1) validator.error(key, "needs up_x, up_y, up_z: the direction against gravity, such as up_z: 1");
  return {.mass = in.mass_kg(),
          .up = {in.up_x() / length, in.up_y() / length, in.up_z() / length},
          .encoder = counts_from(in.encoder()),
          .motor_without = counts_from(in.motor_without()),
          .motor_with = counts_from(in.motor_with()),
          .line = validator.location(key).line};
}

FalconFlags flags_from(const pb::FalconFlagFile& in, MessageValidator& validator, const std::string& key) {
  FalconFlags flags;
  const std::array<std::pair<const char*, std::uint8_t*>, 4> all{
      {{"homing", &flags.homing}, {"green", &flags.green}, {"blue", &flags.blue}, {"red", &flags.red}}};
  if (in.has_homing()) flags.homing = static_cast<std::uint8_t>(in.homing());
  if (in.has_green()) flags.green = static_cast<std::uint8_t>(in.green());
  if (in.has_blue()) flags.blue = static_cast<std::uint8_t>(in.blue());
  if (in.has_red()) flags.red = static_cast<std::uint8_t>(in.red());
  unsigned used = 0;
  for (const auto& [name, bit] : all) {
    if (!std::has_single_bit(*bit)) {
      validator.error(child_path(key, name), "must be one bit: 1, 2, 4, 8, 16, 32 or 64");
    } else if ((used & *bit) != 0) {
      validator.error(
          child_path(key, name),
          "is a bit that another flag has already, written or by default (homing 1, green 2, blue 4, red 8)");
    }
    used |= *bit;
  }
  return flags;
}

FalconSpec falcon_from(const pb::FalconFile& in, MessageValidator& validator, const std::string& key) {
  FalconSpec spec;
  if (in.has_force()) {
    spec.counts_per_nm = {in.force().motor_1_counts_per_nm(), in.force().motor_2_counts_per_nm(),
                          in.force().motor_3_counts_per_nm()};
    if (in.mass_reading_size() > 0) {
      validator.error(child_path(key, "force"),
                      "cannot be combined with mass_reading: give the scale, or the readings to fit it to");
    }
  }
  if (in.mass_reading_size() == 1) {
    validator.error(child_path(key, "mass_reading", 0), "one reading is no calibration: give at least two, better six");
  }
  for (int i = 0; i < in.mass_reading_size(); ++i) {
    spec.readings.push_back(reading_from(in.mass_reading(i), validator, child_path(key, "mass_reading", i)));
  }
  const bool numbers = in.has_force() || in.mass_reading_size() > 0;
  spec.measured = in.measured();
  if (numbers && in.measured().empty()) {
    validator.error(key, "needs measured: \"name, date and method of the measurement\" beside a force scale");
  }
  spec.peak = number(in.has_peak_n(), in.peak_n());
  spec.continuous = number(in.has_continuous_n(), in.continuous_n());
  if (spec.peak && spec.continuous && *spec.continuous > *spec.peak) {
    validator.error(child_path(key, "continuous_n"), "is above peak_n");
  }
  spec.mass = number(in.has_mass_kg(), in.mass_kg());
  spec.damping = number(in.has_damping_n_s_m(), in.damping_n_s_m());
  spec.stiffness = number(in.has_stiffness_n_m(), in.stiffness_n_m());
  if (in.has_latency_ms()) spec.latency = 1e-3 * in.latency_ms();
  if (in.firmware().has_sha256()) {
    std::string hash = in.firmware().sha256();
    std::ranges::transform(hash, hash.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool hex = std::ranges::all_of(hash, [](unsigned char c) { return std::isxdigit(c) != 0; });
    if (hash.size() != 64 || !hex) {
      validator.error(child_path(key, "firmware.sha256"),
                      "must be 64 hexadecimal digits, as `sha256sum FILE` prints them");
    }
    spec.firmware_sha256 = std::move(hash);
  }
  spec.line = validator.location(key).line;
  spec.flags = flags_from(in.flags(), validator, child_path(key, "flags"));
  return spec;
}

}  // namespace

std::expected<DeviceFileSpec, InputErrors> parse_device_text(std::string_view text, std::string_view file_name) {
  MessageValidator validator{file_name};
  pb::DeviceFile in;
  text::read_document(text, file_name, in, validator);
  // Rules between numbers apply only to numbers that are in range.
  if (!validator.ok()) return std::unexpected(validator.take());
  DeviceFileSpec spec;
  if (in.has_falcon()) spec.falcon = falcon_from(in.falcon(), validator, "falcon");
  if (in.has_woodenhaptics()) spec.woodenhaptics = woodenhaptics_from(in.woodenhaptics(), validator, "woodenhaptics");
  if (in.has_spacemouse()) spec.spacemouse = spacemouse_from(in.spacemouse());
  if (!validator.ok()) return std::unexpected(validator.take());
  return spec;
}

}  // namespace tandem
