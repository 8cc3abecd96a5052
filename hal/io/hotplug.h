#pragma once

#include <memory>
#include <vector>

#include "hal/io/enumeration.h"

namespace tandem::hal {

struct HotplugEvent {
  bool arrived = false;  ///< true: plugged in, false: unplugged
  AttachedDevice device;
};

/// Monitor of hotplug events, USB and hidraw.
/// udev events only wake it; the changes are the difference between two listings. A lost event therefore only delays
/// the report.
/// Without udev events it lists the devices once a second. libusb's own callback uses the same events on Linux and
/// would add its thread.
/// Use from one thread at a time.
class HotplugMonitor {
 public:
  static constexpr Duration kLookAnyway = std::chrono::seconds(1);

  /// Error: kInternal if udev refuses the subscription.
  [[nodiscard]] static Result<std::unique_ptr<HotplugMonitor>> open();
  ~HotplugMonitor();

  /// Returns the devices of the last listing.
  [[nodiscard]] const std::vector<AttachedDevice>& present() const noexcept;
  /// Waits until a device changed, or until the timeout. Removals come before arrivals.
  /// A device that was unplugged and plugged in again between two listings appears in both.
  [[nodiscard]] std::vector<HotplugEvent> wait(Duration timeout);

 private:
  struct Impl;
  explicit HotplugMonitor(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tandem::hal
