#include "client/app/hardware_device.h"

#include <poll.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "client/app/motor_registry_file.h"
#include "client/app/terminal_prompt.h"
#include "common/io/clock.h"
#include "common/io/signals.h"
#include "hal/backends/backend.h"
#include "hal/io/device_thread.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kDevicePollMs = 100;

/// True if a signal is pending within `wait_ms` [ms]. Does not consume it, because ended_by_signal() reads its name.
bool interrupted(int signals, int wait_ms) {
  pollfd file{signals, POLLIN, 0};
  return poll(&file, 1, wait_ms) > 0;
}

std::string ended_by_signal() {
  return "ended by " + std::string(io::pending_signal()) + " before the device was ready";
}

class Progress final : public hal::BringUp {
 public:
  Progress(int signals, io::StatusLine& line) : signals_(signals), line_(line) {}
  bool request_user_action(std::string_view request) override {
    line_.clear();
    return wait_for_enter(std::string(request), signals_);
  }
  void progress(std::string_view step, double fraction) override {
    line_.show(std::string(step) + " " + std::to_string(std::lround(100 * fraction)) + " %");
  }
  bool cancelled() const noexcept override { return cancelled_ = cancelled_ || interrupted(signals_, 0); }

 private:
  int signals_;
  io::StatusLine& line_;
  mutable bool cancelled_ = false;
};

const char* how_to_home(hal::Homing homing) {
  switch (homing) {
    case hal::Homing::kManual:
      return "home the device: pull the grip out as far as it goes, then push it in as far as it goes, slowly";
    case hal::Homing::kPresetPose:
      return "home the device: hold it in its calibration pose and press its calibration button";
    case hal::Homing::kInkwell:
      return "home the device: put the stylus into the inkwell";
    case hal::Homing::kResetPose:
      return "the device has no position reference and gets no force: end this program, put the device into its reset "
             "pose (all links at right angles) and start again with `,home=here` after its name, or from a terminal, "
             "where the program asks for the pose";
    case hal::Homing::kAuto:
    case hal::Homing::kNone:
      break;
  }
  return "the device finds its origin by itself; keep your hand off";
}

/// Returns why the device gets no force; empty if the motor registry confirms its motors for this device file.
std::string why_no_force(const hal::SignFile& signs, const MotorRegistryFile& state, std::string_view device) {
  const auto known = state.find(signs);
  if (known && *known && (*known)->confirmed) return {};
  const std::string what =
      "this device gives no force: the directions of its motors come from " + signs.name + ", and ";
  const std::string why = !known    ? "the confirmed motors cannot be read: " + known.error()
                          : !*known ? "they were never confirmed on this device (" + signs.device + ") with this file"
                                    : "the last `doctor --confirm-motors` on this device (" + signs.device +
                                          ") did not confirm all of them";
  return what + why + ". Type:\n  " + state.command(device);
}

}  // namespace

bool HardwareDevice::is_hardware_spec(std::string_view spec) { return spec.substr(0, spec.find(':')) != "sim"; }

std::vector<std::string> HardwareDevice::spec_errors(std::string_view spec) {
  const auto choice = hal::parse_device_spec(spec);
  constexpr std::string_view kAbout = "device: ";  // repeated by the option's own prefix
  std::string lines;
  if (!choice) {
    lines = choice.error().message;
  } else if (const auto backend = hal::find_backend(choice->backend); !backend) {
    lines = backend.error().message;
  } else if (const auto checked = (*backend)->check(*choice); !checked) {
    lines = checked.error().message;
  }
  std::vector<std::string> all;
  std::istringstream text(lines);
  for (std::string line; std::getline(text, line);)
    all.push_back("--device: " + line.substr(line.starts_with(kAbout) ? kAbout.size() : 0));
  return all;
}

std::expected<std::unique_ptr<HardwareDevice>, HardwareDevice::Failure> HardwareDevice::open(std::string_view spec,
                                                                                             int signals,
                                                                                             io::StatusLine& line,
                                                                                             const Motors& motors) {
  const auto failed = [](const hal::DeviceError& error, bool invalid_spec) {
    return std::unexpected(Failure{.invalid_spec = invalid_spec, .reason = error.message});
  };
  const auto choice = hal::parse_device_spec(spec);
  if (!choice) return failed(choice.error(), true);
  const auto backend = hal::find_backend(choice->backend);
  if (!backend) return failed(backend.error(), true);
  auto opened = (*backend)->open(*choice);
  if (!opened) {
    // An invalid firmware file counts as an invalid specification.
    const hal::Errc code = opened.error().code;
    return failed(opened.error(), code == hal::Errc::kUnsupported || code == hal::Errc::kFirmware);
  }

  std::unique_ptr<HardwareDevice> held{new HardwareDevice};
  held->bus_ = opened->bus;
  held->library_ = (*backend)->library();
  if (!opened->note.empty()) line.note(opened->note);
  if (opened->shutdown_frame) {
    auto deadman = hal::WatchdogProcess::start({&*opened->shutdown_frame, 1});
    if (!deadman) return failed(deadman.error(), false);
    held->watchdog_ = std::move(*deadman);
  }
  held->signs_ = std::move(opened->signs);
  auto signs = motors.being_confirmed ? hal::MotorSigns::kBeingConfirmed : hal::MotorSigns::kUnconfirmed;
  if (held->signs_ && !motors.being_confirmed) {
    held->no_force_ = why_no_force(*held->signs_, MotorRegistryFile{motors.state}, spec);
    if (held->no_force_.empty()) signs = hal::MotorSigns::kConfirmed;
    if (!held->no_force_.empty()) line.warn(held->no_force_);
  }
  auto core = std::make_unique<hal::ServoCore>(std::move(opened->driver), signs);
  Progress progress{signals, line};
  if (auto up = core->bring_up(progress); !up) {
    core->send_zeros();
    line.clear();
    const bool ended = progress.cancelled();
    return std::unexpected(Failure{.interrupted = ended, .reason = ended ? ended_by_signal() : up.error().message});
  }
  line.clear();
  if (!held->watchdog_ && core->limits().peak_n > 0)
    line.note(
        "no watchdog process protects this device: if this program is killed, only the device's own watchdog removes "
        "its force");
  held->note_ = core->id().backend + " " + core->id().key;
  if (!held->no_force_.empty()) held->note_ += ", no force: its motors are not confirmed";
  if (!core->caps().force_calibrated) held->note_ += ", force scale not calibrated: limited to a tenth";
  held->device_ = std::make_unique<hal::DeviceThread>(std::move(core), kPeriod,
                                                      held->watchdog_ ? &held->watchdog_->heartbeat() : nullptr);
  if (auto started = held->device_->start(held->client_); !started) return failed(started.error(), false);
  if (auto homed = held->wait_until_homed(signals, line); !homed) return std::unexpected(homed.error());
  return held;
}

HardwareDevice::~HardwareDevice() {
  if (device_) device_->close();
}

std::expected<void, HardwareDevice::Failure> HardwareDevice::wait_until_homed(int signals, io::StatusLine& line) {
  const Time begin = io::monotonic_now();
  bool asked = false;
  while (device_->phase() != hal::Phase::kReady) {
    if (client_.was_lost()) return std::unexpected(Failure{.reason = note_ + ": unplugged while it was being homed"});
    if (device_->phase() == hal::Phase::kFault)
      return std::unexpected(
          Failure{.reason = note_ + ": stopped answering while it was being homed; unplug it, plug it in, try again"});
    const bool waited = io::monotonic_now() - begin > std::chrono::milliseconds(kDevicePollMs);
    if (waited && !std::exchange(asked, true)) line.note(how_to_home(device_->caps().homing));
    if (interrupted(signals, kDevicePollMs / 10))
      return std::unexpected(Failure{.interrupted = true, .reason = ended_by_signal()});
  }
  if (asked) line.note("homed");
  return {};
}

hal::DeviceCaps HardwareDevice::caps() const {
  return device_->caps().input == hal::InputKind::kRate ? RateControlAdapter::adapted_caps(device_->caps())
                                                        : device_->caps();
}

bool HardwareDevice::watchdog_lost() { return watchdog_ && !watchdog_->alive(); }

}  // namespace tandem::client
