#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/time.h"
#include "hal/wire/wire_model.h"

namespace tandem::hal::wire {

/// First in, first out, of a fixed size; what does not fit is counted and lost, as in the bridge.
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

/// The USB-to-serial bridge: requests set the line, bytes take their time on it, packets towards the host leave when full
/// or when the latency timer has run out, each with two status bytes.
class FtdiModel {
 public:
  /// A vendor request; false if the bridge does not know it.
  bool request(std::uint8_t request, std::uint16_t value) noexcept;
  void from_host(std::span<const std::byte> bytes) noexcept;
  /// A packet for the host, or nothing yet. @param into at least 2 bytes
  [[nodiscard]] std::optional<std::size_t> to_host(std::span<std::byte> into) noexcept;

  /// Moves time on; then next_for_device() hands out what has arrived meanwhile.
  void advance(Duration dt) noexcept;
  [[nodiscard]] std::optional<std::byte> next_for_device() noexcept;
  void from_device(std::byte b) noexcept { up_line_.push(b); }
  void set_cts(bool raised) noexcept { cts_ = raised; }
  /// The next packet says that bytes were lost on the line.
  void mark_line_error() noexcept { line_error_ = true; }
  /// As after USB reset: empty, timers as the chip has them.
  void reset() noexcept;

  [[nodiscard]] std::uint16_t divisor() const noexcept { return divisor_; }
  [[nodiscard]] bool dtr() const noexcept { return dtr_; }
  [[nodiscard]] bool rts() const noexcept { return rts_; }
  /// Rising edges of DTR since construction.
  [[nodiscard]] std::uint64_t dtr_pulses() const noexcept { return dtr_pulses_; }
  [[nodiscard]] unsigned latency_ms() const noexcept { return latency_ms_; }

 private:
  [[nodiscard]] double bytes_per_second() const noexcept;

  std::uint16_t divisor_ = 0x4138;
  unsigned latency_ms_ = 16;
  bool dtr_ = false, rts_ = false, cts_ = false, line_error_ = false;
  std::uint64_t dtr_pulses_ = 0;
  ByteQueue<4096> down_line_, up_line_, up_;
  std::size_t arrived_ = 0;  ///< bytes of down_line_ that the device may take
  double down_credit_ = 0, up_credit_ = 0;
  Duration since_packet_{};
};

}  // namespace tandem::hal::wire
