#include "client/app/motor_confirming.h"

#include <poll.h>

#include <atomic>
#include <chrono>
#include <cstdio>

#include "client/app/ask_person.h"
#include "client/app/held_device.h"
#include "client/app/motor_state.h"
#include "client/motor_check.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "hal/driver_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kTrouble = 1, kWrong = 2;
constexpr Duration kCheckLimit = 90s;  ///< longer than every motor can take
constexpr Duration kOrderLife = 3ms;   ///< a program that stands still does not make a pulse longer

int fail(const std::string& why, int code = kTrouble) {
  io::printf_for_people(stderr, "tandem-client doctor: %s\n", why.c_str());
  return code;
}

/// Lets the check order pulses from the device's thread, from `begin` to `end`.
class Pulser final : public hal::ServoClient {
 public:
  explicit Pulser(const hal::DeviceCaps& caps) : check_(caps.joints, hal::peak_of(caps), io::monotonic_now()) {}

  hal::Command tick(const hal::State& state) noexcept override {
    if (ended_.load(std::memory_order_acquire)) return {};
    const Time now = io::monotonic_now();
    hal::Command command{++seq_, now + kOrderLife, hal::CommandKind::kJointEffort, check_.step(now, state)};
    if (check_.over()) ended_.store(true, std::memory_order_release);
    return command;
  }
  void lost(hal::Errc) noexcept override { lost_.store(true); }

  void end() noexcept { ended_.store(true, std::memory_order_release); }
  [[nodiscard]] bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  [[nodiscard]] bool was_lost() const noexcept { return lost_.load(); }
  /// After the device was closed.
  [[nodiscard]] const MotorCheck& check() const noexcept { return check_; }

 private:
  MotorCheck check_;
  std::atomic<bool> ended_{false}, lost_{false};
  std::uint64_t seq_ = 0;
};

std::string question(const hal::SignFile& signs, double peak) {
  return format("The motors of this arm (%s) now get pulses, one motor at a time: at most 30 ms each, at most %.1f N at the tip.\n"
                "Put the arm into the middle of its workspace. Let it rest there, or hold it loosely so that it does not fall. Keep face and\n"
                "other hands away, and the switch of its power in reach. Ctrl-C ends it at any moment.",
                signs.device.c_str(), hal::kConfirmingShare * peak);
}

/// Waits until the check is over. @return false: a signal came
bool watch(const Pulser& pulser, int signals) {
  const Time end = io::monotonic_now() + kCheckLimit;
  while (!pulser.ended() && !pulser.was_lost() && io::monotonic_now() < end) {
    pollfd file{signals, POLLIN, 0};
    if (poll(&file, 1, 20) > 0) return false;
  }
  return true;
}

}  // namespace

int confirm_motors(const std::string& device, const std::string& state) {
  const MotorState book{state};
  if (const std::string unfit = book.unfit_to_keep(); !unfit.empty()) return fail("--state: the result could not be kept, so nothing was begun: " + unfit);
  const io::Fd signals = io::signals_as_file();
  io::StatusLine line{false};
  auto held = HeldDevice::take(device, signals.get(), line, {.state = state, .being_confirmed = true});
  if (!held) return fail(held.error().reason, held.error().wrong_words ? kWrong : kTrouble);
  const auto& signs = (*held)->signs();
  if (!signs)
    return fail("--confirm-motors: there is nothing to confirm: the directions of this device's motors come from no file, or no current may flow "
                "(woodenhaptics needs energise=yes)", kWrong);
  hal::Device& arm = (*held)->device();
  if (!person_agrees(question(*signs, hal::peak_of(arm.caps())), signals.get())) {
    const std::string by{io::signal_that_came()};
    return fail(by.empty() ? "nobody agreed: no force was given, nothing was confirmed" : "ended by " + by + ": no force was given, nothing was confirmed");
  }
  Pulser pulser{arm.caps()};
  (*held)->observe(pulser);
  if (auto enabled = arm.enable(); !enabled) {
    arm.close();
    return fail(enabled.error().message);
  }
  const bool whole = watch(pulser, signals.get());
  pulser.end();
  arm.disable();
  arm.close();  // zeros; nothing calls the pulser any more
  if (!whole) return fail("ended by " + std::string(io::signal_that_came()) + ": nothing was confirmed");
  if (pulser.was_lost()) return fail("the device was unplugged: nothing was confirmed");

  for (const auto& finding : pulser.check().findings(signs->motors)) {
    static constexpr const char* kMarks[] = {"  ok      ", "  notice  ", "  TROUBLE "};
    io::printf_for_people(stdout, "%s%s\n", kMarks[static_cast<std::size_t>(finding.kind)], finding.words.c_str());
  }
  const bool right = pulser.check().over() && pulser.check().all_right();
  if (const std::string wrong = book.keep(*signs, right); !wrong.empty()) return fail("the result was not kept, so no force will come: " + wrong);
  if (right) {
    io::printf_for_people(stdout, "All motors push the way %s says. That is kept for this device (%s) and this very file; forces may come now.\n", signs->name.c_str(),
                signs->device.c_str());
  } else {
    io::printf_for_people(stdout, "Not confirmed: no force will come of this device with this file.\n");
  }
  return right ? 0 : kTrouble;
}

}  // namespace tandem::client
