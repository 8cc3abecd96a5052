#include "hal/app/input_backends.h"

#include <charconv>
#include <cmath>

#include "hal/io/evdev_mouse.h"
#include "hal/io/motion_file.h"
#include "hal/mouse/mouse_driver.h"
#include "hal/replay/replay_driver.h"

namespace tandem::hal {
namespace {

constexpr double kMmPerCountMin = 0.001, kMmPerCountMax = 5;

std::unexpected<DeviceError> wrong(std::string message) {
  return std::unexpected(DeviceError{Errc::kUnsupported, "device: " + std::move(message)});
}

Result<MouseDriver::Params> params_of(const DeviceChoice& choice) {
  MouseDriver::Params params;
  if (const auto text = choice.find("mm_per_count")) {
    double mm = 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), mm);
    if (error != std::errc{} || end != text->data() + text->size() || !(mm >= kMmPerCountMin && mm <= kMmPerCountMax))
      return wrong("mm_per_count is a number in [0.001, 5] mm, not '" + text->substr(0, 60) + "'");
    params.metres_per_count = 1e-3 * mm;
  }
  if (const auto plane = choice.find("plane")) {
    if (*plane != "vertical" && *plane != "table") return wrong("plane is 'vertical' or 'table', not '" + plane->substr(0, 60) + "'");
    params.plane = *plane == "table" ? MouseDriver::Plane::kTable : MouseDriver::Plane::kVertical;
  }
  return params;
}

/// The only mouse there is, or why none.
Result<std::string> only_mouse() {
  const auto found = EvdevMouse::list();
  if (found.empty())
    return std::unexpected(DeviceError{Errc::kNotFound, "mouse: none is attached that the kernel's evdev shows (/dev/input/event*)"});
  if (found.size() == 1) return found.front().node;
  std::string message = "mouse: there are several; say which one:";
  for (const auto& mouse : found) message += " mouse:" + mouse.node + " (" + (mouse.about.empty() ? "no permission" : mouse.about) + ")";
  return std::unexpected(DeviceError{Errc::kBadState, std::move(message)});
}

}  // namespace

Result<OpenedDriver> ReplayBackend::open(const DeviceChoice& choice) {
  if (auto ok = only_these(choice, {sim::kMotionOptionNames.begin(), sim::kMotionOptionNames.end()}); !ok)
    return std::unexpected(std::move(ok.error()));
  if (choice.name.empty()) return wrong("replay needs a file: replay:FILE.csv");
  sim::MotionOptions options;
  options.file = choice.name;
  for (const auto& [key, value] : choice.options)
    if (auto ok = sim::set_motion_option(options, key, value); !ok) return wrong("replay: " + ok.error());
  auto motion = load_motion(options);
  if (!motion) return wrong("replay: " + motion.error());
  const std::string note = choice.name + ": " + (*motion)->describe();
  return OpenedDriver{nullptr, std::make_unique<ReplayDriver>(note, std::move(*motion), clock_), std::nullopt};
}

Result<std::vector<FoundDevice>> MouseBackend::list() {
  std::vector<FoundDevice> devices;
  for (auto& mouse : EvdevMouse::list()) devices.push_back({"mouse:" + mouse.node, mouse.about, mouse.trouble});
  return devices;
}

Result<OpenedDriver> MouseBackend::open(const DeviceChoice& choice) {
  if (auto ok = only_these(choice, {"mm_per_count", "plane", "grab"}); !ok) return std::unexpected(std::move(ok.error()));
  const auto params = params_of(choice);
  if (!params) return std::unexpected(params.error());
  const auto grab = yes_or_no(choice, "grab", false);
  if (!grab) return std::unexpected(grab.error());
  std::string node = choice.name;
  if (node.empty()) {
    auto only = only_mouse();
    if (!only) return std::unexpected(std::move(only.error()));
    node = std::move(*only);
  }
  auto mouse = EvdevMouse::open(node, *grab);
  if (!mouse) return std::unexpected(std::move(mouse.error()));
  return OpenedDriver{nullptr, std::make_unique<MouseDriver>(node, std::move(*mouse), clock_, *params), std::nullopt};
}

}  // namespace tandem::hal
