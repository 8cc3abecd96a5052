#include "tests/hal/emulation/devices/ftdi_model.h"

#include <algorithm>
#include <chrono>

#include "hal/drivers/falcon/falcon_ftdi.h"

namespace tandem::hal::emulation {

bool FtdiModel::request(std::uint8_t request, std::uint16_t value) noexcept {
  switch (request) {
    case ftdi::kReset:
      if (value == 0 || value == ftdi::kPurgeIn) up_.clear();
      if (value == 0 || value == ftdi::kPurgeOut) {
        down_line_.clear();
        arrived_ = 0;
      }
      return value <= 2;
    case ftdi::kModem:
      if ((value & 0x0100) != 0) {
        const bool dtr = (value & 1) != 0;
        dtr_pulses_ += dtr && !dtr_ ? 1 : 0;
        dtr_ = dtr;
      }
      if ((value & 0x0200) != 0) rts_ = (value & 2) != 0;
      return true;
    case ftdi::kBaud:
      divisor_ = value;
      return true;
    case ftdi::kFlow:
    case ftdi::kFormat:
      return true;
    case ftdi::kLatency:
      if (value == 0 || value > 255) return false;
      latency_ms_ = value;
      return true;
    default:
      return false;
  }
}

void FtdiModel::from_host(std::span<const std::byte> bytes) noexcept {
  for (const std::byte b : bytes) down_line_.push(b);
}

double FtdiModel::bytes_per_second() const noexcept {
  constexpr double kBitsPerByte = 10;  // 8N1
  const unsigned whole = divisor_ & 0x3FFFu;
  // The upper bits are eighths: 00 0, 01 1/2, 10 1/4, 11 1/8.
  constexpr std::array<double, 4> kEighths{0, 0.5, 0.25, 0.125};
  const double divisor = whole == 0 ? 1.0 : whole == 1 ? 1.5 : whole + kEighths[divisor_ >> 14];
  return 3e6 / divisor / kBitsPerByte;
}

void FtdiModel::advance(Duration dt) noexcept {
  const double bytes = bytes_per_second() * seconds(dt);
  since_packet_ += dt;
  const std::size_t waiting = down_line_.size() - arrived_;
  down_credit_ = waiting == 0 ? 0 : down_credit_ + bytes;
  const std::size_t down = std::min(waiting, static_cast<std::size_t>(down_credit_));
  arrived_ += down;
  down_credit_ -= static_cast<double>(down);
  up_credit_ = up_line_.empty() ? 0 : up_credit_ + bytes;
  for (; up_credit_ >= 1 && !up_line_.empty(); up_credit_ -= 1) up_.push(up_line_.pop());
}

std::optional<std::byte> FtdiModel::next_for_device() noexcept {
  if (arrived_ == 0) return std::nullopt;
  --arrived_;
  return down_line_.pop();
}

std::optional<std::size_t> FtdiModel::to_host(std::span<std::byte> into) noexcept {
  if (into.size() < 2) return std::nullopt;
  if (up_.size() < kFtdiPayload && since_packet_ < std::chrono::milliseconds(latency_ms_)) return std::nullopt;
  since_packet_ = {};
  into[0] = static_cast<std::byte>(0x01u | (cts_ ? ftdi::kCts : 0u));  // the bridge always sets the lowest bit
  into[1] = static_cast<std::byte>(0x60u | (line_error_ ? 0x02u : 0u));
  line_error_ = false;
  std::size_t size = 2;
  const std::size_t room = std::min(into.size(), kFtdiPacket);
  while (size < room && !up_.empty()) into[size++] = up_.pop();
  return size;
}

void FtdiModel::reset() noexcept {
  const std::uint64_t pulses = dtr_pulses_;
  *this = FtdiModel{};
  dtr_pulses_ = pulses;
}

}  // namespace tandem::hal::emulation
