#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem::hal {

/// Returns whether reports of a HID device begin with a report id: its descriptor has a "Report ID" item [HID 1.11,
/// 6.2.2].
/// Total: a descriptor that ends inside an item is read up to that item.
[[nodiscard]] constexpr bool has_report_ids(std::span<const std::byte> descriptor) noexcept {
  constexpr std::uint8_t kLongItem = 0xFE, kReportId = 0x84;  // kReportId without its two size bits
  for (std::size_t at = 0; at < descriptor.size();) {
    const auto prefix = static_cast<std::uint8_t>(descriptor[at]);
    if (prefix == kLongItem) {
      if (at + 1 >= descriptor.size()) return false;
      at += 3 + static_cast<std::size_t>(descriptor[at + 1]);
      continue;
    }
    if ((prefix & 0xFC) == kReportId) return true;
    const std::size_t size = prefix & 3u;
    at += 1 + (size == 3 ? 4 : size);
  }
  return false;
}

}  // namespace tandem::hal
