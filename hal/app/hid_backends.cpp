#include "hal/app/hid_backends.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "hal/app/device_files.h"
#include "hal/io/attached.h"
#include "hal/io/hid_pipe.h"
#include "hal/io/servo_pace.h"
#include "hal/io/udev_rule.h"
#include "hal/spacemouse/products.h"
#include "hal/spacemouse/spacemouse_driver.h"
#include "hal/woodenhaptics/board_report.h"
#include "hal/woodenhaptics/woodenhaptics_driver.h"
#include "proto/presets_embedded.h"

namespace tandem::hal {
namespace {

struct HidBus {
  std::unique_ptr<HidrawPipe> pipe;
  MonotonicClock clock;
};

constexpr std::array<UsbIds, 2> kBoards{{{0x1234, 0x0006}, {0x16c0, 0x0486}}};
constexpr HidUsage kBoardUsage{0xffab, 0x0200};

std::vector<FoundDevice> found_among(const std::vector<Attached>& attached, const std::string& backend, const std::string& what,
                                     const auto& fits) {
  std::vector<FoundDevice> found;
  for (const Attached& device : attached) {
    if (!fits(device)) continue;
    const bool may = ::access(device.node.c_str(), R_OK | W_OK) == 0;
    const std::string which = !device.port.empty() ? ":port=" + device.port : !device.serial.empty() ? ":serial=" + device.serial : "";
    found.push_back({backend + which, what + ", " + describe(device), may ? "" : permission_advice(device)});
  }
  return found;
}

bool is_board(const Attached& device) {
  return std::ranges::find(kBoards, device.ids) != kBoards.end() &&
         std::ranges::any_of(device.usages, [](const HidUsage& usage) { return usage.page == kBoardUsage.page; });
}

bool is_puck(const Attached& device) {
  return std::ranges::any_of(device.usages, [&](const HidUsage& usage) {
    return spacemouse::is_puck(device.ids.vendor, device.ids.product, usage.page, usage.usage);
  });
}

/// The pipe to the chosen one of those that fit.
Result<std::pair<Attached, std::unique_ptr<HidrawPipe>>> open_pipe(const DeviceChoice& choice, const std::string& what, const auto& fits) {
  std::vector<Attached> fitting;
  for (Attached& device : list_hidraw()) {
    if (fits(device)) fitting.push_back(std::move(device));
  }
  Wanted wanted{.what = what, .ids = {}, .usage = {}, .serial = choice.find("serial"), .port = choice.find("port")};
  auto device = hal::choose(fitting, wanted);
  if (!device) return std::unexpected(std::move(device.error()));
  auto pipe = HidrawPipe::open(*device);
  if (!pipe) return std::unexpected(std::move(pipe.error()));
  return std::pair{std::move(*device), std::move(*pipe)};
}

std::string preset_names() {
  std::string names;
  for (const ShippedPreset& preset : shipped_presets()) names += (names.empty() ? "" : ", ") + std::string(preset.name);
  return names;
}

/// A shipped preset by its name, or a person's own file.
Result<WoodenHapticsSpec> load_preset(const std::string& name) {
  const ShippedPreset* shipped = find_shipped_preset(name);
  auto file = shipped != nullptr ? read_shipped(*shipped) : load_device_file(name);
  if (!file) {
    if (shipped == nullptr && name.find_first_of("./") == std::string::npos)
      return std::unexpected(DeviceError{Errc::kUnsupported, "device: no shipped preset '" + name.substr(0, 60) + "' and no such file; shipped: " + preset_names()});
    return std::unexpected(std::move(file.error()));
  }
  if (!file->woodenhaptics)
    return std::unexpected(DeviceError{Errc::kUnsupported, name + ": says nothing of a woodenhaptics: write woodenhaptics { ... }"});
  return *file->woodenhaptics;
}

}  // namespace

std::string_view WoodenHapticsBackend::help() const noexcept {
  return "  woodenhaptics:preset=NAME|FILE,energise=yes[,home=here][,port=P][,serial=S]\n"
         "                              WoodenHaptics, AluHaptics, Polhem v1; without energise=yes no current flows.\n"
         "                              home=here: the arm rests in its calibration pose now\n";
}

Result<std::vector<FoundDevice>> WoodenHapticsBackend::list() {
  return found_among(list_hidraw(), "woodenhaptics", "what looks like a WoodenHaptics board (its USB id is not unique)", is_board);
}

std::vector<std::string> WoodenHapticsBackend::udev_rules() const {
  std::vector<std::string> rules;
  for (const UsbIds& ids : kBoards) rules.push_back(udev_rule(Bus::kHidraw, ids));
  return rules;
}

Result<OpenedDriver> WoodenHapticsBackend::open(const DeviceChoice& choice) {
  if (auto known = only_these(choice, {"preset", "energise", "home", "port", "serial"}); !known) return std::unexpected(known.error());
  woodenhaptics::WoodenHapticsOptions options;
  const auto preset = choice.find("preset");
  if (!preset)
    return std::unexpected(DeviceError{Errc::kUnsupported, "device: woodenhaptics needs preset=NAME or preset=FILE: which mechanism "
                                                           "hangs on the board nobody can see from here; known: " + preset_names()});
  auto spec = load_preset(*preset);
  if (!spec) return std::unexpected(std::move(spec.error()));
  options.spec = *spec;
  const auto energise = yes_or_no(choice, "energise", false);
  if (!energise) return std::unexpected(energise.error());
  options.energise = *energise;
  if (const auto home = choice.find("home")) {
    if (*home != "here") return std::unexpected(DeviceError{Errc::kUnsupported, "device: home is 'here', not '" + home->substr(0, 60) + "'"});
    options.home_at_start = true;
  }
  auto opened_pipe = open_pipe(choice, "WoodenHaptics board", is_board);
  if (!opened_pipe) return std::unexpected(std::move(opened_pipe.error()));
  auto& [device, pipe] = *opened_pipe;

  OpenedDriver opened;
  auto bus = std::make_shared<HidBus>();
  bus->pipe = std::move(pipe);
  opened.driver = std::make_unique<woodenhaptics::WoodenHapticsDriver>(DeviceId{"woodenhaptics", device.port}, *bus->pipe, bus->clock, options);
  opened.bus = std::move(bus);
  if (!options.energise) opened.note = "no current flows without energise=yes: this arm only says where it is";
  if (const auto fd = open_file_of(device.node)) {
    LastWords words;  // report number 0, then a report of zeros: no current
    words.fd = *fd;
    words.size = 1 + woodenhaptics::report_size(options.spec.protocol);
    opened.last_words = words;
  }
  return opened;
}

std::string_view SpaceMouseBackend::help() const noexcept {
  return "  spacemouse[:port=P][,serial=S][,calibration=FILE]\n"
         "                              3Dconnexion puck: moves the hand's point, feels nothing\n";
}

Result<std::vector<FoundDevice>> SpaceMouseBackend::list() {
  return found_among(list_hidraw(), "spacemouse", "3Dconnexion puck", is_puck);
}

std::vector<std::string> SpaceMouseBackend::udev_rules() const {
  std::vector<std::string> rules;
  for (const auto& product : spacemouse::kProducts) rules.push_back(udev_rule(Bus::kHidraw, {product.vendor, product.product}));
  return rules;
}

Result<OpenedDriver> SpaceMouseBackend::open(const DeviceChoice& choice) {
  if (auto known = only_these(choice, {"port", "serial", "calibration"}); !known) return std::unexpected(known.error());
  SpaceMouseSpec spec;
  if (const auto file = choice.find("calibration")) {
    auto described = load_device_file(*file);
    if (!described) return std::unexpected(std::move(described.error()));
    if (!described->spacemouse)
      return std::unexpected(DeviceError{Errc::kUnsupported, *file + ": says nothing of a spacemouse: write spacemouse { ... }"});
    spec = *described->spacemouse;
  }
  auto opened_pipe = open_pipe(choice, "3Dconnexion puck", is_puck);
  if (!opened_pipe) return std::unexpected(std::move(opened_pipe.error()));
  auto& [device, pipe] = *opened_pipe;
  OpenedDriver opened;
  auto bus = std::make_shared<HidBus>();
  bus->pipe = std::move(pipe);
  opened.driver = std::make_unique<spacemouse::SpaceMouseDriver>(DeviceId{"spacemouse", device.port}, *bus->pipe, bus->clock, spec);
  opened.bus = std::move(bus);
  return opened;
}

}  // namespace tandem::hal
