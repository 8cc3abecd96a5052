#include "hal/app/falcon_backend.h"

#include <unistd.h>

#include <utility>

#include "hal/app/device_files.h"
#include "hal/falcon/falcon_driver.h"
#include "hal/falcon/falcon_frame.h"
#include "hal/io/attached.h"
#include "hal/io/servo_pace.h"
#include "hal/io/udev_rule.h"
#include "hal/io/usb_pipe.h"

namespace tandem::hal {
namespace {

constexpr UsbIds kFalcon{0x0403, 0xcb48};

struct FalconBus {
  std::unique_ptr<LibusbPipe> pipe;
  MonotonicClock clock;
};

Wanted wanted(const DeviceChoice& choice) {
  return {.what = "Novint Falcon", .ids = {kFalcon}, .usage = {}, .serial = choice.find("serial"), .port = choice.find("port")};
}

LastWords last_words(int fd) {
  LastWords words;
  words.fd = fd;
  words.usb_endpoint = UsbInterface{}.out;
  const auto zeros = encode(FalconOrder{});
  static_assert(zeros.size() <= LastWords::kFrameMax);
  words.size = zeros.size();
  std::copy(zeros.begin(), zeros.end(), words.frame.begin());
  return words;
}

}  // namespace

std::string_view FalconBackend::help() const noexcept {
  return "  falcon[:port=P][,serial=S][,firmware=FILE][,calibration=FILE]\n"
         "                              Novint Falcon; FILE of firmware: your own, needed once after power came\n";
}

Result<std::vector<FoundDevice>> FalconBackend::list() {
  std::vector<FoundDevice> found;
  for (const Attached& device : list_usb()) {
    if (device.ids != kFalcon) continue;
    const bool may = ::access(device.node.c_str(), R_OK | W_OK) == 0;
    found.push_back({"falcon:port=" + device.port, "Novint Falcon, " + describe(device), may ? "" : permission_advice(device)});
  }
  return found;
}

std::vector<std::string> FalconBackend::udev_rules() const { return {udev_rule(Bus::kUsb, kFalcon)}; }

Result<OpenedDriver> FalconBackend::open(const DeviceChoice& choice) {
  if (auto known = only_these(choice, {"port", "serial", "firmware", "calibration"}); !known) return std::unexpected(known.error());
  FalconOptions options;
  if (const auto file = choice.find("calibration")) {
    auto spec = load_device_file(*file);
    if (!spec) return std::unexpected(std::move(spec.error()));
    if (!spec->falcon)
      return std::unexpected(DeviceError{Errc::kUnsupported, *file + ": says nothing of a falcon: write falcon { ... }"});
    options.spec = std::move(*spec->falcon);
    // Readings that contradict each other are told whatever is attached.
    if (const auto force = FalconForce::from(options.spec); !force)
      return std::unexpected(DeviceError{Errc::kUnsupported, *file + ": falcon: " + force.error()});
  }
  if (const auto file = choice.find("firmware")) {
    auto firmware = load_firmware(*file);
    if (!firmware) return std::unexpected(std::move(firmware.error()));
    if (auto good = check_firmware(*firmware, options.spec.firmware_sha256); !good) return std::unexpected(std::move(good.error()));
    options.firmware = std::move(*firmware);
  }
  const auto attached = list_usb();
  auto device = hal::choose(attached, wanted(choice));
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
  if (const auto fd = open_file_of(device->node)) opened.last_words = last_words(*fd);
  return opened;
}

}  // namespace tandem::hal
