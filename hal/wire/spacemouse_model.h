#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/wire/report_queue.h"
#include "hal/wire/wire_model.h"

namespace tandem::hal::wire {

struct SpaceMouseModelParams {
  /// false: reports 1 and 2 by turns every 8 ms (SpaceNavigator); true: both in one every 16 ms (wireless units).
  bool combined = false;
  std::uint16_t vendor = 0x046D, product = 0xC626;
  std::string_view name = "SpaceNavigator";
  std::string_view serial = "";
  bool light_needs_on_first = false;  ///< it shines from power-up, and "off" is ignored until "on" came once
  std::size_t button_bytes = 2;       ///< 2..4
};

/// Trouble to be had. Counts fall by one per report concerned.
struct SpaceMouseFaults {
  bool silent = false;    ///< dies in mid-motion
  int odd_reports = 0;    ///< the next motion reports are a byte short
  int strange_ids = 0;    ///< the next motion reports come under an id nobody knows
};

/// A 3Dconnexion puck: reports while it is deflected, three zero pairs when it comes back to rest, then silence.
class SpaceMouseModel final : public HidWireModel {
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
  WireMoved report_out(std::span<const std::byte> report) noexcept override;
  WireMoved report_in(std::span<std::byte> into) noexcept override;
  WireMoved feature_set(std::span<const std::byte> report) noexcept override;
  WireMoved feature_get(std::span<std::byte> into) noexcept override;

  /// Somebody holds the puck there: x y z rx ry rz, counts in the maker's frame.
  void deflect(const std::array<std::int16_t, 6>& counts) noexcept;
  /// Presses and releases buttons: bit mask. Told at once.
  void press(std::uint32_t buttons) noexcept;
  void tell_battery(std::uint8_t percent, bool charging) noexcept;

  SpaceMouseFaults faults;

  [[nodiscard]] bool light() const noexcept { return light_; }

 private:
  void send_motion(std::size_t first, std::size_t axes, std::byte id) noexcept;

  SpaceMouseModelParams params_;
  bool plugged_in_ = true, light_ = false, light_was_on_ = false;
  std::array<std::int16_t, 6> counts_{};
  int zeros_left_ = 0;  ///< pairs, after the puck came to rest
  bool turn_next_ = false;
  Duration until_next_ = kPeriod;
  ReportQueue queue_;
};

}  // namespace tandem::hal::wire
