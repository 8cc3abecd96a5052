#include "hal/core/device.h"

namespace tandem::hal {

const char* to_string(Errc code) noexcept {
  switch (code) {
    case Errc::kNotFound:
      return "not found";
    case Errc::kPermission:
      return "permission denied";
    case Errc::kBusy:
      return "busy";
    case Errc::kUnplugged:
      return "unplugged";
    case Errc::kTimeout:
      return "timeout";
    case Errc::kFraming:
      return "framing error";
    case Errc::kProtocol:
      return "protocol error";
    case Errc::kFirmware:
      return "firmware";
    case Errc::kNotHomed:
      return "not homed";
    case Errc::kLimit:
      return "beyond a limit";
    case Errc::kUnsupported:
      return "unsupported";
    case Errc::kLibraryMissing:
      return "library missing";
    case Errc::kBadState:
      return "not possible in this state";
    case Errc::kInternal:
      return "internal error";
  }
  return "unknown error";
}

}  // namespace tandem::hal
