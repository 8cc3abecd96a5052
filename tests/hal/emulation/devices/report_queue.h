#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/hal/emulation/devices/emulated_device.h"

namespace tandem::hal::emulation {

/// Queue of reports to the host, as large as that of a hidraw node; when full, the oldest report is lost. No heap.
class ReportQueue {
 public:
  static constexpr std::size_t kReports = 64, kBytes = 64;

  void clear() noexcept { size_ = 0; }
  /// Appends a report. @param report  at most kBytes are kept
  void push(std::span<const std::byte> report) noexcept {
    if (size_ == kReports) first_ = (first_ + 1) % kReports, --size_, ++lost_;
    Slot& slot = slots_[(first_ + size_++) % kReports];
    slot.size = std::min(report.size(), kBytes);
    std::copy_n(report.begin(), slot.size, slot.bytes.begin());
  }
  /// Removes and returns the oldest report, cut to the size of `into`; kNak: none.
  TransferResult pop(std::span<std::byte> into) noexcept {
    if (size_ == 0) return std::unexpected(TransferStatus::kNak);
    const Slot& slot = slots_[first_];
    first_ = (first_ + 1) % kReports;
    --size_;
    const std::size_t n = std::min(slot.size, into.size());
    std::copy_n(slot.bytes.begin(), n, into.begin());
    return n;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct Slot {
    std::array<std::byte, kBytes> bytes{};
    std::size_t size = 0;
  };
  std::array<Slot, kReports> slots_{};
  std::size_t first_ = 0, size_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace tandem::hal::emulation
