#include "client/app/motor_confirmation.h"

#include <atomic>
#include <chrono>
#include <cstdio>

#include "client/app/device_list.h"
#include "client/app/hardware_device.h"
#include "client/app/interruptible_wait.h"
#include "client/app/motor_registry_file.h"
#include "client/app/terminal_prompt.h"
#include "client/diagnostics/motor_check.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "hal/core/driver_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kCheckLimit = 90s;  ///< longer than the check of all motors can take
constexpr Duration kOrderLife =
    3ms;  ///< lifetime of a command, so that a stall of this program does not extend a pulse

int fail(const std::string& why, int code = io::kExitTrouble) {
  io::print_formatted(stderr, "tandem-client doctor: %s\n", why.c_str());
  return code;
}

/// Runs a MotorCheck on the device's thread, from `begin` to `end`.
class PulseClient final : public hal::ServoClient {
 public:
  explicit PulseClient(const hal::DeviceCaps& caps) : check_(caps.joints, hal::peak_of(caps), io::monotonic_now()) {}

  hal::Command tick(const hal::State& state) noexcept override {
    if (ended_.load(std::memory_order_acquire)) return {};
    const Time now = io::monotonic_now();
    hal::Command command{++seq_, now + kOrderLife, hal::CommandKind::kJointEffort, check_.step(now, state)};
    if (check_.finished()) ended_.store(true, std::memory_order_release);
    return command;
  }
  void lost(hal::Errc) noexcept override { lost_.store(true); }

  void end() noexcept { ended_.store(true, std::memory_order_release); }
  [[nodiscard]] bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  [[nodiscard]] bool was_lost() const noexcept { return lost_.load(); }
  /// @pre the device is closed
  [[nodiscard]] const MotorCheck& check() const noexcept { return check_; }

 private:
  MotorCheck check_;
  std::atomic<bool> ended_{false}, lost_{false};
  std::uint64_t seq_ = 0;
};

std::string question(const hal::SignFile& signs, double peak) {
  return format(
      "The motors of this arm (%s) now get pulses, one motor at a time: at most 30 ms each, at most %.1f N at the "
      "tip.\n"
      "Put the arm into the middle of its workspace. Let it rest there, or hold it loosely so that it does not fall. "
      "Keep face and\n"
      "other hands away, and the switch of its power in reach. Ctrl-C ends it at any moment.",
      signs.device.c_str(), hal::kConfirmingShare * peak);
}

}  // namespace

int confirm_motors(const std::string& device, const std::string& state) {
  const MotorRegistryFile book{state};
  if (const std::string unfit = book.storage_error(); !unfit.empty())
    return fail("--state: the result could not be stored, so the check was not started: " + unfit);
  const io::Fd signals = io::make_signalfd();
  io::StatusLine line{false};
  auto held = HardwareDevice::open(device, signals.get(), line, {.state = state, .being_confirmed = true});
  if (!held) return fail(held.error().reason, held.error().invalid_spec ? io::kExitUsage : io::kExitTrouble);
  const auto& signs = (*held)->signs();
  if (!signs)
    return fail(
        "--confirm-motors: there is nothing to confirm: the motor directions of this device do not come from a file, "
        "or its motors are disabled (woodenhaptics needs enable_motors=yes)",
        io::kExitUsage);
  hal::Device& arm = (*held)->device();
  if (!user_confirms(question(*signs, hal::peak_of(arm.caps())), signals.get())) {
    const std::string by{io::pending_signal()};
    return fail(by.empty() ? "the answer was not yes: no force was given, nothing was confirmed"
                           : "ended by " + by + ": no force was given, nothing was confirmed");
  }
  PulseClient pulser{arm.caps()};
  (*held)->observe(pulser);
  if (auto enabled = arm.enable(); !enabled) {
    arm.close();
    return fail(enabled.error().message);
  }
  const bool whole =
      wait_unless_interrupted(kCheckLimit, signals.get(), [&] { return pulser.ended() || pulser.was_lost(); });
  pulser.end();
  arm.disable();
  arm.close();  // sends zeros; the device thread no longer calls `pulser`
  if (!whole) return fail("ended by " + std::string(io::pending_signal()) + ": nothing was confirmed");
  if (pulser.was_lost()) return fail("the device was unplugged: nothing was confirmed");

  for (const auto& finding : pulser.check().findings(signs->motors)) io::print(stdout, finding_line(finding));
  const bool right = pulser.check().finished() && pulser.check().all_right();
  if (const std::string wrong = book.store(*signs, right); !wrong.empty())
    return fail("the result was not stored, so the device gives no force: " + wrong);
  if (right) {
    io::print_formatted(stdout,
                        "All motors push in the directions that %s states. The result is stored for this device (%s) "
                        "and this exact file; the device may give forces now.\n",
                        signs->name.c_str(), signs->device.c_str());
  } else {
    io::print_formatted(stdout, "Not confirmed: this device gives no force with this file.\n");
  }
  return right ? 0 : io::kExitTrouble;
}

}  // namespace tandem::client
