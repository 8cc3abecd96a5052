#include "client/app/weigh_command.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/app/ask_person.h"
#include "client/app/held_device.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/number_option.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "hal/falcon/falcon_force.h"
#include "hal/falcon/falcon_weighing.h"
#include "hal/io/device_choice.h"
#include "proto/device_text.h"
#include "proto/io/scene_file.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kTrouble = 1, kWrong = 2;

struct WeighArguments {
  std::string device, mass;
  bool lying = false;
};

/// The scale in which the driver will speak: of the calibration it is given, or the guess. Nothing: told already.
std::optional<hal::FalconForce> present_scale(const std::string& device, std::vector<std::string>& mistakes) {
  const std::string kind = device.substr(0, device.find(':'));
  if (kind != "falcon") {
    mistakes.push_back("--device: only a falcon is weighed, not '" + kind.substr(0, 60) + "': other devices say what their motors give");
    return std::nullopt;
  }
  auto wrong = HeldDevice::mistakes(device);
  mistakes.insert(mistakes.end(), wrong.begin(), wrong.end());
  if (!wrong.empty()) return std::nullopt;
  const auto file = hal::parse_choice(device)->find("calibration");
  if (!file) return hal::FalconForce{};
  // The same file was found good just now: what can be wrong is that it changed meanwhile.
  const auto text = read_text_file(*file);
  const auto spec = parse_device_text(text.value_or(""), *file);
  const auto force = hal::FalconForce::from(spec && spec->falcon ? *spec->falcon : FalconSpec{});
  if (text && spec && force) return *force;
  mistakes.push_back("--device: " + *file + ": changed while it was read");
  return std::nullopt;
}

hal::Vec3 up_of(bool lying) { return lying ? hal::Vec3(0, -1, 0) : hal::Vec3(0, 0, 1); }

/// Why these motors will not hold this mass; empty: they may.
std::string too_heavy(double mass, const hal::FalconForce& scale, bool lying) {
  constexpr double kGravity = 9.80665;  // [m/s^2]
  const double most = hal::FalconWeighing::holds(scale, hal::Vec3::Zero(), up_of(lying));
  if (mass * kGravity <= most) return {};
  return format("--mass: %g kg takes %.1f N, and %s holds at most %.2f N %s: must be in [0.005, %.3f] kg%s", mass, mass * kGravity,
                scale.calibrated() ? "this device by its calibration" : "a device without a calibration", most, lying ? "lying" : "standing",
                most / kGravity, scale.calibrated() ? "" : ". Begin with 0.02 and 0.03, then give what came out as calibration=FILE");
}

struct Trouble {
  std::string reason;  ///< empty: interrupted
};

std::expected<hal::FalconWeighing::Held, Trouble> weigh_once(HeldDevice& held, hal::FalconWeighing& weighing,
                                                               hal::FalconWeighing::Load load, int signals) {
  held.observe(weighing);
  if (auto enabled = held.device().enable(); !enabled) return std::unexpected(Trouble{enabled.error().message});
  const Time end = io::monotonic_now() + hal::FalconWeighing::length() + 5s;
  while (!weighing.finished() && !weighing.was_lost() && io::monotonic_now() < end) {
    pollfd file{signals, POLLIN, 0};
    if (poll(&file, 1, 50) > 0) {
      held.device().disable();
      return std::unexpected(Trouble{});
    }
  }
  held.device().disable();
  if (weighing.was_lost()) return std::unexpected(Trouble{"the device was unplugged"});
  auto result = weighing.held(load);
  if (!result) return std::unexpected(Trouble{result.error()});
  return *result;
}

void print_counts(const char* key, const std::array<double, 3>& counts) {
  std::printf("    %s { leg_1: %.1f leg_2: %.1f leg_3: %.1f }\n", key, counts[0], counts[1], counts[2]);
}

/// As the motors were told: the sign and scale of FalconForce.
std::array<double, 3> motor_counts(const hal::FalconWeighing::Held& held, const hal::FalconForce& scale) {
  std::array<double, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) counts[i] = -held.torque[i] * scale.counts_per_nm()[i];
  return counts;
}

int weigh(const WeighArguments& arguments, double mass, const hal::FalconForce& scale) {
  const io::Fd signals = io::signals_as_file();
  io::StatusLine line{false};
  auto held = HeldDevice::take(arguments.device, signals.get(), line, {});
  const auto fail = [](std::string reason) {
    if (reason.empty()) {
      const std::string by{io::signal_that_came()};
      reason = by.empty() ? "nobody is there to press Enter: no reading" : "ended by " + by + ": no reading";
    }
    io::printf_for_people(stderr, "tandem-client weigh: %s\n", reason.c_str());
    return kTrouble;
  };
  if (!held) {
    (void)fail(held.error().reason);
    return held.error().wrong_words ? kWrong : kTrouble;
  }
  const hal::Vec3 up = up_of(arguments.lying);
  hal::FalconWeighing without(hal::Vec3::Zero(), up), with(hal::Vec3::Zero(), up);
  const auto close = [&](int code) {
    (*held)->device().close();  // before those it calls
    return code;
  };
  if (!wait_for_enter("Leave the empty grip in the middle of its reach and let go; it will hold itself there for 14 s", signals.get())) {
    return close(fail({}));
  }
  const auto empty = weigh_once(**held, without, hal::FalconWeighing::Load::kEmptyGrip, signals.get());
  if (!empty) return close(fail(empty.error().reason));
  if (!wait_for_enter("Hang the mass on the grip, put it in the middle again, let go and let nothing swing", signals.get())) {
    return close(fail({}));
  }
  const auto loaded = weigh_once(**held, with, hal::FalconWeighing::Load::kMass, signals.get());
  (*held)->device().close();
  if (!loaded) return fail(loaded.error().reason);

  std::printf("  mass_reading {\n    mass_kg: %.6g %s\n", mass, arguments.lying ? "up_y: -1" : "up_z: 1");
  print_counts("encoder", loaded->encoder);
  print_counts("motor_without", motor_counts(*empty, scale));
  print_counts("motor_with", motor_counts(*loaded, scale));
  std::printf("  }\n");
  io::printf_for_people(stderr, "Friction took up to %.1f %% of what the mass takes; add the reading to your calibration file.\n",
               100 * loaded->friction / std::max(1e-6, std::abs(loaded->torque[0] - empty->torque[0])));
  return 0;
}

int weigh_command(const WeighArguments& arguments) {
  std::vector<std::string> mistakes;
  if (const std::string problem = io::number_in(0.005, 1, "kg")(std::string(arguments.mass)); !problem.empty())
    mistakes.push_back("--mass: " + problem);
  const bool weight_known = mistakes.empty();
  const auto scale = present_scale(arguments.device, mistakes);
  if (weight_known && scale) {
    if (std::string heavy = too_heavy(std::stod(arguments.mass), *scale, arguments.lying); !heavy.empty()) mistakes.push_back(std::move(heavy));
  }
  if (mistakes.empty()) return weigh(arguments, std::stod(arguments.mass), *scale);
  for (const std::string& mistake : mistakes) io::printf_for_people(stderr, "%s\n", mistake.c_str());
  io::printf_for_people(stderr, "tandem-client weigh: %zu mistake%s, nothing was started\n", mistakes.size(), mistakes.size() == 1 ? "" : "s");
  return kWrong;
}

}  // namespace

void add_weigh_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<WeighArguments>();
  CLI::App* const command = root.add_subcommand("weigh", "Finds what a Falcon's motors are worth, with a known mass.");
  command->add_option("--device", arguments->device, "required: the falcon; the words are those of `join --device`")
      ->option_text("WORDS")
      ->required();
  command->add_option("--mass", arguments->mass, "required: what you will hang on its grip [kg]")->option_text("KG")->required();
  command->add_flag("--lying", arguments->lying, "the device lies on its back, its grip upwards; else it stands");
  command->footer(
      "Prints one `mass_reading { ... }` for the file of `calibration=`; two at least, six are better. Begin lying on its\n"
      "back with 20 to 30 g: without a calibration the motors give little. With that file given, repeat with 100 and 200 g.\n"
      "Exit: 0 a reading was printed; 1 no reading; 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-client weigh --device falcon:firmware=falcon.bin --mass 0.02 --lying\n"
      "  tandem-client weigh --device falcon:firmware=falcon.bin --mass 0.05kg");
  command->callback([arguments, &action] { action = [arguments] { return weigh_command(*arguments); }; });
}

}  // namespace tandem::client
