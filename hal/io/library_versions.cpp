#include "hal/io/library_versions.h"

#include <hidapi.h>
#include <libusb.h>

#include "common/base/format.h"

namespace tandem::hal {

std::string library_of(Bus bus) {
  if (bus == Bus::kUsb) {
    const libusb_version* const version = libusb_get_version();
    return format("libusb %u.%u.%u", unsigned{version->major}, unsigned{version->minor}, unsigned{version->micro});
  }
  const hid_api_version* const version = hid_version();
  return format("hidapi %d.%d.%d", version->major, version->minor, version->patch);
}

}  // namespace tandem::hal
