#include "hal/backends/input_backends.h"

#include <algorithm>

#include "common/base/format.h"
#include "hal/core/driver_guard.h"
#include "hal/drivers/mouse/mouse_driver.h"
#include "hal/drivers/replay/replay_driver.h"
#include "hal/io/evdev_mouse.h"
#include "hal/io/motion_file.h"

namespace tandem::hal {
namespace {

constexpr double kMmPerCountMin = 0.001, kMmPerCountMax = 5;

struct MouseOptions {
  MouseDriver::Params params;
  bool grab = false;
};

/// Returns the options of the specification, or all its errors.
Result<MouseOptions> parse_mouse_options(const DeviceSpec& choice) {
  OptionParser judge{choice, {"mm_per_count", "plane", "grab"}};
  MouseOptions words;
  if (const auto mm = judge.number("mm_per_count", kMmPerCountMin, kMmPerCountMax, "mm"))
    words.params.metres_per_count = 1e-3 * *mm;
  words.params.plane = judge.one_of("plane", {"vertical", "table"}) == "table" ? MouseDriver::Plane::kTable
                                                                               : MouseDriver::Plane::kVertical;
  words.grab = judge.yes_or_no("grab", false);
  return judge.result_with(words);
}

/// Returns where the recording exceeds the limits of every device; empty: it does not.
std::string beyond(const sim::RecordedMotion& motion, const std::string& file) {
  const double speed_max = GuardLimits{}.speed_max_m_s;
  const auto found = motion.first_beyond(ReplayDriver::kReach, speed_max);
  if (!found) return {};
  constexpr const char* kAxes[] = {"x", "y", "z"};
  const std::string place = file + ":" + std::to_string(found->line) + ": ";
  if (found->axis < 0)
    return place + format(
                       "speed from the row before = %.3g m/s at scale %.4g: must be in [0, %g] m/s, which is the range "
                       "of a hand; give scale=auto or a smaller scale, or correct the row",
                       found->value, motion.scale(), speed_max);
  return place + format(
                     "%s of the device = %.4g m at scale %.4g: must be in [%g, %g] m, the workspace; give scale=auto "
                     "or a smaller scale, or correct the row",
                     kAxes[found->axis], found->value, motion.scale(), -ReplayDriver::kReach, ReplayDriver::kReach);
}

/// Returns the recorded motion of the specification, or all errors of the specification and the file.
Result<std::shared_ptr<const sim::RecordedMotion>> parse_replay_options(const DeviceSpec& choice) {
  OptionParser judge{choice, {sim::kMotionOptionNames.begin(), sim::kMotionOptionNames.end()}};
  sim::MotionOptions options;
  options.file = choice.name;
  for (const auto& [key, value] : choice.options) {
    if (std::ranges::find(sim::kMotionOptionNames, key) == sim::kMotionOptionNames.end())
      continue;  // the option parser reports it
    if (auto ok = sim::set_motion_option(options, key, value); !ok) judge.add_error(ok.error());
  }
  std::shared_ptr<const sim::RecordedMotion> motion;
  if (choice.name.empty()) {
    judge.add_error("needs a file: replay:FILE.csv");
  } else if (auto loaded = load_motion(options); !loaded) {
    judge.add_lines(loaded.error());
  } else if (const std::string trouble = beyond(**loaded, choice.name); !trouble.empty()) {
    judge.add_lines(trouble);
  } else {
    motion = std::move(*loaded);
  }
  return judge.result_with(std::move(motion));
}

/// Returns the node of the only mouse, or why there is none.
Result<std::string> only_mouse() {
  const auto found = EvdevMouse::list();
  if (found.empty())
    return std::unexpected(DeviceError{
        Errc::kNotFound, std::string("mouse: none is attached that the kernel's evdev shows (/dev/input/event*). ") +
                             EvdevMouse::kWithout});
  if (found.size() == 1) return found.front().node;
  std::string message = "mouse: there are several; select one:";
  for (const auto& mouse : found)
    message += " mouse:" + mouse.node + " (" + (mouse.description.empty() ? "no permission" : mouse.description) + ")";
  if (std::ranges::all_of(found, [](const auto& mouse) { return !mouse.problem.empty(); }))
    message += ". " + found.front().problem;
  return std::unexpected(DeviceError{Errc::kBadState, std::move(message)});
}

}  // namespace

std::string ReplayBackend::library() const { return "none: a file"; }

std::vector<DeviceFact> ReplayBackend::facts() const { return {}; }

Result<> ReplayBackend::check(const DeviceSpec& choice) const { return without_value(parse_replay_options(choice)); }

Result<OpenedDriver> ReplayBackend::open(const DeviceSpec& choice) {
  auto motion = parse_replay_options(choice);
  if (!motion) return std::unexpected(std::move(motion.error()));
  const std::string note = choice.name + ": " + (*motion)->describe();
  return OpenedDriver{nullptr, std::make_unique<ReplayDriver>(note, std::move(*motion), clock_), std::nullopt};
}

std::string MouseBackend::library() const { return EvdevMouse::library(); }

std::vector<DeviceFact> MouseBackend::facts() const {
  return {{"firmware", "the mouse keeps its own"},
          {"rate", "as it reports; read 1000 times a second"},
          {"calibration", "0.1 mm per count; mm_per_count= changes that"},
          {"homing", "needs none: it starts in the middle"},
          {"gravity", "no motors"}};
}

Result<> MouseBackend::check(const DeviceSpec& choice) const { return without_value(parse_mouse_options(choice)); }

Result<std::vector<FoundDevice>> MouseBackend::list() {
  std::vector<FoundDevice> devices;
  for (auto& mouse : EvdevMouse::list()) {
    devices.push_back({"mouse:" + mouse.node, mouse.description.empty() ? "a mouse" : mouse.description, mouse.problem,
                       "/dev/input/" + mouse.node});
  }
  return devices;
}

Result<OpenedDriver> MouseBackend::open(const DeviceSpec& choice) {
  const auto words = parse_mouse_options(choice);
  if (!words) return std::unexpected(words.error());
  std::string node = choice.name;
  if (node.empty()) {
    auto only = only_mouse();
    if (!only) return std::unexpected(std::move(only.error()));
    node = std::move(*only);
  }
  auto mouse = EvdevMouse::open(node, words->grab);
  if (!mouse) return std::unexpected(std::move(mouse.error()));
  return OpenedDriver{nullptr, std::make_unique<MouseDriver>(node, std::move(*mouse), clock_, words->params),
                      std::nullopt};
}

}  // namespace tandem::hal
