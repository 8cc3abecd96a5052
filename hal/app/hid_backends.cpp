#include "hal/app/hid_backends.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/base/format.h"
#include "common/link/digest.h"
#include "hal/app/device_files.h"
#include "hal/io/attached.h"
#include "hal/io/hid_pipe.h"
#include "hal/io/library_versions.h"
#include "hal/io/servo_pace.h"
#include "hal/io/udev_rule.h"
#include "hal/spacemouse/products.h"
#include "hal/spacemouse/spacemouse_driver.h"
#include "hal/woodenhaptics/board_report.h"
#include "hal/woodenhaptics/woodenhaptics_driver.h"
#include "proto/io/scene_file.h"
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
    found.push_back({backend + which, what + ", " + describe(device), may ? "" : permission_advice(device), device.node});
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

struct Preset {
  WoodenHapticsSpec spec;
  std::string sha256;  ///< of the very bytes that `spec` was made from
};

/// A shipped preset by its name, or a person's own file.
Result<Preset> load_preset(const std::string& name) {
  const ShippedPreset* shipped = find_shipped_preset(name);
  std::string text;
  if (shipped != nullptr) {
    text = shipped->text;
  } else if (auto read = read_text_file(name)) {
    text = std::move(*read);
  } else if (name.find_first_of("./") == std::string::npos) {
    return std::unexpected(DeviceError{Errc::kUnsupported, "device: woodenhaptics: preset = '" + name.substr(0, 60) +
                                                               "': no shipped preset and no such file; shipped: " + preset_names()});
  } else {
    return std::unexpected(DeviceError{Errc::kUnsupported, to_text(read.error())});
  }
  auto file = understand_device_file(text, name);
  if (!file) return std::unexpected(std::move(file.error()));
  if (!file->woodenhaptics) return std::unexpected(says_nothing_of(name, "woodenhaptics"));
  link::Digest digest;
  digest.add(text);
  return Preset{*file->woodenhaptics, digest.hex()};
}

/// What the words and their files say.
struct Board {
  woodenhaptics::WoodenHapticsOptions options;
  std::string preset, sha256;
};

/// The name under which the motors of this very device are remembered. mbed boards all tell the serial number of their library's
/// example, which tells nothing.
std::string name_of(const Attached& device) {
  constexpr std::string_view kEverybodys = "0123456789";
  const bool own = !device.serial.empty() && device.serial != kEverybodys;
  std::string name = own ? "serial:" + device.serial : "port:" + device.port;
  std::ranges::replace_if(name, [](char c) { return c <= ' ' || c >= '\x7f'; }, '_');
  return name;
}

/// What the words and their files say, or all that is wrong with them.
Result<Board> understand_board(const DeviceChoice& choice) {
  ChoiceJudge judge{choice, {"preset", "energise", "home", "port", "serial"}};
  if (!choice.name.empty()) judge.mistake("'" + choice.name.substr(0, 60) + "': several are told apart by port= or serial=; a mechanism is named by preset=");
  Board board;
  woodenhaptics::WoodenHapticsOptions& options = board.options;
  if (const auto preset = choice.find("preset")) {
    auto loaded = load_preset(*preset);
    if (loaded) {
      options.spec = loaded->spec;
      board.preset = *preset;
      board.sha256 = std::move(loaded->sha256);
    } else {
      judge.told(std::move(loaded.error().message));
    }
  } else {
    judge.mistake("needs preset=NAME or preset=FILE: which mechanism hangs on the board nobody can see from here; known: " + preset_names());
  }
  options.energise = judge.yes_or_no("energise", false);
  options.home_at_start = choice.find("home").has_value() && judge.one_of("home", {"here"}) == "here";
  if (auto fine = judge.verdict(); !fine) return std::unexpected(std::move(fine.error()));
  return board;
}

Result<SpaceMouseSpec> understand_puck(const DeviceChoice& choice) {
  ChoiceJudge judge{choice, {"port", "serial", "calibration"}};
  if (!choice.name.empty()) judge.mistake("'" + choice.name.substr(0, 60) + "': several are told apart by port= or serial=");
  SpaceMouseSpec spec;
  if (const auto file = choice.find("calibration")) {
    auto described = load_device_file(*file);
    if (!described) {
      judge.told(std::move(described.error().message));
    } else if (!described->spacemouse) {
      judge.told(says_nothing_of(*file, "spacemouse").message);
    } else {
      spec = *described->spacemouse;
    }
  }
  if (auto fine = judge.verdict(); !fine) return std::unexpected(std::move(fine.error()));
  return spec;
}

}  // namespace

std::string_view WoodenHapticsBackend::help() const noexcept {
  return "  woodenhaptics:preset=NAME|FILE,energise=yes[,home=here][,port=P][,serial=S]\n"
         "                              WoodenHaptics, AluHaptics, Polhem v1; without energise=yes, and before\n"
         "                              `doctor --confirm-motors`, no current flows.\n"
         "                              home=here: the arm rests in its calibration pose now\n";
}

std::string WoodenHapticsBackend::library() const { return library_of(Bus::kHidraw); }

std::vector<DeviceFact> WoodenHapticsBackend::facts() const {
  return {{"firmware", "the board keeps its own"},
          {"rate", "1000 Hz; V2 and RAW64 in lock-step, V1 free-running"},
          {"calibration", "by the preset; without `measured` in it forces are kept to a tenth"},
          {"motors", "no force before `tandem-client doctor --device ... --confirm-motors` saw each push the way it is told"},
          {"homing", "at every start: calibration pose, then the board's button or home=here"},
          {"gravity", "the motors carry the arms if the preset says weight { carried: true }"}};
}

Result<> WoodenHapticsBackend::check(const DeviceChoice& choice) const {
  auto understood = understand_board(choice);
  return understood ? Result<>{} : std::unexpected(std::move(understood.error()));
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
  const auto understood = understand_board(choice);
  if (!understood) return std::unexpected(understood.error());
  const woodenhaptics::WoodenHapticsOptions& options = understood->options;
  auto opened_pipe = open_pipe(choice, "WoodenHaptics board", is_board);
  if (!opened_pipe) return std::unexpected(std::move(opened_pipe.error()));
  auto& [device, pipe] = *opened_pipe;

  OpenedDriver opened;
  auto bus = std::make_shared<HidBus>();
  bus->pipe = std::move(pipe);
  opened.driver = std::make_unique<woodenhaptics::WoodenHapticsDriver>(DeviceId{"woodenhaptics", device.port}, *bus->pipe, bus->clock, options);
  opened.bus = std::move(bus);
  if (options.energise) {
    opened.signs = SignFile{name_of(device), understood->preset, understood->sha256, {"base", "shoulder", "elbow"}};
  } else {
    opened.note = "no current flows without energise=yes: this arm only says where it is";
  }
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

std::string SpaceMouseBackend::library() const { return library_of(Bus::kHidraw); }

std::vector<DeviceFact> SpaceMouseBackend::facts() const {
  return {{"firmware", "the puck keeps its own"},
          {"rate", "62 to 125 reports a second while it is moved, none at rest"},
          {"calibration", "0.1 m/s and 0.5 rad/s at full deflection; calibration=FILE changes that"},
          {"homing", "needs none: it says how fast, not where"},
          {"gravity", "no motors"},
          {"battery", "wireless ones report it now and then; `doctor --device` shows it"}};
}

Result<> SpaceMouseBackend::check(const DeviceChoice& choice) const {
  auto understood = understand_puck(choice);
  return understood ? Result<>{} : std::unexpected(std::move(understood.error()));
}

Result<std::vector<FoundDevice>> SpaceMouseBackend::list() {
  return found_among(list_hidraw(), "spacemouse", "3Dconnexion puck", is_puck);
}

std::vector<std::string> SpaceMouseBackend::udev_rules() const {
  std::vector<std::string> rules;
  for (const auto& product : spacemouse::kProducts) {
    if (product.vendor != spacemouse::k3Dconnexion) rules.push_back(udev_rule(Bus::kHidraw, {product.vendor, product.product}));
  }
  // 3Dconnexion's own id: also pucks that are newer than our list. Its mice and keyboards are nobody's business.
  rules.push_back(udev_vendor_rule(spacemouse::k3Dconnexion));
  for (const std::uint16_t product : spacemouse::kExcluded) rules.push_back(udev_no_rule({spacemouse::k3Dconnexion, product}));
  return rules;
}

Result<OpenedDriver> SpaceMouseBackend::open(const DeviceChoice& choice) {
  const auto spec = understand_puck(choice);
  if (!spec) return std::unexpected(spec.error());
  auto opened_pipe = open_pipe(choice, "3Dconnexion puck", is_puck);
  if (!opened_pipe) return std::unexpected(std::move(opened_pipe.error()));
  auto& [device, pipe] = *opened_pipe;
  OpenedDriver opened;
  auto bus = std::make_shared<HidBus>();
  bus->pipe = std::move(pipe);
  opened.driver = std::make_unique<spacemouse::SpaceMouseDriver>(DeviceId{"spacemouse", device.port}, *bus->pipe, bus->clock, *spec,
                                                                  spacemouse::axes_of(device.ids.vendor, device.ids.product));
  opened.bus = std::move(bus);
  opened.note = format("full deflection is %g m/s and %g rad/s%s", spec->speed, spec->turn,
                       choice.find("calibration") ? "" : "; calibration=FILE changes that");
  return opened;
}

}  // namespace tandem::hal
