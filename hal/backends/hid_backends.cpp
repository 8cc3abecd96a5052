#include "hal/backends/hid_backends.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/base/format.h"
#include "common/base/hex.h"
#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"
#include "hal/backends/device_files.h"
#include "hal/drivers/spacemouse/products.h"
#include "hal/drivers/spacemouse/spacemouse_driver.h"
#include "hal/drivers/woodenhaptics/board_report.h"
#include "hal/drivers/woodenhaptics/woodenhaptics_driver.h"
#include "hal/io/enumeration.h"
#include "hal/io/hid_pipe.h"
#include "hal/io/library_versions.h"
#include "hal/io/periodic_timer.h"
#include "hal/io/udev_rule.h"
#include "proto/io/scene_file.h"
#include "proto/text/presets_embedded.h"

namespace tandem::hal {
namespace {

struct HidBus {
  std::unique_ptr<HidrawPipe> pipe;
  MonotonicClock clock;
};

constexpr std::array<UsbIds, 2> kBoards{{{0x1234, 0x0006}, {0x16c0, 0x0486}}};
constexpr HidUsage kBoardUsage{0xffab, 0x0200};

std::vector<FoundDevice> found_among(const std::vector<AttachedDevice>& attached, const std::string& backend,
                                     const std::string& what, const auto& fits) {
  std::vector<FoundDevice> found;
  for (const AttachedDevice& device : attached) {
    if (!fits(device)) continue;
    const bool may = ::access(device.node.c_str(), R_OK | W_OK) == 0;
    const std::string which = !device.port.empty()     ? ":port=" + device.port
                              : !device.serial.empty() ? ":serial=" + device.serial
                                                       : "";
    found.push_back(
        {backend + which, what + ", " + describe(device), may ? "" : permission_advice(device), device.node});
  }
  return found;
}

bool is_board(const AttachedDevice& device) {
  return std::ranges::find(kBoards, device.ids) != kBoards.end() &&
         std::ranges::any_of(device.usages, [](const HidUsage& usage) { return usage.page == kBoardUsage.page; });
}

bool is_spacemouse(const AttachedDevice& device) {
  return std::ranges::any_of(device.usages, [&](const HidUsage& usage) {
    return spacemouse::is_spacemouse(device.ids.vendor, device.ids.product, usage.page, usage.usage);
  });
}

/// Opens the pipe to the chosen device among those that `fits` accepts.
Result<std::pair<AttachedDevice, std::unique_ptr<HidrawPipe>>> open_pipe(const DeviceSpec& choice,
                                                                         const std::string& what, const auto& fits) {
  std::vector<AttachedDevice> fitting;
  for (AttachedDevice& device : list_hidraw()) {
    if (fits(device)) fitting.push_back(std::move(device));
  }
  DeviceFilter wanted{
      .what = what, .ids = {}, .usage = {}, .serial = choice.find("serial"), .port = choice.find("port")};
  auto device = hal::select_device(fitting, wanted);
  if (!device) return std::unexpected(std::move(device.error()));
  auto pipe = HidrawPipe::open(*device);
  if (!pipe) return std::unexpected(std::move(pipe.error()));
  return std::pair{std::move(*device), std::move(*pipe)};
}

std::string preset_names() {
  std::string names;
  for (const EmbeddedFile& preset : shipped_presets()) names += (names.empty() ? "" : ", ") + std::string(preset.name);
  return names;
}

struct Preset {
  WoodenHapticsSpec spec;
  std::string sha256;  ///< of the bytes that `spec` was parsed from
};

/// Loads a shipped preset by its name, or the user's own file.
Result<Preset> load_preset(const std::string& name) {
  const EmbeddedFile* shipped = find_shipped_preset(name);
  std::string text;
  if (shipped != nullptr) {
    text = shipped->text;
  } else if (auto read = read_text_file(name)) {
    text = std::move(*read);
  } else if (name.find_first_of("./") == std::string::npos) {
    return std::unexpected(
        DeviceError{Errc::kUnsupported, "device: woodenhaptics: preset = '" + name.substr(0, 60) +
                                            "': no shipped preset and no such file; shipped: " + preset_names()});
  } else {
    return std::unexpected(DeviceError{Errc::kUnsupported, to_text(read.error())});
  }
  auto file = parse_device_file(text, name);
  if (!file) return std::unexpected(std::move(file.error()));
  if (!file->woodenhaptics) return std::unexpected(wrong_device_kind(name, "woodenhaptics"));
  return Preset{*file->woodenhaptics, to_hex(transport::sha256(bytes_of(text)))};
}

/// Settings of a board from the device specification and its files.
struct Board {
  woodenhaptics::WoodenHapticsOptions options;
  std::string preset, sha256;
};

/// Returns the key under which the motor signs of this device are stored.
/// mbed boards all report the serial number of their library's example, which identifies nothing.
std::string name_of(const AttachedDevice& device) {
  constexpr std::string_view kEverybodys = "0123456789";
  const bool own = !device.serial.empty() && device.serial != kEverybodys;
  std::string name = own ? "serial:" + device.serial : "port:" + device.port;
  std::ranges::replace_if(name, [](char c) { return c <= ' ' || c >= '\x7f'; }, '_');
  return name;
}

/// Returns the board settings of the specification and its files, or all their errors.
Result<Board> parse_board_options(const DeviceSpec& choice) {
  OptionParser judge{choice, {"preset", "enable_motors", "home", "port", "serial"}};
  if (!choice.name.empty())
    judge.add_error("'" + choice.name.substr(0, 60) +
                    "': port= or serial= selects one of several, and preset= selects the mechanism");
  Board board;
  woodenhaptics::WoodenHapticsOptions& options = board.options;
  if (const auto preset = choice.find("preset")) {
    auto loaded = load_preset(*preset);
    if (loaded) {
      options.spec = loaded->spec;
      board.preset = *preset;
      board.sha256 = std::move(loaded->sha256);
    } else {
      judge.add_lines(std::move(loaded.error().message));
    }
  } else {
    judge.add_error("needs preset=NAME or preset=FILE: the board does not report its mechanism; known: " +
                    preset_names());
  }
  options.enable_motors = judge.yes_or_no("enable_motors", false);
  options.home_at_start = choice.find("home").has_value() && judge.one_of("home", {"here"}) == "here";
  return judge.result_with(std::move(board));
}

Result<SpaceMouseSpec> parse_spacemouse_options(const DeviceSpec& choice) {
  OptionParser judge{choice, {"port", "serial", "calibration"}};
  if (!choice.name.empty())
    judge.add_error("'" + choice.name.substr(0, 60) + "': port= or serial= selects one of several");
  SpaceMouseSpec spec;
  if (const auto file = choice.find("calibration")) {
    auto described = load_device_file(*file);
    if (!described) {
      judge.add_lines(std::move(described.error().message));
    } else if (!described->spacemouse) {
      judge.add_lines(wrong_device_kind(*file, "spacemouse").message);
    } else {
      spec = *described->spacemouse;
    }
  }
  return judge.result_with(spec);
}

}  // namespace

std::string_view WoodenHapticsBackend::help() const noexcept {
  return "  woodenhaptics:preset=NAME|FILE,enable_motors=yes[,home=here][,port=P][,serial=S]\n"
         "                              WoodenHaptics, AluHaptics, Polhem v1; without enable_motors=yes, and before\n"
         "                              `doctor --confirm-motors`, no current flows.\n"
         "                              home=here: the arm rests in its calibration pose now\n";
}

std::string WoodenHapticsBackend::library() const { return library_of(Bus::kHidraw); }

std::vector<DeviceFact> WoodenHapticsBackend::facts() const {
  return {{"firmware", "the board keeps its own"},
          {"rate", "1000 Hz; V2 and RAW64 in lock-step, V1 free-running"},
          {"calibration", "by the preset; without `measured` in it forces are limited to a tenth"},
          {"motors",
           "no force before `tandem-client doctor --device ... --confirm-motors` confirmed the direction of each"},
          {"homing", "at every start: calibration pose, then the board's button or home=here"},
          {"gravity", "gravity compensation of the arms, if the preset has weight { carried: true }"}};
}

Result<> WoodenHapticsBackend::check(const DeviceSpec& choice) const {
  return without_value(parse_board_options(choice));
}

Result<std::vector<FoundDevice>> WoodenHapticsBackend::list() {
  return found_among(list_hidraw(), "woodenhaptics", "probably a WoodenHaptics board (its USB id is not unique)",
                     is_board);
}

std::vector<std::string> WoodenHapticsBackend::udev_rules() const {
  std::vector<std::string> rules;
  for (const UsbIds& ids : kBoards) rules.push_back(udev_rule(Bus::kHidraw, ids));
  return rules;
}

Result<OpenedDriver> WoodenHapticsBackend::open(const DeviceSpec& choice) {
  const auto understood = parse_board_options(choice);
  if (!understood) return std::unexpected(understood.error());
  const woodenhaptics::WoodenHapticsOptions& options = understood->options;
  auto opened_pipe = open_pipe(choice, "WoodenHaptics board", is_board);
  if (!opened_pipe) return std::unexpected(std::move(opened_pipe.error()));
  auto& [device, pipe] = *opened_pipe;

  OpenedDriver opened;
  auto bus = std::make_shared<HidBus>();
  bus->pipe = std::move(pipe);
  opened.driver = std::make_unique<woodenhaptics::WoodenHapticsDriver>(DeviceId{"woodenhaptics", device.port},
                                                                       *bus->pipe, bus->clock, options);
  opened.bus = std::move(bus);
  if (options.enable_motors) {
    opened.signs = SignFile{name_of(device), understood->preset, understood->sha256, {"base", "shoulder", "elbow"}};
  } else {
    opened.note = "no current flows without enable_motors=yes: this arm only reports its position";
  }
  if (const auto fd = find_open_file(device.node)) {
    ShutdownFrame words;  // report id 0, then a report of zeros: no current
    words.fd = *fd;
    words.size = 1 + woodenhaptics::report_size(options.spec.protocol);
    opened.shutdown_frame = words;
  }
  return opened;
}

std::string_view SpaceMouseBackend::help() const noexcept {
  return "  spacemouse[:port=P][,serial=S][,calibration=FILE]\n"
         "                              3Dconnexion SpaceMouse: moves the hand's point, gives no force\n";
}

std::string SpaceMouseBackend::library() const { return library_of(Bus::kHidraw); }

std::vector<DeviceFact> SpaceMouseBackend::facts() const {
  return {{"firmware", "the device keeps its own"},
          {"rate", "62 to 125 reports a second while it is moved, none at rest"},
          {"calibration", "0.1 m/s and 0.5 rad/s at full deflection; calibration=FILE changes that"},
          {"homing", "needs none: it reports velocity, not position"},
          {"gravity", "no motors"},
          {"battery", "wireless ones report it now and then; `doctor --device` shows it"}};
}

Result<> SpaceMouseBackend::check(const DeviceSpec& choice) const {
  return without_value(parse_spacemouse_options(choice));
}

Result<std::vector<FoundDevice>> SpaceMouseBackend::list() {
  return found_among(list_hidraw(), "spacemouse", "3Dconnexion SpaceMouse", is_spacemouse);
}

std::vector<std::string> SpaceMouseBackend::udev_rules() const {
  std::vector<std::string> rules;
  for (const auto& product : spacemouse::kProducts) {
    if (product.vendor != spacemouse::k3Dconnexion)
      rules.push_back(udev_rule(Bus::kHidraw, {product.vendor, product.product}));
  }
  // The vendor rule covers future SpaceMouse products too. The vendor's mice and keyboards are excluded.
  rules.push_back(udev_vendor_rule(spacemouse::k3Dconnexion));
  for (const std::uint16_t product : spacemouse::kExcluded)
    rules.push_back(udev_no_rule({spacemouse::k3Dconnexion, product}));
  return rules;
}

Result<OpenedDriver> SpaceMouseBackend::open(const DeviceSpec& choice) {
  const auto spec = parse_spacemouse_options(choice);
  if (!spec) return std::unexpected(spec.error());
  auto opened_pipe = open_pipe(choice, "3Dconnexion SpaceMouse", is_spacemouse);
  if (!opened_pipe) return std::unexpected(std::move(opened_pipe.error()));
  auto& [device, pipe] = *opened_pipe;
  OpenedDriver opened;
  auto bus = std::make_shared<HidBus>();
  bus->pipe = std::move(pipe);
  opened.driver =
      std::make_unique<spacemouse::SpaceMouseDriver>(DeviceId{"spacemouse", device.port}, *bus->pipe, bus->clock, *spec,
                                                     spacemouse::axes_of(device.ids.vendor, device.ids.product));
  opened.bus = std::move(bus);
  opened.note = format("full deflection is %g m/s and %g rad/s%s", spec->speed, spec->turn,
                       choice.find("calibration") ? "" : "; calibration=FILE changes that");
  return opened;
}

}  // namespace tandem::hal
