#include "hal/drivers/openhaptics/touch_group.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::hal::openhaptics {

namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t kPriorityMax = 0xffff;
constexpr int kErrorsMax = 32;  // errors read at a time; bounds the loop, although the vendor's stack is finite
constexpr std::uint64_t kHomeEvery = 50;  // cycles between two checks of the calibration
constexpr Duration kQuietMax = 50ms;
constexpr std::size_t kMotorsMax = 6;
constexpr unsigned kWarmCycles = 1000;  // the library reports warm motors once, when it removes a force

std::uint32_t on_cycle(void* group) {
  static_cast<TouchGroup*>(group)->cycle();
  return 1;
}

std::string text(const char* from_library) { return from_library == nullptr ? "" : from_library; }

bool finite(const std::array<double, 3>& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// Returns whether the device finds its origin only by an encoder reset in a known pose.
bool only_by_reset(std::uint32_t styles) noexcept {
  return (styles & id::kStyleEncoderReset) != 0 && (styles & (id::kStyleAuto | id::kStyleInkwell)) == 0;
}

/// Returns the device's name for messages.
std::string called(const std::string& name) { return name.empty() ? "the default device" : "'" + name + "'"; }

bool is_gone(std::uint32_t code) noexcept {
  return code == error::kDeviceFault || code == error::kCommunication || code == error::kCommunicationConfig;
}

}  // namespace

TouchGroup::~TouchGroup() {
  stop();
  for (std::size_t i = 0; i < kMax; ++i) {
    if (slots_[i].used && !slots_[i].last.lost) api_->disable_device(slots_[i].handle);
  }
}

DeviceError TouchGroup::trouble(const ErrorInfo& e, const std::string& name) const {
  const std::string said =
      format(" (the library says: 0x%04x %s, internal %d)", e.code, text(api_->error_text(e.code)).c_str(), e.internal);
  const std::string who = "openhaptics: " + called(name) + " ";
  switch (e.code) {
    case error::kLicence:
      return {
          Errc::kPermission,
          "openhaptics: the library has no valid licence here; install the one you were given by the vendor" + said};
    case error::kAlreadyInitiated:
      return {
          Errc::kBusy,
          who +
              "is in use by another program, or a program that used it was killed; end it, or unplug the device and "
              "plug it in again" +
              said};
    case error::kCommunication:
    case error::kCommunicationConfig:
      return {
          Errc::kNotFound,
          who +
              "does not answer: check that it is plugged in and powered, that the vendor's set-up tool has it under "
              "that name, and that you may read and write its node (/dev/ttyACM* or /dev/hidraw*). `sudo $(which "
              "tandem-client) doctor --install-udev` writes the rule. Older installations call their device 'Default "
              "PHANToM'" +
              said};
    case error::kDeviceFault:
      return {Errc::kUnplugged, who + "has a fault; unplug it, plug it in again" + said};
    default:
      return {Errc::kInternal, who + "cannot be opened" + said};
  }
}

void TouchGroup::forget_errors() noexcept {
  for (int i = 0; i < kErrorsMax && api_->get_error().code != 0; ++i) {
  }
}

std::optional<double> TouchGroup::ask(std::uint32_t what) noexcept {
  double value = std::nan("");
  api_->get_double(what, &value);
  if (api_->get_error().code != 0) {
    forget_errors();
    return std::nullopt;
  }
  return std::isfinite(value) && value > 0 ? std::optional{value} : std::nullopt;
}

Result<> TouchGroup::reset_encoders(const std::string& name) {
  api_->update_calibration(id::kStyleEncoderReset);
  if (const ErrorInfo e = api_->get_error(); e.code != 0) {
    forget_errors();
    return std::unexpected(trouble(e, name));
  }
  return {};
}

Result<TouchGroup::DeviceInfo> TouchGroup::add(const std::string& name, const std::function<bool()>& rests_there) {
  const auto free = std::ranges::find_if(slots_, [](const Slot& s) { return !s.used; });
  if (free == slots_.end())
    return std::unexpected(DeviceError{Errc::kBusy, format("openhaptics: at most %zu devices in one program", kMax)});
  stop();
  forget_errors();
  Handle handle = init(name);
  ErrorInfo failed = api_->get_error();
  if (failed.code == error::kAlreadyInitiated) {  // after an unclean exit: disable the device and try once more
    forget_errors();
    if (handle != kInvalidHandle) api_->disable_device(handle);
    if (failed.device != kInvalidHandle && failed.device != handle) api_->disable_device(failed.device);
    forget_errors();
    handle = init(name);
    failed = api_->get_error();
  }
  const auto restart = [this] { return std::ranges::any_of(slots_, &Slot::used) ? start() : Result<>{}; };
  if (failed.code != 0 || handle == kInvalidHandle) {
    forget_errors();
    [[maybe_unused]] const auto others = restart();
    return std::unexpected(trouble(failed, name));
  }

  DeviceInfo about;
  about.slot = static_cast<std::size_t>(free - slots_.begin());
  api_->make_current(handle);
  about.model = text(api_->get_string(id::kModel));
  about.serial = text(api_->get_string(id::kSerial));
  about.version = text(api_->get_string(id::kVersion));
  forget_errors();
  std::int32_t sensed = 0, actuated = 0, style = 0;
  api_->get_int(id::kInputDof, &sensed);
  api_->get_int(id::kOutputDof, &actuated);
  api_->get_int(id::kCalibrationStyle, &style);
  forget_errors();
  if (sensed < 3 || actuated < 3) {
    api_->disable_device(handle);
    [[maybe_unused]] const auto others = restart();
    return std::unexpected(
        DeviceError{Errc::kUnsupported, format("openhaptics: %s senses %d and moves %d axes; three of each are needed",
                                               called(name).c_str(), sensed, actuated)});
  }
  about.calibration = static_cast<std::uint32_t>(style);
  about.force_max = ask(id::kForceMax);
  about.force_continuous = ask(id::kForceContinuous);
  std::array<double, 6> box{};
  api_->get_double(id::kWorkspaceUsable, box.data());  // [mm], HDAPI frame
  if (api_->get_error().code == 0 && std::ranges::all_of(box, [](double v) { return std::isfinite(v); }) &&
      box[0] < box[3] && box[1] < box[4] && box[2] < box[5])
    about.workspace = {1e-3 * box[0], -1e-3 * box[5], 1e-3 * box[1], 1e-3 * box[3], -1e-3 * box[2], 1e-3 * box[4]};
  forget_errors();
  double temperatures[16] = {};
  api_->get_double(id::kMotorTemperature, temperatures);
  if (api_->get_error().code == 0 && std::isfinite(temperatures[0]))
    about.motors = std::min<std::size_t>(static_cast<std::size_t>(actuated), kMotorsMax);
  forget_errors();
  for (const auto what : {id::kForceOutput, id::kForceClamping, id::kForceLimit, id::kForceRamping}) api_->enable(what);
  if (const ErrorInfo e = api_->get_error(); e.code != 0) {
    forget_errors();
    api_->disable_device(handle);
    [[maybe_unused]] const auto others = restart();
    return std::unexpected(trouble(e, name));
  }
  const bool reset = only_by_reset(about.calibration) && rests_there();
  if (reset) {
    api_->make_current(handle);
    if (auto done = reset_encoders(name); !done) {
      api_->disable_device(handle);
      forget_errors();
      [[maybe_unused]] const auto others = restart();
      return std::unexpected(std::move(done.error()));
    }
  }
  Slot& slot = *free;
  slot.used = true;
  slot.reset = reset;
  slot.handle = handle;
  slot.calibration = about.calibration;
  slot.force_max = about.force_max.value_or(0);
  slot.motors = about.motors;
  slot.warm = 0;
  slot.last = {};
  slot.command_number = 0;
  slot.command_age = kCommandCycles;
  slot.commands.write({});
  slot.samples.write({});
  if (auto ok = start(); !ok) {
    remove(about.slot);
    return std::unexpected(ok.error());
  }
  return about;
}

void TouchGroup::remove(std::size_t i) noexcept {
  Slot& slot = slots_[i];
  if (!slot.used) return;
  stop();
  slot.used = false;
  if (!slot.last.lost) api_->disable_device(slot.handle);
  forget_errors();
  if (std::ranges::any_of(slots_, &Slot::used)) [[maybe_unused]]
    const auto others = start();
}

void TouchGroup::stop() noexcept {
  if (!scheduled_) return;
  // The motors keep their last force when no callback runs. Three cycles of zeros are therefore sent first.
  quiet_.store(true, std::memory_order_release);
  const std::uint64_t enough = cycles_.load(std::memory_order_acquire) + 4;  // the cycle in progress may have missed it
  for (const Time end = clock_->now() + kQuietMax;
       cycles_.load(std::memory_order_acquire) < enough && clock_->now() < end;)
    clock_->wait_until(clock_->now() + 500us);
  api_->stop_scheduler();
  api_->unschedule(*scheduled_);
  scheduled_.reset();
  forget_errors();
  for (Slot& slot : slots_) slot.command_age = kCommandCycles;  // commands from before the stop must not act after it
}

Result<> TouchGroup::start() {
  quiet_.store(false, std::memory_order_release);
  api_->set_scheduler_rate(1000);
  forget_errors();  // if the rate is not supported, the default of 1 kHz remains
  scheduled_ = api_->schedule(&on_cycle, this, kPriorityMax);
  api_->start_scheduler();
  if (const ErrorInfo e = api_->get_error(); e.code != 0) {
    forget_errors();
    api_->stop_scheduler();
    api_->unschedule(*scheduled_);
    scheduled_.reset();
    return std::unexpected(trouble(e, "scheduler"));
  }
  return {};
}

void TouchGroup::cycle() noexcept {
  for (Slot& slot : slots_) {
    if (slot.used && !slot.last.lost) serve(slot);
  }
  cycles_.fetch_add(1, std::memory_order_release);
}

void TouchGroup::serve(Slot& slot) noexcept {
  Sample& s = slot.last;
  s.error = 0;
  s.limited = false;
  ++s.cycle;
  api_->make_current(slot.handle);
  take_errors(slot);
  if (!s.lost) {
    api_->begin_frame(slot.handle);
    double x[3] = {}, v[3] = {};
    // Larger than a Touch's six encoders: an unknown model may write more.
    std::int32_t encoders[16] = {}, buttons = 0;
    api_->get_double(id::kPosition, x);
    api_->get_double(id::kVelocity, v);
    api_->get_int(id::kEncoders, encoders);
    api_->get_int(id::kButtons, &buttons);
    take_errors(slot);
    const TouchCommand& command = slot.commands.read();
    if (!s.lost) {
      to_hal(x, s.x.data());
      to_hal(v, s.v.data());
      for (std::size_t i = 0; i < 3; ++i) {
        s.x[i] *= 1e-3;
        s.v[i] *= 1e-3;
        s.encoders[i] = encoders[i];
      }
      s.buttons = static_cast<std::uint32_t>(buttons);
      feel_heat(slot);
      home(slot, command.homing);
      s.force = force_for(slot, command);
      double force[3];
      to_hd(s.force.data(), force);
      api_->set_double(id::kForce, force);
    }
    api_->end_frame(
        slot.handle);  // also for a device that was just lost: an open frame would affect the frames of the others
    take_errors(slot);
    s.limited = s.limited || s.error != 0;  // the library does not report how much force it removed
  }
  if (s.lost) s.force = {};
  slot.samples.write(s);
}

/// Reads the temperature of the hottest motor; NaN stays NaN, because the temperature is then unknown.
/// A warm-motor error counts as 1, also on devices that report no temperature.
void TouchGroup::feel_heat(Slot& slot) noexcept {
  Sample& s = slot.last;
  s.heat.reset();
  if (slot.motors > 0) {
    double temperatures[16] = {};  // an unknown model may write more values than it has motors
    api_->get_double(id::kMotorTemperature, temperatures);
    double hottest = temperatures[0];
    for (std::size_t i = 1; i < slot.motors && !std::isnan(hottest); ++i)
      if (!(temperatures[i] <= hottest)) hottest = temperatures[i];
    s.heat = hottest;
  }
  if (slot.warm == 0) return;
  --slot.warm;
  if (!s.heat || *s.heat < 1) s.heat = 1;
}

std::array<double, 3> TouchGroup::force_for(Slot& slot, const TouchCommand& command) noexcept {
  Sample& s = slot.last;
  slot.command_age = command.number == slot.command_number ? std::min(slot.command_age + 1, kCommandCycles) : 0;
  slot.command_number = command.number;
  s.command_seq = 0;
  // The commanding thread may have ended while this cycle, on the vendor's thread, continues.
  if (slot.command_age >= kCommandCycles || quiet_.load(std::memory_order_acquire) || !s.homed || s.error != 0 ||
      !finite(command.force) || !finite(s.x)) {
    s.limited = s.limited || s.error != 0;
    return {};
  }
  s.command_seq = command.seq;
  std::array<double, 3> f = command.force;
  const double n = std::hypot(f[0], f[1], f[2]);
  if (n > slot.force_max) {
    s.limited = true;
    for (double& component : f) component *= slot.force_max / n;
  }
  return f;
}

void TouchGroup::home(Slot& slot, bool asked) noexcept {
  Sample& s = slot.last;
  // A calibration change moves the origin. It must never happen under force, so it is done only on request.
  if (!asked || s.homed || s.cycle % kHomeEvery != 1) return;
  // Another program's reset pose is unknown. A wrong origin would cause wrong forces.
  if (only_by_reset(slot.calibration) && !slot.reset) return;
  switch (api_->check_calibration()) {
    case id::kCalibrationOk:
      s.homed = true;
      break;
    case id::kCalibrationUpdate: {
      // Automatic styles come first. An encoder reset is never done here: that happens before the servo starts.
      const auto style = slot.calibration;
      if ((style & (id::kStyleAuto | id::kStyleInkwell)) != 0)
        api_->update_calibration((style & id::kStyleAuto) != 0 ? id::kStyleAuto : id::kStyleInkwell);
      break;
    }
    default:  // needs the user: the inkwell
      break;
  }
  take_errors(slot);
}

void TouchGroup::take_errors(Slot& current) noexcept {
  for (int i = 0; i < kErrorsMax; ++i) {
    const ErrorInfo e = api_->get_error();
    if (e.code == 0) return;
    Slot* whose = &current;
    for (Slot& slot : slots_) {
      if (slot.used && slot.handle == e.device) whose = &slot;
    }
    whose->last.error = e.code;
    if (e.code == error::kWarmMotors) whose->warm = kWarmCycles;
    if (is_gone(e.code) || (whose == &current && e.code == error::kUnknownHandle)) {
      whose->last.lost = true;
      if (whose != &current) {
        whose->last.force = {};
        whose->samples.write(whose->last);
      }
    }
  }
}

}  // namespace tandem::hal::openhaptics
