#include <algorithm>

#include "common/base/nearest.h"
#include "hal/io/backend.h"

namespace tandem::hal {

std::span<Backend* const> backends() { return {}; }

Result<Backend*> find_backend(std::string_view name) {
  std::vector<std::string> known{"sim"};
  for (Backend* backend : backends()) {
    if (backend->name() == name) return backend;
    known.emplace_back(backend->name());
  }
  return std::unexpected(DeviceError{Errc::kNotFound, "device: backend '" + std::string(name.substr(0, 60)) +
                                                          "' is unknown; " + suggest(std::string(name), known)});
}

Result<FoundDevice> choose(const DeviceChoice& choice, std::span<const FoundDevice> found) {
  const auto list = [&] {
    std::string keys;
    for (const FoundDevice& device : found) keys += (keys.empty() ? "" : ", ") + device.id.key;
    return keys;
  };
  if (!choice.name.empty()) {
    const auto named = std::ranges::find_if(found, [&](const FoundDevice& f) { return f.id.key == choice.name; });
    if (named != found.end()) return *named;
    return std::unexpected(DeviceError{Errc::kNotFound, choice.backend + ": no device '" + choice.name.substr(0, 60) + "' is attached; " +
                                                            (found.empty() ? "there is none at all: is it plugged in and powered?"
                                                                           : "there are: " + list())});
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    return std::unexpected(DeviceError{Errc::kNotFound, choice.backend +
                                                            ": no such device is attached; is it plugged in and powered? "
                                                            "`tandem-client doctor` tells what is there"});
  }
  return std::unexpected(DeviceError{Errc::kNotFound, choice.backend + ": several are attached, name one: " +
                                                          choice.backend + ":KEY with KEY one of " + list()});
}

}  // namespace tandem::hal
