#include "hal/app/input_backends.h"

#include <algorithm>

#include "common/base/format.h"
#include "hal/driver_guard.h"
#include "hal/io/evdev_mouse.h"
#include "hal/io/motion_file.h"
#include "hal/mouse/mouse_driver.h"
#include "hal/replay/replay_driver.h"

namespace tandem::hal {
namespace {

constexpr double kMmPerCountMin = 0.001, kMmPerCountMax = 5;

struct MouseWords {
  MouseDriver::Params params;
  bool grab = false;
};

/// What the words say, or all that is wrong with them.
Result<MouseWords> understand_mouse(const DeviceChoice& choice) {
  ChoiceJudge judge{choice, {"mm_per_count", "plane", "grab"}};
  MouseWords words;
  if (const auto mm = judge.number("mm_per_count", kMmPerCountMin, kMmPerCountMax, "mm")) words.params.metres_per_count = 1e-3 * *mm;
  words.params.plane = judge.one_of("plane", {"vertical", "table"}) == "table" ? MouseDriver::Plane::kTable : MouseDriver::Plane::kVertical;
  words.grab = judge.yes_or_no("grab", false);
  if (auto fine = judge.verdict(); !fine) return std::unexpected(std::move(fine.error()));
  return words;
}

/// Empty, or where the recording asks for more than any device gives.
std::string beyond(const sim::RecordedMotion& motion, const std::string& file) {
  const double speed_max = GuardLimits{}.speed_max_m_s;
  const auto found = motion.first_beyond(ReplayDriver::kReach, speed_max);
  if (!found) return {};
  constexpr const char* kAxes[] = {"x", "y", "z"};
  const std::string place = file + ":" + std::to_string(found->line) + ": ";
  if (found->axis < 0)
    return place + format("speed from the row before = %.3g m/s at scale %.4g: must be in [0, %g] m/s, which is what a hand does; give scale=auto or "
                          "a smaller scale, or mend the row",
                          found->value, motion.scale(), speed_max);
  return place + format("%s of the device = %.4g m at scale %.4g: must be in [%g, %g] m, the workspace; give scale=auto or a smaller scale, or mend "
                        "the row",
                        kAxes[found->axis], found->value, motion.scale(), -ReplayDriver::kReach, ReplayDriver::kReach);
}

/// The motion that is meant, or all that is wrong with the words and the file.
Result<std::shared_ptr<const sim::RecordedMotion>> understand_replay(const DeviceChoice& choice) {
  ChoiceJudge judge{choice, {sim::kMotionOptionNames.begin(), sim::kMotionOptionNames.end()}};
  sim::MotionOptions options;
  options.file = choice.name;
  for (const auto& [key, value] : choice.options) {
    if (std::ranges::find(sim::kMotionOptionNames, key) == sim::kMotionOptionNames.end()) continue;  // told by the judge
    if (auto ok = sim::set_motion_option(options, key, value); !ok) judge.mistake(ok.error());
  }
  std::shared_ptr<const sim::RecordedMotion> motion;
  if (choice.name.empty()) {
    judge.mistake("needs a file: replay:FILE.csv");
  } else if (auto loaded = load_motion(options); !loaded) {
    judge.told(loaded.error());
  } else if (const std::string trouble = beyond(**loaded, choice.name); !trouble.empty()) {
    judge.told(trouble);
  } else {
    motion = std::move(*loaded);
  }
  if (auto fine = judge.verdict(); !fine) return std::unexpected(std::move(fine.error()));
  return motion;
}

/// The only mouse there is, or why none.
Result<std::string> only_mouse() {
  const auto found = EvdevMouse::list();
  if (found.empty())
    return std::unexpected(DeviceError{Errc::kNotFound, std::string("mouse: none is attached that the kernel's evdev shows (/dev/input/event*). ") +
                                                             EvdevMouse::kWithout});
  if (found.size() == 1) return found.front().node;
  std::string message = "mouse: there are several; say which one:";
  for (const auto& mouse : found) message += " mouse:" + mouse.node + " (" + (mouse.about.empty() ? "no permission" : mouse.about) + ")";
  if (std::ranges::all_of(found, [](const auto& mouse) { return !mouse.trouble.empty(); })) message += ". " + found.front().trouble;
  return std::unexpected(DeviceError{Errc::kBadState, std::move(message)});
}

}  // namespace

std::string ReplayBackend::library() const { return "none: a file"; }

std::vector<DeviceFact> ReplayBackend::facts() const { return {}; }

Result<> ReplayBackend::check(const DeviceChoice& choice) const {
  auto motion = understand_replay(choice);
  return motion ? Result<>{} : std::unexpected(std::move(motion.error()));
}

Result<OpenedDriver> ReplayBackend::open(const DeviceChoice& choice) {
  auto motion = understand_replay(choice);
  if (!motion) return std::unexpected(std::move(motion.error()));
  const std::string note = choice.name + ": " + (*motion)->describe();
  return OpenedDriver{nullptr, std::make_unique<ReplayDriver>(note, std::move(*motion), clock_), std::nullopt};
}

std::string MouseBackend::library() const { return EvdevMouse::library(); }

std::vector<DeviceFact> MouseBackend::facts() const {
  return {{"firmware", "the mouse keeps its own"},
          {"rate", "as it reports; asked 1000 times a second"},
          {"calibration", "0.1 mm per count; mm_per_count= changes that"},
          {"homing", "needs none: it begins in the middle"},
          {"gravity", "no motors"}};
}

Result<> MouseBackend::check(const DeviceChoice& choice) const {
  const auto words = understand_mouse(choice);
  return words ? Result<>{} : std::unexpected(words.error());
}

Result<std::vector<FoundDevice>> MouseBackend::list() {
  std::vector<FoundDevice> devices;
  for (auto& mouse : EvdevMouse::list()) {
    devices.push_back({"mouse:" + mouse.node, mouse.about.empty() ? "a mouse" : mouse.about, mouse.trouble, "/dev/input/" + mouse.node});
  }
  return devices;
}

Result<OpenedDriver> MouseBackend::open(const DeviceChoice& choice) {
  const auto words = understand_mouse(choice);
  if (!words) return std::unexpected(words.error());
  std::string node = choice.name;
  if (node.empty()) {
    auto only = only_mouse();
    if (!only) return std::unexpected(std::move(only.error()));
    node = std::move(*only);
  }
  auto mouse = EvdevMouse::open(node, words->grab);
  if (!mouse) return std::unexpected(std::move(mouse.error()));
  return OpenedDriver{nullptr, std::make_unique<MouseDriver>(node, std::move(*mouse), clock_, words->params), std::nullopt};
}

}  // namespace tandem::hal
