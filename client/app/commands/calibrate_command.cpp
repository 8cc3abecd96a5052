#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "client/app/commands/client_commands.h"
#include "client/app/hardware_device.h"
#include "client/app/interruptible_wait.h"
#include "client/app/terminal_prompt.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "hal/backends/device_spec_parser.h"
#include "hal/drivers/falcon/falcon_calibration.h"
#include "hal/drivers/falcon/falcon_force.h"
#include "proto/io/scene_file.h"
#include "proto/text/device_text.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

struct CalibrateArguments {
  std::string device, mass;
  std::string orientation = "upright";
};

/// Returns the force scale that the driver will use: from its calibration file, or the default. For an invalid device,
/// adds an error and returns nullopt.
std::optional<hal::FalconForce> present_scale(const std::string& device, io::UsageErrors& errors) {
  const std::string kind = device.substr(0, device.find(':'));
  if (kind != "falcon") {
    errors.add("--device: only a falcon is calibrated, not '" + kind.substr(0, 60) +
               "': other devices report what their motors give");
    return std::nullopt;
  }
  const auto wrong = HardwareDevice::spec_errors(device);
  errors.add(wrong);
  if (!wrong.empty()) return std::nullopt;
  const auto file = hal::parse_device_spec(device)->find("calibration");
  if (!file) return hal::FalconForce{};
  // The file was validated just before; an error here means that it has changed since.
  const auto text = read_text_file(*file);
  const auto spec = parse_device_text(text.value_or(""), *file);
  const auto force = hal::FalconForce::from(spec && spec->falcon ? *spec->falcon : FalconSpec{});
  if (text && spec && force) return *force;
  errors.add("--device: " + *file + ": changed while it was read");
  return std::nullopt;
}

bool is_supine(const CalibrateArguments& arguments) { return arguments.orientation == "supine"; }

hal::Vec3 up_of(bool supine) { return supine ? hal::Vec3(0, -1, 0) : hal::Vec3(0, 0, 1); }

/// Returns why the motors cannot hold this mass; empty if they can.
std::string too_heavy(double mass, const hal::FalconForce& scale, bool supine) {
  constexpr double kGravity = 9.80665;  // [m/s^2]
  const double most = hal::FalconCalibration::weight_max(scale, hal::Vec3::Zero(), up_of(supine));
  if (mass * kGravity <= most) return {};
  return format("--mass: %g kg takes %.1f N, and %s holds at most %.2f N %s: must be in [0.005, %.3f] kg%s", mass,
                mass * kGravity,
                scale.calibrated() ? "this device by its calibration" : "a device without a calibration", most,
                supine ? "supine" : "upright", most / kGravity,
                scale.calibrated() ? "" : ". Begin with 0.02 and 0.03 kg, then give the readings as calibration=FILE");
}

struct Trouble {
  std::string reason;  ///< empty: a signal arrived
};

std::expected<hal::FalconCalibration::Measurement, Trouble> weigh_once(HardwareDevice& held,
                                                                       hal::FalconCalibration& calibration,
                                                                       hal::FalconCalibration::Load load, int signals) {
  held.observe(calibration);
  if (auto enabled = held.device().enable(); !enabled) return std::unexpected(Trouble{enabled.error().message});
  const bool whole = wait_unless_interrupted(hal::FalconCalibration::length() + 5s, signals,
                                             [&] { return calibration.finished() || calibration.was_lost(); });
  held.device().disable();
  if (!whole) return std::unexpected(Trouble{});
  if (calibration.was_lost()) return std::unexpected(Trouble{"the device was unplugged"});
  auto result = calibration.measurement(load);
  if (!result) return std::unexpected(Trouble{result.error()});
  return *result;
}

void print_counts(const char* key, const std::array<double, 3>& counts) {
  std::printf("    %s { leg_1: %.1f leg_2: %.1f leg_3: %.1f }\n", key, counts[0], counts[1], counts[2]);
}

/// Returns the motor commands of a measurement [counts], with the sign and scale of FalconForce.
std::array<double, 3> motor_counts(const hal::FalconCalibration::Measurement& held, const hal::FalconForce& scale) {
  std::array<double, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) counts[i] = -held.torque[i] * scale.counts_per_nm()[i];
  return counts;
}

int calibrate(const CalibrateArguments& arguments, double mass, const hal::FalconForce& scale) {
  const io::Fd signals = io::make_signalfd();
  io::StatusLine line{false};
  auto held = HardwareDevice::open(arguments.device, signals.get(), line, {});
  const auto fail = [](std::string reason) {
    if (reason.empty()) {
      const std::string by{io::pending_signal()};
      reason =
          by.empty() ? "standard input ended before Enter was pressed: no reading" : "ended by " + by + ": no reading";
    }
    io::print_formatted(stderr, "tandem-client calibrate: %s\n", reason.c_str());
    return io::kExitTrouble;
  };
  if (!held) {
    (void)fail(held.error().reason);
    return held.error().invalid_spec ? io::kExitUsage : io::kExitTrouble;
  }
  const hal::Vec3 up = up_of(is_supine(arguments));
  hal::FalconCalibration without(hal::Vec3::Zero(), up), with(hal::Vec3::Zero(), up);
  const auto close = [&](int code) {
    (*held)->device().close();  // before the destruction of the clients that its thread calls
    return code;
  };
  if (!wait_for_enter(
          "Leave the empty grip in the middle of its reach and release it; it will hold itself there for 14 s",
          signals.get())) {
    return close(fail({}));
  }
  const auto empty = weigh_once(**held, without, hal::FalconCalibration::Load::kEmptyGrip, signals.get());
  if (!empty) return close(fail(empty.error().reason));
  if (!wait_for_enter("Hang the mass on the grip, put it in the middle again, release it and let nothing swing",
                      signals.get())) {
    return close(fail({}));
  }
  const auto loaded = weigh_once(**held, with, hal::FalconCalibration::Load::kMass, signals.get());
  (*held)->device().close();
  if (!loaded) return fail(loaded.error().reason);

  std::printf("  mass_reading {\n    mass_kg: %.6g %s\n", mass, is_supine(arguments) ? "up_y: -1" : "up_z: 1");
  print_counts("encoder", loaded->encoder);
  print_counts("motor_without", motor_counts(*empty, scale));
  print_counts("motor_with", motor_counts(*loaded, scale));
  std::printf("  }\n");
  io::print_formatted(
      stderr, "Friction reached %.1f %% of the motor torque for the mass; add the reading to your calibration file.\n",
      100 * loaded->friction / std::max(1e-6, std::abs(loaded->torque[0] - empty->torque[0])));
  return 0;
}

int calibrate_command(const CalibrateArguments& arguments) {
  io::UsageErrors errors;
  const double mass = errors.number("--mass", arguments.mass, 0.005, 1, "kg");
  if (arguments.orientation != "upright" && arguments.orientation != "supine")
    errors.add("--orientation: \"" + sanitize(arguments.orientation) +
               "\" is not an orientation: must be upright or supine");
  const bool weight_known = errors.empty();
  const auto scale = present_scale(arguments.device, errors);
  if (weight_known && scale) errors.add(too_heavy(mass, *scale, is_supine(arguments)));
  return errors.empty() ? calibrate(arguments, mass, *scale) : errors.report("tandem-client calibrate");
}

}  // namespace

void add_calibrate_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "calibrate", "Measures the force scale of a Falcon's motors with a known mass.", calibrate_command);
  command.add_option("--device", arguments.device, "required: the Falcon; the specification is that of `join --device`")
      .value_name("SPEC")
      .required();
  command.add_option("--mass", arguments.mass, "required: the mass that you hang on the grip [kg]")
      .value_name("KG")
      .required();
  command
      .add_option("--orientation", arguments.orientation,
                  "upright: the device stands; supine: it lies on its back, with its grip upwards; default upright")
      .value_name("upright|supine");
  command.footer(
      "Prints one `mass_reading { ... }` for the file of `calibration=`. The file needs at least two readings; six are "
      "better.\n"
      "Begin with the device supine and 20 to 30 g: without a calibration the motors give little force. With that file "
      "given,\n"
      "repeat with 100 and 200 g.\n"
      "Exit: 0 a reading was printed; 1 no reading; 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-client calibrate --device falcon:firmware=falcon.bin --mass 0.02 --orientation supine\n"
      "  tandem-client calibrate --device falcon:firmware=falcon.bin --mass 0.05kg");
}

}  // namespace tandem::client
