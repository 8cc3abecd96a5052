#pragma once

#include <memory>
#include <string>

#include "hal/core/device.h"
#include "hal/drivers/openhaptics/hd_api.h"

namespace tandem::hal {

/// The vendor's libHD.so, loaded at run time. Licence holders install it; Tandem is neither built against it nor ships
/// it.
/// The library may start its own threads, so it stays loaded until the program ends.
class OpenHapticsLibrary {
 public:
  static constexpr const char* kFile = "libHD.so";

  /// Loads the library.
  /// @param file  a path, or a name for the dynamic loader
  /// Error kLibraryMissing: the file or one of its dependencies is missing. kUnsupported: too old, or another library.
  [[nodiscard]] static Result<std::shared_ptr<OpenHapticsLibrary>> load(const std::string& file = kFile);

  [[nodiscard]] const openhaptics::Api& api() const noexcept { return api_; }

 private:
  OpenHapticsLibrary() = default;
  openhaptics::Api api_;
};

}  // namespace tandem::hal
