#include "hal/app/openhaptics_backend.h"

#include "hal/openhaptics/openhaptics_driver.h"

namespace tandem::hal {
namespace {

constexpr const char* kDefaultName = "Default Device";

}  // namespace

std::string OpenHapticsBackend::library() const {
  const auto library = OpenHapticsLibrary::load();
  return library ? std::string("libHD.so, installed; it says its version when a device is opened") : "libHD.so, not installed";
}

std::vector<DeviceFact> OpenHapticsBackend::facts() const {
  return {{"firmware", "the device keeps its own"},
          {"rate", "1000 Hz, the vendor's scheduler"},
          {"calibration", "the vendor's; peak and continuous force are asked of the device when it is opened"},
          {"homing", "as the device has it: by itself, or the stylus into the inkwell"},
          {"gravity", "the maker's compensation is on"}};
}

Result<> OpenHapticsBackend::check(const DeviceChoice& choice) const { return ChoiceJudge{choice, {"library"}}.verdict(); }

Result<std::vector<FoundDevice>> OpenHapticsBackend::list() {
  if (auto library = OpenHapticsLibrary::load(); !library) {
    DeviceError error = std::move(library.error());
    if (error.message.starts_with("openhaptics: ")) error.message.erase(0, std::string_view("openhaptics: ").size());  // the list says it
    return std::unexpected(std::move(error));
  }
  return std::vector{FoundDevice{std::string("openhaptics:") + kDefaultName,
                                 "a device of that name in the vendor's set-up tool; the library does not tell which are attached", "", ""}};
}

Result<OpenedDriver> OpenHapticsBackend::open(const DeviceChoice& choice) {
  if (auto ok = check(choice); !ok) return std::unexpected(std::move(ok.error()));
  const std::string file = choice.find("library").value_or(OpenHapticsLibrary::kFile);
  if (library_ && file_ != file)
    return std::unexpected(DeviceError{Errc::kUnsupported, "device: library=" + file + ": " + file_ +
                                                               " is loaded already, and there is one for all devices of a program"});
  if (!library_) {
    auto library = OpenHapticsLibrary::load(file);
    if (!library) return std::unexpected(std::move(library.error()));
    library_ = std::move(*library);
    file_ = file;
    group_ = std::make_shared<openhaptics::TouchGroup>(library_->api(), clock_);
  }
  const std::string name = choice.name.empty() ? kDefaultName : choice.name;
  // The vendor's threads talk to the device, not a file of ours: a Deadman could not speak for it.
  return OpenedDriver{library_, std::make_unique<openhaptics::OpenHapticsDriver>(name, group_, clock_), std::nullopt};
}

}  // namespace tandem::hal
