#include <array>

#include "common/base/nearest.h"
#include "hal/app/falcon_backend.h"
#include "hal/app/hid_backends.h"
#include "hal/app/input_backends.h"
#include "hal/app/openhaptics_backend.h"
#include "hal/io/backend.h"

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
