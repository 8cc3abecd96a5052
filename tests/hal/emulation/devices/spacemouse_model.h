#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/devices/report_queue.h"

namespace tandem::hal::emulation {

struct SpaceMouseModelParams {
  /// false: reports 1 and 2 alternate every 8 ms (SpaceNavigator); true: both in one report every 16 ms (wireless
  /// units).
  bool combined = false;
  std::uint16_t vendor = 0x046D, product = 0xC626;
  std::string_view name = "SpaceNavigator";
  std::string_view serial = "";
  /// The light is on from power-up, and "off" is ignored until "on" was received once
  bool light_needs_on_first = false;
  std::size_t button_bytes = 2;  ///< 2..4
};

/// Faults. Counts decrease by one per affected report.
struct SpaceMouseFaults {
  bool silent = false;  ///< stops sending during a motion
  int odd_reports = 0;  ///< the next motion reports are a byte short
  int strange_ids = 0;  ///< the next motion reports have an unknown id
};

/// Model of a 3Dconnexion SpaceMouse: reports while deflected, three pairs of zero reports on return to rest, then no
/// reports.
class SpaceMouseModel final : public EmulatedHidDevice {
 public:
  static constexpr Duration kPeriod = std::chrono::milliseconds{8};
  static constexpr int kZerosAtRest = 3;

  explicit SpaceMouseModel(const SpaceMouseModelParams& params = {}) noexcept;

  void advance(Duration dt) noexcept override;
  void unplug() noexcept override;
  void plug_in() noexcept override;
  [[nodiscard]] bool plugged_in() const noexcept override { return plugged_in_; }
  [[nodiscard]] std::uint16_t vendor_id() const noexcept override { return params_.vendor; }
  [[nodiscard]] std::uint16_t product_id() const noexcept override { return params_.product; }
  [[nodiscard]] std::string_view manufacturer() const noexcept override { return "3Dconnexion"; }
  [[nodiscard]] std::string_view product() const noexcept override { return params_.name; }
  [[nodiscard]] std::string_view serial() const noexcept override { return params_.serial; }
  [[nodiscard]] std::span<const std::byte> report_descriptor() const noexcept override;
  TransferResult report_out(std::span<const std::byte> report) noexcept override;
  TransferResult report_in(std::span<std::byte> into) noexcept override;
  TransferResult feature_set(std::span<const std::byte> report) noexcept override;
  TransferResult feature_get(std::span<std::byte> into) noexcept override;

  /// Deflects the device: x y z rx ry rz, counts in the maker's frame.
  void deflect(const std::array<std::int16_t, 6>& counts) noexcept;
  /// Sets the pressed buttons: bit mask. Reported at once.
  void press(std::uint32_t buttons) noexcept;
  void tell_battery(std::uint8_t percent, bool charging) noexcept;

  SpaceMouseFaults faults;

  [[nodiscard]] bool light() const noexcept { return light_; }

 private:
  void send_motion(std::size_t first, std::size_t axes, std::byte id) noexcept;

  SpaceMouseModelParams params_;
  bool plugged_in_ = true, light_ = false, light_was_on_ = false;
  std::array<std::int16_t, 6> counts_{};
  int zeros_left_ = 0;  ///< pairs of zero reports still to send after the return to rest
  bool turn_next_ = false;
  Duration until_next_ = kPeriod;
  ReportQueue queue_;
};

}  // namespace tandem::hal::emulation
