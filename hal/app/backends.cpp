#include <array>

#include "common/base/nearest.h"
#include "hal/app/falcon_backend.h"
#include "hal/app/hid_backends.h"
#include "hal/io/backend.h"

namespace tandem::hal {

std::span<Backend* const> backends() {
  static FalconBackend falcon;
  static WoodenHapticsBackend woodenhaptics;
  static SpaceMouseBackend spacemouse;
  static const std::array<Backend*, 3> all{&falcon, &woodenhaptics, &spacemouse};
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
