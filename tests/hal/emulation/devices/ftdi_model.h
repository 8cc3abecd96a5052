#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/time.h"
#include "tests/hal/emulation/devices/emulated_device.h"

namespace tandem::hal::emulation {

/// FIFO of a fixed size. Bytes beyond its size are counted and lost, as in the bridge.
template <std::size_t N>
class ByteQueue {
 public:
  void push(std::byte b) noexcept {
    if (size_ == N) return void(++lost_);
    bytes_[(first_ + size_++) % N] = b;
  }
  std::byte pop() noexcept {
    const std::byte b = bytes_[first_];
    first_ = (first_ + 1) % N;
    --size_;
    return b;
  }
  void clear() noexcept { size_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  std::array<std::byte, N> bytes_{};
  std::size_t first_ = 0, size_ = 0;
  std::uint64_t lost_ = 0;
};

/// Model of the USB-to-serial bridge: requests configure the line, and bytes take their time on it.
/// Packets to the host are sent when full or when the latency timer expires, each with two status bytes.
class FtdiModel {
 public:
  /// Handles a vendor request. @return false: the bridge does not support it
  bool request(std::uint8_t request, std::uint16_t value) noexcept;
  void from_host(std::span<const std::byte> bytes) noexcept;
  /// Returns a packet for the host, or nothing yet. @param into  at least 2 bytes
  [[nodiscard]] std::optional<std::size_t> to_host(std::span<std::byte> into) noexcept;

  /// Advances time; next_for_device() then returns the bytes that arrived meanwhile.
  void advance(Duration dt) noexcept;
  [[nodiscard]] std::optional<std::byte> next_for_device() noexcept;
  void from_device(std::byte b) noexcept { up_line_.push(b); }
  void set_cts(bool raised) noexcept { cts_ = raised; }
  /// Makes the next packet report lost bytes on the line.
  void mark_line_error() noexcept { line_error_ = true; }
  /// Restores the state after a USB reset: empty, timers at the chip's defaults.
  void reset() noexcept;

  [[nodiscard]] std::uint16_t divisor() const noexcept { return divisor_; }
  [[nodiscard]] bool dtr() const noexcept { return dtr_; }
  [[nodiscard]] bool rts() const noexcept { return rts_; }
  /// Returns the number of rising edges of DTR since construction.
  [[nodiscard]] std::uint64_t dtr_pulses() const noexcept { return dtr_pulses_; }
  [[nodiscard]] unsigned latency_ms() const noexcept { return latency_ms_; }

 private:
  [[nodiscard]] double bytes_per_second() const noexcept;

  std::uint16_t divisor_ = 0x4138;
  unsigned latency_ms_ = 16;
  bool dtr_ = false, rts_ = false, cts_ = false, line_error_ = false;
  std::uint64_t dtr_pulses_ = 0;
  ByteQueue<4096> down_line_, up_line_, up_;
  std::size_t arrived_ = 0;  ///< bytes of down_line_ that the device may read
  double down_credit_ = 0, up_credit_ = 0;
  Duration since_packet_{};
};

}  // namespace tandem::hal::emulation
