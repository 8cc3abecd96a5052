#include <array>

#include "common/base/suggestions.h"
#include "hal/backends/backend.h"
#include "hal/backends/falcon_backend.h"
#include "hal/backends/hid_backends.h"
#include "hal/backends/input_backends.h"
#include "hal/backends/openhaptics_backend.h"

namespace tandem::hal {

std::span<Backend* const> backends() {
  static FalconBackend falcon;
  static WoodenHapticsBackend woodenhaptics;
  static SpaceMouseBackend spacemouse;
  static OpenHapticsBackend openhaptics;
  static MouseBackend mouse;
  static ReplayBackend replay;
  static const std::array<Backend*, 6> all{&falcon, &woodenhaptics, &spacemouse, &openhaptics, &mouse, &replay};
  return all;
}

Result<Backend*> find_backend(std::string_view name) {
  std::vector<std::string> known{"sim"};
  for (Backend* backend : backends()) {
    if (backend->name() == name) return backend;
    known.emplace_back(backend->name());
  }
  return std::unexpected(DeviceError{Errc::kNotFound, "device: backend '" + std::string(name.substr(0, 60)) +
                                                          "' is unknown; " + suggest(std::string(name), known)});
}

}  // namespace tandem::hal
