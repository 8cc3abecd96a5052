#pragma once

#include <memory>
#include <vector>

#include "hal/io/attached.h"

namespace tandem::hal {

struct PlugChange {
  bool arrived = false;  ///< else it left
  Attached device;
};

/// Tells what is plugged in and out, USB and hidraw. Events of udev only wake it; what changed is the difference
/// between two listings, so a lost event, or no udev at all (then it looks once a second), costs time and no truth.
/// libusb's own callback is fed by the same events on Linux and would add its thread. One thread at a time.
class PlugWatch {
 public:
  static constexpr Duration kLookAnyway = std::chrono::seconds(1);

  /// Error: kInternal when udev does not let us listen.
  [[nodiscard]] static Result<std::unique_ptr<PlugWatch>> open();
  ~PlugWatch();

  /// What was there at the last look.
  [[nodiscard]] const std::vector<Attached>& present() const noexcept;
  /// Waits until something changed, at most `patience`. What left comes before what arrived; a device that was plugged
  /// out and in again between two looks has done both.
  [[nodiscard]] std::vector<PlugChange> wait(Duration patience);

 private:
  struct Impl;
  explicit PlugWatch(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tandem::hal
