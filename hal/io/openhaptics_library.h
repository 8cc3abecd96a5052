#pragma once

#include <memory>
#include <string>

#include "hal/device.h"
#include "hal/openhaptics/hd_api.h"

namespace tandem::hal {

/// The vendor's libHD.so, loaded while the program runs: installed by whoever has a licence, never built against, never shipped. It may
/// begin threads of its own, so it stays loaded until the program ends.
class OpenHapticsLibrary {
 public:
  static constexpr const char* kFile = "libHD.so";

  /// @param file  a path, or a name for the system's loader
  /// Error kLibraryMissing: it is not there, or something it needs is not; kUnsupported: too old, or another library.
  [[nodiscard]] static Result<std::shared_ptr<OpenHapticsLibrary>> load(const std::string& file = kFile);

  [[nodiscard]] const openhaptics::Api& api() const noexcept { return api_; }

 private:
  OpenHapticsLibrary() = default;
  openhaptics::Api api_;
};

}  // namespace tandem::hal
