#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/app/device_list.h"
#include "client/app/hardware_device.h"
#include "client/app/interruptible_wait.h"
#include "client/app/motor_confirmation.h"
#include "client/diagnostics/device_diagnostics.h"
#include "common/io/child_program.h"
#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "hal/backends/backend.h"
#include "hal/io/hotplug.h"
#include "hal/io/udev_rule.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using Kind = DeviceDiagnostics::Finding::Kind;

struct DoctorArguments {
  std::string device, seconds = "5", root, state;
  bool force_test = false, confirm = false, install = false, watch = false;
};

void print(const DeviceDiagnostics::Finding& finding) { io::print(stdout, finding_line(finding)); }

void print(const hal::DeviceFact& fact) { io::print(stdout, fact_line(fact)); }

/// Prints which signal ended the examination.
void print_interruption() {
  const std::string by{io::pending_signal()};
  io::print_formatted(stdout, "ended by %s: the findings are incomplete\n", by.c_str());
}

bool has_fault(const std::vector<DeviceDiagnostics::Finding>& findings) {
  return std::ranges::any_of(findings, [](const auto& f) { return f.kind == Kind::kTrouble; });
}

/// Runs the diagnostics on the device's thread.
class DiagnosticsClient final : public hal::ServoClient {
 public:
  explicit DiagnosticsClient(const hal::DeviceCaps& caps)
      : joints_(std::min(caps.joints, kAxesMax)), diagnostics_(caps), caps_(caps) {}

  hal::Command tick(const hal::State& state) noexcept override {
    if (watching_.load(std::memory_order_acquire)) diagnostics_.update(state);
    if (!push_.load(std::memory_order_acquire)) return {};
    const Time now = io::monotonic_now();
    if (!test_) test_.emplace(caps_, now);
    if (test_->finished(now)) done_.store(true, std::memory_order_release);
    const hal::Vec3 force = test_->step(now, state);
    hal::Command command{++seq_, now + 5ms, hal::CommandKind::kJointEffort, {}};
    for (std::size_t j = 0; j < joints_; ++j) command.effort[j] = state.J.col(static_cast<Eigen::Index>(j)).dot(force);
    return command;
  }
  void lost(hal::Errc) noexcept override { lost_.store(true); }

  /// Ends the diagnostics, so that later readings, such as those of a force test, are not examined.
  void end_watch() noexcept { watching_.store(false, std::memory_order_release); }
  void push() noexcept { push_.store(true, std::memory_order_release); }
  [[nodiscard]] bool pushed() const noexcept { return done_.load(std::memory_order_acquire); }
  [[nodiscard]] bool was_lost() const noexcept { return lost_.load(); }
  /// Results of the diagnostics and of the force test. @pre the device is closed
  [[nodiscard]] const DeviceDiagnostics& examination() const noexcept { return diagnostics_; }
  [[nodiscard]] const std::optional<ForceTest>& force_test() const noexcept { return test_; }

 private:
  std::size_t joints_;
  DeviceDiagnostics diagnostics_;
  hal::DeviceCaps caps_;
  std::optional<ForceTest> test_;
  std::atomic<bool> watching_{true}, push_{false}, done_{false}, lost_{false};
  std::uint64_t seq_ = 0;
};

int diagnose(const DoctorArguments& arguments, double seconds) {
  const io::Fd signals = io::make_signalfd();
  io::StatusLine line{false};
  auto held = HardwareDevice::open(arguments.device, signals.get(), line, {.state = arguments.state});
  if (!held) {
    io::print_formatted(stderr, "tandem-client doctor: %s\n", held.error().reason.c_str());
    return held.error().invalid_spec ? io::kExitUsage : io::kExitTrouble;
  }
  hal::Device& device = (*held)->device();
  DiagnosticsClient client{device.caps()};
  io::print_formatted(
      stdout, "%s: move the grip in all directions and press its buttons, for %.0f s. The device gives no force.\n",
      (*held)->note().c_str(), seconds);
  print(hal::DeviceFact{"library", (*held)->library()});
  print(hal::DeviceFact{"permission", "it could be opened"});
  std::fflush(stdout);
  const Time begin = io::monotonic_now();
  (*held)->observe(client);
  bool whole = wait_unless_interrupted(from_seconds(seconds), signals.get(), [&] { return client.was_lost(); });
  const double watched = tandem::seconds(io::monotonic_now() - begin);
  client.end_watch();
  const hal::DeviceStats stats = device.stats();
  std::vector<DeviceDiagnostics::Finding> findings;  // of the force test

  if (const std::string& why = (*held)->no_force_reason(); !why.empty()) {
    findings.push_back({arguments.force_test ? Kind::kTrouble : Kind::kNotice, why});
  } else if (whole && arguments.force_test && !client.was_lost()) {
    io::print_formatted(
        stdout, "force test: hold the grip loosely in the middle of its workspace; six soft pushes of %.1f N follow\n",
        ForceTest::kForce);
    std::fflush(stdout);
    if (auto ok = device.enable(); !ok) {
      findings.push_back({Kind::kTrouble, "force test: " + ok.error().message});
    } else {
      whole = wait_unless_interrupted(1s, signals.get(), [&] { return client.was_lost(); });
      client.push();
      whole =
          whole && wait_unless_interrupted(10s, signals.get(), [&] { return client.pushed() || client.was_lost(); });
      device.disable();
    }
  }
  device.close();
  const auto watch = client.examination().findings(stats, watched);
  findings.insert(findings.begin(), watch.begin(), watch.end());
  if (client.force_test() && whole) {
    for (auto& finding : client.force_test()->findings()) findings.push_back(std::move(finding));
  }
  if (client.was_lost())
    findings.push_back({Kind::kTrouble, "the device was unplugged, or disappeared, during the examination"});
  for (const auto& finding : findings) print(finding);
  if (!whole) print_interruption();
  return whole && !has_fault(findings) ? 0 : io::kExitTrouble;
}

int list_all() {
  bool trouble = false;
  std::size_t found = 0;
  io::print_formatted(stdout, "looked with:\n");
  for (const hal::Backend* backend : hal::backends())
    if (backend->name() != "replay") print(hal::DeviceFact{std::string(backend->name()), backend->library()});
  for (hal::Backend* backend : hal::backends()) {
    const auto listed = backend->list();
    if (!listed) {
      print({Kind::kNotice, std::string(backend->name()) + ": " + listed.error().message});
      continue;
    }
    for (const hal::FoundDevice& device : *listed) {
      ++found;
      std::string lines = describe(*backend, device);
      lines.pop_back();  // print() adds a line feed
      print({device.problem.empty() ? Kind::kGood : Kind::kTrouble, std::move(lines)});
      trouble = trouble || !device.problem.empty();
    }
  }
  if (found == 0) {
    io::print_formatted(stdout,
                        "No device that Tandem supports is attached. Check cable and power; `lsusb` lists the USB "
                        "devices that the system sees.\n"
                        "Without a device, `--device sim` uses a simulated one.\n");
    return io::kExitTrouble;
  }
  io::print_formatted(stdout, "`tandem-client doctor --device SPEC` examines one of them.\n");
  return trouble ? io::kExitTrouble : 0;
}

/// Prints attached and removed devices until a signal arrives.
int watch_hotplug() {
  const io::Fd signals = io::make_signalfd();
  auto watch = hal::HotplugMonitor::open();
  if (!watch) {
    io::print_formatted(stderr, "tandem-client doctor: %s\n", watch.error().message.c_str());
    return io::kExitTrouble;
  }
  io::print_formatted(stdout, "plug devices in and out; Ctrl-C ends\n");
  for (const hal::AttachedDevice& device : (*watch)->present())
    io::print_formatted(stdout, "  present   %s\n", describe(device).c_str());
  std::fflush(stdout);
  do {
    for (const hal::HotplugEvent& change : (*watch)->wait(200ms)) {
      io::print_formatted(stdout, "  %s  %s\n", change.arrived ? "added   " : "removed ",
                          describe(change.device).c_str());
      std::fflush(stdout);
    }
  } while (wait_unless_interrupted(1ms, signals.get(), [] { return false; }));
  return 0;
}

std::string all_rules() {
  std::string rules =
      "# The user who is logged in at this computer may use the haptic devices that Tandem supports. Written by "
      "`tandem-client doctor`.\n";
  for (hal::Backend* backend : hal::backends()) {
    for (const std::string& rule : backend->udev_rules()) rules += rule + "\n";
  }
  return rules;
}

/// Installs the udev rules. @param root  root directory of the target system; empty: this system
int install_rules(const std::string& root) {
  const std::string rules = all_rules(), name = root + hal::kUdevRulesFile;
  std::error_code none;  // a failure shows in `open` below
  if (!root.empty()) std::filesystem::create_directories(std::filesystem::path(name).parent_path(), none);
  io::OutputFile file;
  std::string problem = file.open(name, false);
  file.write(rules);
  if (problem.empty()) problem = file.close();
  if (!problem.empty()) {
    // With its folder, because sudo searches only the folders of its secure_path.
    const std::string advice = "Run it as root: sudo " + io::program_path("tandem-client") + " doctor --install-udev\n";
    io::print_formatted(stderr, "tandem-client doctor: %s\n%sIt would contain:\n", problem.c_str(),
                        root.empty() && geteuid() != 0 ? advice.c_str() : "");
    std::fputs(rules.c_str(), stderr);  // byte for byte, not wrapped
    return io::kExitTrouble;
  }
  io::print_formatted(stdout, "%s is written. %s\n", name.c_str(),
                      root.empty()
                          ? "Now: udevadm control --reload && udevadm trigger, or unplug the device and plug it in."
                          : "The rules take effect when that system runs.");
  return 0;
}

int doctor_command(const DoctorArguments& arguments) {
  io::UsageErrors errors;
  const double seconds = errors.number("--seconds", arguments.seconds, 0.5, 600, "s");
  if (arguments.force_test && arguments.device.empty())
    errors.add("--force-test: needs --device; forces are sent only to a device that the command line names");
  if (arguments.confirm && arguments.device.empty())
    errors.add("--confirm-motors: needs --device; forces are sent only to a device that the command line names");
  if (arguments.confirm && (arguments.force_test || arguments.watch))
    errors.add("--confirm-motors: cannot be combined with --force-test or --watch; run it first");
  if (arguments.install && (!arguments.device.empty() || arguments.force_test || arguments.confirm || arguments.watch))
    errors.add("--install-udev: can be combined only with --root");
  if (!arguments.root.empty() && !arguments.install) errors.add("--root: needs --install-udev");
  if (arguments.watch && (!arguments.device.empty() || arguments.force_test))
    errors.add("--watch: cannot be combined with --device or --force-test");
  if (!arguments.device.empty() && !HardwareDevice::is_hardware_spec(arguments.device))
    errors.add("--device: doctor examines real devices, and this one is simulated");
  if (arguments.device.starts_with("replay")) {
    errors.add("--device: doctor examines real devices, and this one is a recording");
  } else if (HardwareDevice::is_hardware_spec(arguments.device) && !arguments.device.empty()) {
    errors.add(HardwareDevice::spec_errors(arguments.device));
  }
  if (const auto choice = hal::parse_device_spec(arguments.device); arguments.confirm && errors.empty() && choice) {
    if (choice->backend != "woodenhaptics")
      errors.add("--confirm-motors: '" + choice->backend +
                 "': only woodenhaptics devices read the directions of their motors from a file");
    else if (choice->find("enable_motors") != "yes")
      errors.add("--confirm-motors: needs enable_motors=yes in --device: without it no current flows");
  }
  if (!errors.empty()) return errors.report("tandem-client doctor");
  if (arguments.install) return install_rules(arguments.root);
  if (arguments.watch) return watch_hotplug();
  if (arguments.confirm) return confirm_motors(arguments.device, arguments.state);
  return arguments.device.empty() ? list_all() : diagnose(arguments, seconds);
}

}  // namespace

void add_doctor_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("doctor", "Lists haptic devices, reports their problems and the remedies.", doctor_command);
  command.add_option("--device", arguments.device, "examines this device; the specification is that of `join --device`")
      .value_name("SPEC");
  command.add_option("--seconds", arguments.seconds, "how long to watch while you move it; default 5").value_name("S");
  command.add_flag("--force-test", arguments.force_test,
                   "then pushes your hand softly (0.5 N) along each axis, both ways");
  command.add_flag(
      "--confirm-motors", arguments.confirm,
      "asks you, then sends each motor pulses of at most 30 ms and checks whether it pushes in the direction that the "
      "device's file states; before this check, a device whose directions come from a file gives no force");
  add_state_option(command, arguments.state, "folder with the record of confirmed motors");
  command.add_flag("--watch", arguments.watch,
                   "reports devices that are plugged in and out, on USB and among HID devices");
  command.add_flag("--install-udev", arguments.install,
                   "writes the udev rules that let the logged-in user use the devices; needs root");
  command
      .add_option(
          "--root", arguments.root,
          "with --install-udev: root folder of another system, such as an image; the file goes to DIR/etc/udev/rules.d")
      .value_name("DIR");
  command.footer(
      "Exit: 0 all is well; 1 trouble was found, or no device; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-client doctor\n"
      "  tandem-client doctor --device woodenhaptics:preset=aluhaptics-v2 --seconds 10\n"
      "  tandem-client doctor --device woodenhaptics:preset=mine.textproto,enable_motors=yes,home=here "
      "--confirm-motors\n"
      "  sudo $(which tandem-client) doctor --install-udev");
}

}  // namespace tandem::client
