#pragma once

#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "hal/core/device.h"
#include "tests/hal/emulation/devices/emulated_device.h"

/// Minimal devices that echo the data they receive, for tests of the pipes, which are independent of protocols.
namespace tandem::test {

inline std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> out;
  for (const int v : values) out.push_back(static_cast<std::byte>(v));
  return out;
}

/// Empty if the call succeeded.
template <class T>
std::optional<hal::Errc> error_of(const std::expected<T, hal::Errc>& outcome) {
  return outcome ? std::nullopt : std::optional(outcome.error());
}

/// A serial bridge like FTDI's: every IN packet begins with two status bytes. An otherwise empty packet is sent
/// whenever the latency timer expires.
class UsbEcho final : public hal::emulation::EmulatedUsbDevice {
 public:
  static constexpr std::size_t kPacket = 64, kStatus = 2;

  // Faults, and observations for the tests.
  bool stall_in = false, stall_out = false, refuse_control = false;
  bool takes_nothing = false;                   ///< OUT endpoint answers NAK
  bool silent = false;                          ///< echoes nothing; no empty packets either
  bool holds_back = false;                      ///< echoes later
  std::size_t packet_data = kPacket - kStatus;  ///< most data in a packet: small values cut frames
  Duration latency = std::chrono::milliseconds(1);
  std::vector<hal::emulation::SetupPacket> requests;
  std::uint64_t bytes_taken = 0, halts_cleared = 0;

  UsbEcho() {
    requests.reserve(100000);
    const auto d = bytes({18, 1, 0x00, 0x02, 0, 0, 0, 64, 0x03, 0x04, 0x48, 0xCB, 0x00, 0x04, 1, 2, 3, 1});
    std::ranges::copy(d, device_.begin());
    const auto c = bytes({9,    2, 32, 0, 1,    1, 0,  0x80, 45, 9, 4, 0,    0, 2,  0xFF, 0xFF,
                          0xFF, 2, 7,  5, 0x81, 2, 64, 0,    0,  7, 5, 0x02, 2, 64, 0,    0});
    std::ranges::copy(c, config_.begin());
  }
  /// Removes the bulk endpoints: another device with the same id.
  void become_another_device() { config_[21] = config_[28] = std::byte{3}; }

  std::span<const std::byte> device_descriptor() const noexcept override { return device_; }
  std::span<const std::byte> config_descriptor() const noexcept override { return config_; }
  std::string_view string(std::uint8_t index) const noexcept override {
    return index == 1 ? "Tandem" : index == 2 ? "ECHO" : index == 3 ? "E7" : "";
  }
  hal::emulation::TransferResult control(const hal::emulation::SetupPacket& setup,
                                         std::span<std::byte>) noexcept override {
    if (gone_) return std::unexpected(hal::emulation::TransferStatus::kGone);
    if (setup.request_type == 0x02 && setup.request == 1) {
      ++halts_cleared;
      ((setup.index & 0x80) != 0 ? stall_in : stall_out) = false;
      return 0u;
    }
    if (refuse_control) return std::unexpected(hal::emulation::TransferStatus::kStall);
    if (requests.size() < requests.capacity()) requests.push_back(setup);
    return 0u;
  }
  hal::emulation::TransferResult bulk_out(std::uint8_t, std::span<const std::byte> sent) noexcept override {
    if (gone_) return std::unexpected(hal::emulation::TransferStatus::kGone);
    if (stall_out) return std::unexpected(hal::emulation::TransferStatus::kStall);
    if (takes_nothing) return std::unexpected(hal::emulation::TransferStatus::kNak);
    bytes_taken += sent.size();
    if (!silent) echo_.insert(echo_.end(), sent.begin(), sent.end());
    return sent.size();
  }
  hal::emulation::TransferResult bulk_in(std::uint8_t, std::span<std::byte> into) noexcept override {
    if (gone_) return std::unexpected(hal::emulation::TransferStatus::kGone);
    if (stall_in) return std::unexpected(hal::emulation::TransferStatus::kStall);
    if (holds_back) return std::unexpected(hal::emulation::TransferStatus::kNak);
    const bool timer = waited_ >= latency && !silent;
    if (echo_.empty() && !timer) return std::unexpected(hal::emulation::TransferStatus::kNak);
    waited_ = {};
    const std::size_t n = std::min(echo_.size(), packet_data);
    into[0] = std::byte{0x01};
    into[1] = std::byte{0x60};
    std::copy_n(echo_.begin(), n, into.begin() + kStatus);
    echo_.erase(echo_.begin(), echo_.begin() + static_cast<std::ptrdiff_t>(n));
    return kStatus + n;
  }
  void advance(Duration dt) noexcept override { waited_ += dt; }
  void unplug() noexcept override { gone_ = true; }
  void plug_in() noexcept override {
    gone_ = stall_in = stall_out = false;
    echo_.clear();
  }
  bool plugged_in() const noexcept override { return !gone_; }

 private:
  std::array<std::byte, 18> device_{};
  std::array<std::byte, 32> config_{};
  std::deque<std::byte> echo_;
  Duration waited_{};
  bool gone_ = false;
};

/// A board in lock-step: it echoes every report of 14 bytes. Optionally it sends unprompted reports.
class HidEcho final : public hal::emulation::EmulatedHidDevice {
 public:
  bool silent = false, refuses = false;
  Duration period{};  ///< if not 0: sends an unprompted report with a counter and echoes nothing
  std::uint64_t taken = 0;

  explicit HidEcho(bool numbered = false) {
    descriptor_ = bytes({0x06, 0xAB, 0xFF, 0x0A, 0x00, 0x02, 0xA1, 0x01, 0x75, 0x08, 0x15, 0x00, 0x26, 0xFF, 0x00});
    if (numbered) std::ranges::copy(bytes({0x85, 0x07}), std::back_inserter(descriptor_));
    std::ranges::copy(bytes({0x95, 14, 0x09, 0x01, 0x81, 0x02, 0x95, 14, 0x09, 0x02, 0x91, 0x02, 0xC0}),
                      std::back_inserter(descriptor_));
  }
  std::uint16_t vendor_id() const noexcept override { return 0x1234; }
  std::uint16_t product_id() const noexcept override { return 0x0006; }
  std::string_view manufacturer() const noexcept override { return "Tandem"; }
  std::string_view product() const noexcept override { return "HID DEVICE"; }
  std::string_view serial() const noexcept override { return "H3"; }
  std::span<const std::byte> report_descriptor() const noexcept override { return descriptor_; }
  hal::emulation::TransferResult report_out(std::span<const std::byte> report) noexcept override {
    if (gone_) return std::unexpected(hal::emulation::TransferStatus::kGone);
    if (refuses) return std::unexpected(hal::emulation::TransferStatus::kStall);
    ++taken;
    if (!silent && period == Duration{}) waiting_.emplace_back(report.begin(), report.end());
    return report.size();
  }
  hal::emulation::TransferResult report_in(std::span<std::byte> into) noexcept override {
    if (gone_) return std::unexpected(hal::emulation::TransferStatus::kGone);
    if (period > Duration{} && waited_ >= period) {
      waited_ -= period;
      ++count_;
      std::memcpy(into.data(), &count_, sizeof count_);
      return 14u;
    }
    if (waiting_.empty()) return std::unexpected(hal::emulation::TransferStatus::kNak);
    const std::size_t n = waiting_.front().size();
    std::ranges::copy(waiting_.front(), into.begin());
    waiting_.pop_front();
    return n;
  }
  hal::emulation::TransferResult feature_set(std::span<const std::byte>) noexcept override {
    return std::unexpected(hal::emulation::TransferStatus::kStall);
  }
  hal::emulation::TransferResult feature_get(std::span<std::byte>) noexcept override {
    return std::unexpected(hal::emulation::TransferStatus::kStall);
  }
  void advance(Duration dt) noexcept override { waited_ += dt; }
  void unplug() noexcept override { gone_ = true; }
  void plug_in() noexcept override { gone_ = false; }
  bool plugged_in() const noexcept override { return !gone_; }

 private:
  std::vector<std::byte> descriptor_;
  std::deque<std::vector<std::byte>> waiting_;
  Duration waited_{};
  std::uint64_t count_ = 0;
  bool gone_ = false;
};

}  // namespace tandem::test
