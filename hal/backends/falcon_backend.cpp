#include "hal/backends/falcon_backend.h"

#include <unistd.h>

#include <utility>

#include "hal/backends/device_files.h"
#include "hal/drivers/falcon/falcon_driver.h"
#include "hal/drivers/falcon/falcon_frame.h"
#include "hal/io/enumeration.h"
#include "hal/io/library_versions.h"
#include "hal/io/periodic_timer.h"
#include "hal/io/udev_rule.h"
#include "hal/io/usb_pipe.h"

namespace tandem::hal {
namespace {

constexpr UsbIds kFalcon{0x0403, 0xcb48};

struct FalconBus {
  std::unique_ptr<LibusbPipe> pipe;
  MonotonicClock clock;
};

DeviceFilter wanted(const DeviceSpec& choice) {
  return {.what = "Novint Falcon",
          .ids = {kFalcon},
          .usage = {},
          .serial = choice.find("serial"),
          .port = choice.find("port")};
}

/// Returns the options of the specification and its files, or all their errors.
Result<FalconOptions> parse_falcon_options(const DeviceSpec& choice) {
  OptionParser judge{choice, {"port", "serial", "firmware", "calibration"}};
  if (!choice.name.empty())
    judge.add_error("'" + choice.name.substr(0, 60) +
                    "': port= selects one of several; `tandem-client doctor` lists them");
  FalconOptions options;
  if (const auto file = choice.find("calibration")) {
    auto spec = load_falcon_file(*file);
    if (spec) {
      options.spec = std::move(*spec);
    } else {
      judge.add_lines(std::move(spec.error().message));
    }
  }
  if (const auto file = choice.find("firmware")) {
    auto firmware = load_firmware(*file);
    if (!firmware) {
      judge.add_lines(std::move(firmware.error().message));
    } else if (auto good = check_firmware(*firmware, options.spec.firmware_sha256); !good) {
      judge.add_lines(std::move(good.error().message));
    } else {
      options.firmware = std::move(*firmware);
    }
  }
  return judge.result_with(std::move(options));
}

ShutdownFrame last_words(int fd) {
  ShutdownFrame words;
  words.fd = fd;
  words.usb_endpoint = UsbInterface{}.out;
  const auto zeros = encode(FalconCommand{});
  static_assert(zeros.size() <= ShutdownFrame::kFrameMax);
  words.size = zeros.size();
  std::copy(zeros.begin(), zeros.end(), words.frame.begin());
  return words;
}

}  // namespace

std::string_view FalconBackend::help() const noexcept {
  return "  falcon[:port=P][,serial=S][,firmware=FILE][,calibration=FILE]\n"
         "                              Novint Falcon; FILE of firmware: your own, needed once after power came\n";
}

std::string FalconBackend::library() const { return library_of(Bus::kUsb); }

std::vector<DeviceFact> FalconBackend::facts() const {
  return {{"firmware",
           "lost without power; loaded from firmware=FILE unless it runs already; checked when the device is opened"},
          {"rate", "1000 Hz, in lock-step"},
          {"calibration", "force scale from calibration=FILE, else an estimate limited to a tenth"},
          {"homing", "by hand, after power came: out, then in"},
          {"gravity", "no gravity compensation: the user holds the weight of the grip"}};
}

Result<> FalconBackend::check(const DeviceSpec& choice) const { return without_value(parse_falcon_options(choice)); }

Result<std::vector<FoundDevice>> FalconBackend::list() {
  std::vector<FoundDevice> found;
  for (const AttachedDevice& device : list_usb()) {
    if (device.ids != kFalcon) continue;
    const bool may = ::access(device.node.c_str(), R_OK | W_OK) == 0;
    found.push_back({"falcon:port=" + device.port, "Novint Falcon, " + describe(device),
                     may ? "" : permission_advice(device), device.node});
  }
  return found;
}

std::vector<std::string> FalconBackend::udev_rules() const { return {udev_rule(Bus::kUsb, kFalcon)}; }

Result<OpenedDriver> FalconBackend::open(const DeviceSpec& choice) {
  auto understood = parse_falcon_options(choice);
  if (!understood) return std::unexpected(std::move(understood.error()));
  FalconOptions& options = *understood;
  const auto attached = list_usb();
  auto device = hal::select_device(attached, wanted(choice));
  if (!device) return std::unexpected(std::move(device.error()));
  auto pipe = LibusbPipe::open(*device);
  if (!pipe) return std::unexpected(std::move(pipe.error()));

  OpenedDriver opened;
  auto bus = std::make_shared<FalconBus>();
  bus->pipe = std::move(*pipe);
  auto driver = FalconDriver::make({"falcon", device->port}, *bus->pipe, bus->clock, std::move(options));
  if (!driver) return std::unexpected(DeviceError{Errc::kUnsupported, std::move(driver.error())});
  opened.driver = std::make_unique<FalconDriver>(std::move(*driver));
  opened.bus = std::move(bus);
  if (const auto fd = find_open_file(device->node)) opened.shutdown_frame = last_words(*fd);
  return opened;
}

}  // namespace tandem::hal
