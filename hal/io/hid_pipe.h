#pragma once

#include <memory>
#include <span>
#include <vector>

#include "hal/io/attached.h"
#include "hal/pipes.h"

namespace tandem::hal {

/// A HID device through hidapi's hidraw. Writing waits until the report is out (the kernel gives up after seconds), so
/// it belongs on a device's own thread. Waiting to read counts in whole milliseconds, rounded up: hidapi knows no less.
/// After opening nothing is taken from the heap unless something fails. Once unplugged, every call says so at once.
class HidrawPipe final : public HidPipe {
 public:
  static constexpr std::size_t kReportMax = 1024;  ///< longer reports to write: kInternal

  /// Opens a node that `list_hidraw` has found and that is still there; hidapi crashes on nodes of other kinds. One
  /// Tandem at a time: two writers would fight over the motors.
  /// Error: kNotFound, kPermission with the udev rule, kBusy, kInternal.
  [[nodiscard]] static Result<std::unique_ptr<HidrawPipe>> open(const Attached& device);
  ~HidrawPipe() override;

  Moved write(std::span<const std::byte> report) noexcept override;
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override;

 private:
  struct Impl;
  explicit HidrawPipe(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tandem::hal
