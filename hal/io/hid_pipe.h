#pragma once

#include <memory>
#include <span>
#include <vector>

#include "hal/core/pipes.h"
#include "hal/io/enumeration.h"

namespace tandem::hal {

/// A HID device through hidapi's hidraw backend.
/// Writing blocks until the report is sent (the kernel gives up after seconds), so it belongs on a device's own thread.
/// Read time-outs are rounded up to whole milliseconds, hidapi's resolution. After opening, nothing is allocated unless
/// a call fails.
/// Once the device is unplugged, every call returns kUnplugged at once.
class HidrawPipe final : public HidPipe {
 public:
  static constexpr std::size_t kReportMax = 1024;  ///< longer reports to write: kInternal

  /// Opens a node from `list_hidraw` that still exists; hidapi crashes on nodes of other kinds.
  /// Only one Tandem process may open it: two writers would send conflicting motor commands.
  /// Error: kNotFound, kPermission with the udev rule, kBusy, kInternal.
  [[nodiscard]] static Result<std::unique_ptr<HidrawPipe>> open(const AttachedDevice& device);
  ~HidrawPipe() override;

  Moved write(std::span<const std::byte> report) noexcept override;
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override;

 private:
  struct Impl;
  explicit HidrawPipe(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tandem::hal
