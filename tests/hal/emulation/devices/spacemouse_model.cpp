#include "tests/hal/emulation/devices/spacemouse_model.h"

#include <algorithm>
#include <utility>

namespace tandem::hal::emulation {
namespace {

/// Descriptor of a multi-axis controller: reports 1 (x y z), 2 (rx ry rz), 3 (buttons), 4 (light).
/// Essentially that of a SpaceNavigator: logical range +-350, absolute.
constexpr std::array<std::uint8_t, 97> kSplit{
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01,                                                  // multi-axis controller
    0xA1, 0x00, 0x85, 0x01, 0x16, 0xA2, 0xFE, 0x26, 0x5E, 0x01, 0x36, 0x88, 0xFA, 0x46,  // report 1, -350..350,
    0x78, 0x05, 0x55, 0x0C, 0x65, 0x11, 0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x75, 0x10,  // x y z, 16 bits
    0x95, 0x03, 0x81, 0x02, 0xC0,                                                        //
    0xA1, 0x00, 0x85, 0x02, 0x09, 0x33, 0x09, 0x34, 0x09, 0x35, 0x75, 0x10, 0x95, 0x03,  // report 2: rx ry rz
    0x81, 0x02, 0xC0,                                                                    //
    0xA1, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29, 0x10, 0x15, 0x00, 0x25, 0x01,  // report 3: 16 buttons
    0x35, 0x00, 0x45, 0x01, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02, 0xC0,                    //
    0xA1, 0x02, 0x85, 0x04, 0x05, 0x08, 0x09, 0x4B, 0x75, 0x01, 0x95, 0x08, 0x91, 0x02,  // report 4: light
    0xC0, 0xC0};

template <std::size_t N>
constexpr std::array<std::byte, N> bytes_of(const std::array<std::uint8_t, N>& in) {
  std::array<std::byte, N> out{};
  std::ranges::transform(in, out.begin(), [](std::uint8_t b) { return std::byte{b}; });
  return out;
}
constexpr auto kSplitBytes = bytes_of(kSplit);

/// Descriptor with all six axes in report 1.
constexpr std::array<std::uint8_t, 85> kCombined{
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01,                                                  //
    0xA1, 0x00, 0x85, 0x01, 0x16, 0xA2, 0xFE, 0x26, 0x5E, 0x01, 0x36, 0x88, 0xFA, 0x46,  //
    0x78, 0x05, 0x55, 0x0C, 0x65, 0x11, 0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x09, 0x33,  //
    0x09, 0x34, 0x09, 0x35, 0x75, 0x10, 0x95, 0x06, 0x81, 0x02, 0xC0,                    //
    0xA1, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29, 0x10, 0x15, 0x00, 0x25, 0x01,  //
    0x35, 0x00, 0x45, 0x01, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02, 0xC0,                    //
    0xA1, 0x02, 0x85, 0x04, 0x05, 0x08, 0x09, 0x4B, 0x75, 0x01, 0x95, 0x08, 0x91, 0x02,  //
    0xC0};
constexpr auto kCombinedBytes = bytes_of(kCombined);

}  // namespace

SpaceMouseModel::SpaceMouseModel(const SpaceMouseModelParams& params) noexcept
    : params_(params), light_(params.light_needs_on_first) {}

std::span<const std::byte> SpaceMouseModel::report_descriptor() const noexcept {
  if (params_.combined) return kCombinedBytes;
  return kSplitBytes;
}

void SpaceMouseModel::unplug() noexcept {
  plugged_in_ = false;
  queue_.clear();
}

void SpaceMouseModel::plug_in() noexcept {
  plugged_in_ = true;
  light_ = params_.light_needs_on_first;
  light_was_on_ = false;
  queue_.clear();
}

void SpaceMouseModel::deflect(const std::array<std::int16_t, 6>& counts) noexcept {
  const bool moved = counts_ != decltype(counts_){};
  counts_ = counts;
  if (counts_ != decltype(counts_){}) {
    zeros_left_ = 0;
  } else if (moved) {
    zeros_left_ = kZerosAtRest;
  }
}

void SpaceMouseModel::advance(Duration dt) noexcept {
  for (dt = std::max(dt, Duration{0}); dt >= until_next_; dt -= std::exchange(until_next_, kPeriod)) {
    const bool active = counts_ != decltype(counts_){} || zeros_left_ > 0;
    const bool second = std::exchange(turn_next_, !turn_next_);
    if (!plugged_in_ || faults.silent || !active) continue;
    if (params_.combined) {
      if (second) send_motion(0, 6, std::byte{1});
    } else {
      send_motion(second ? 3 : 0, 3, second ? std::byte{2} : std::byte{1});
    }
    if (second && zeros_left_ > 0) --zeros_left_;
  }
  until_next_ -= dt;
}

void SpaceMouseModel::send_motion(std::size_t first, std::size_t axes, std::byte id) noexcept {
  std::array<std::byte, 13> bytes{id};
  for (std::size_t i = 0; i < axes; ++i) {
    const int value = counts_[first + i];
    const int low = ((value % 256) + 256) % 256;
    bytes[1 + 2 * i] = static_cast<std::byte>(low);
    bytes[2 + 2 * i] = static_cast<std::byte>((value - low) / 256);
  }
  std::size_t length = 1 + 2 * axes;
  if (faults.odd_reports > 0) --faults.odd_reports, --length;
  if (faults.strange_ids > 0) --faults.strange_ids, bytes[0] = std::byte{0x55};
  queue_.push(std::span(bytes).first(length));
}

void SpaceMouseModel::press(std::uint32_t buttons) noexcept {
  if (!plugged_in_ || faults.silent) return;
  std::array<std::byte, 5> bytes{std::byte{3}};
  for (std::size_t i = 0; i < 4; ++i) bytes[1 + i] = static_cast<std::byte>(buttons >> (8 * i));
  queue_.push(std::span(bytes).first(1 + std::clamp<std::size_t>(params_.button_bytes, 2, 4)));
}

void SpaceMouseModel::tell_battery(std::uint8_t percent, bool charging) noexcept {
  if (!plugged_in_ || faults.silent) return;
  const std::array<std::byte, 3> bytes{std::byte{0x17}, std::byte{percent}, charging ? std::byte{1} : std::byte{0}};
  queue_.push(bytes);
}

TransferResult SpaceMouseModel::report_out(std::span<const std::byte> report) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  if (report.size() != 2 || report[0] != std::byte{4}) return std::unexpected(TransferStatus::kStall);
  const bool on = (report[1] & std::byte{1}) != std::byte{0};
  light_was_on_ = light_was_on_ || on;
  light_ = on || (light_ && params_.light_needs_on_first && !light_was_on_);
  return report.size();
}

TransferResult SpaceMouseModel::report_in(std::span<std::byte> into) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  return queue_.pop(into);
}

TransferResult SpaceMouseModel::feature_set(std::span<const std::byte>) noexcept {
  return std::unexpected(plugged_in_ ? TransferStatus::kStall : TransferStatus::kGone);
}
TransferResult SpaceMouseModel::feature_get(std::span<std::byte>) noexcept {
  return std::unexpected(plugged_in_ ? TransferStatus::kStall : TransferStatus::kGone);
}

}  // namespace tandem::hal::emulation
