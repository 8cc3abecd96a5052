#include "hal/backends/openhaptics_backend.h"

#include "hal/drivers/openhaptics/openhaptics_driver.h"
#include "hal/io/udev_rule.h"

namespace tandem::hal {
namespace {

// The first USB Touch is a serial port. Newer ones and the Touch X are HID devices with the vendor id of 3D Systems.
constexpr const char* kSerialTouch =
    "SUBSYSTEM==\"tty\", ATTRS{idVendor}==\"0301\", ATTRS{idProduct}==\"2988\", ENV{ID_MM_DEVICE_IGNORE}=\"1\", "
    "MODE=\"0660\", TAG+=\"uaccess\"";
constexpr std::uint16_t k3dSystems = 0x2988;

/// Returns whether home=here states that the device rests in its reset pose, or all errors of the specification.
Result<bool> parse_openhaptics_options(const DeviceSpec& choice) {
  OptionParser judge{choice, {"library", "home"}};
  const bool home = choice.find("home").has_value() && judge.one_of("home", {"here"}) == "here";
  return judge.result_with(home);
}

}  // namespace

std::vector<std::string> OpenHapticsBackend::udev_rules() const { return {kSerialTouch, udev_vendor_rule(k3dSystems)}; }

std::string OpenHapticsBackend::library() const {
  const auto library = OpenHapticsLibrary::load();
  return library ? std::string("libHD.so, installed; it reports its version when a device is opened")
                 : "libHD.so, not installed";
}

std::vector<DeviceFact> OpenHapticsBackend::facts() const {
  return {
      {"firmware", "the device keeps its own"},
      {"rate", "1000 Hz, the vendor's scheduler"},
      {"calibration", "the vendor's; peak and continuous force are read from the device when it is opened"},
      {"homing",
       "as the device has it: by itself, the stylus into the inkwell, or its reset pose (on request, or home=here)"},
      {"gravity", "the maker's compensation is on"}};
}

Result<> OpenHapticsBackend::check(const DeviceSpec& choice) const {
  return without_value(parse_openhaptics_options(choice));
}

Result<std::vector<FoundDevice>> OpenHapticsBackend::list() {
  if (auto library = OpenHapticsLibrary::load(); !library) {
    DeviceError error = std::move(library.error());
    if (error.message.starts_with("openhaptics: "))
      error.message.erase(0, std::string_view("openhaptics: ").size());  // the list prints the backend's name itself
    return std::unexpected(std::move(error));
  }
  return std::vector{FoundDevice{
      "openhaptics", "the default device of the vendor's set-up tool; the library does not report which are attached",
      "", ""}};
}

Result<OpenedDriver> OpenHapticsBackend::open(const DeviceSpec& choice) {
  const auto home = parse_openhaptics_options(choice);
  if (!home) return std::unexpected(home.error());
  const std::string file = choice.find("library").value_or(OpenHapticsLibrary::kFile);
  if (library_ && file_ != file)
    return std::unexpected(
        DeviceError{Errc::kUnsupported, "device: library=" + file + ": " + file_ +
                                            " is loaded already, and there is one for all devices of a program"});
  if (!library_) {
    auto library = OpenHapticsLibrary::load(file);
    if (!library) return std::unexpected(std::move(library.error()));
    library_ = std::move(*library);
    file_ = file;
    group_ = std::make_shared<openhaptics::TouchGroup>(library_->api(), clock_);
  }
  // The vendor's threads communicate with the device, without a file of this process. A WatchdogProcess therefore
  // cannot act for it.
  return OpenedDriver{library_, std::make_unique<openhaptics::OpenHapticsDriver>(choice.name, group_, clock_, *home),
                      std::nullopt};
}

}  // namespace tandem::hal
