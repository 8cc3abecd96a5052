#include "hal/drivers/falcon/falcon_ftdi.h"

#include <initializer_list>

namespace tandem::hal {
namespace {

struct Request {
  std::uint8_t request;
  std::uint16_t value;
};

LineResult all_of(UsbPipe& pipe, std::initializer_list<Request> requests) noexcept {
  for (const Request& r : requests) {
    if (auto done = pipe.control(r.request, r.value, 0); !done) return done;
  }
  return {};
}

}  // namespace

FtdiPacket ftdi_packet(std::span<const std::byte> packet) noexcept {
  if (packet.size() < 2) return {};
  return {.whole = true,
          .cts = (std::to_integer<unsigned>(packet[0]) & ftdi::kCts) != 0,
          .line_error = (std::to_integer<unsigned>(packet[1]) & ftdi::kLineErrors) != 0,
          .payload = packet.subspan(2)};
}

LineResult line_for_boot(UsbPipe& pipe) noexcept {
  using namespace ftdi;
  return all_of(pipe, {{kReset, kPurgeIn},
                       {kReset, kPurgeOut},
                       {kLatency, 16},
                       {kBaud, k9600},
                       {kFormat, k8N1},
                       {kFlow, 0},
                       {kModem, kRtsLow},
                       {kModem, kDtrLow},
                       {kModem, kDtrHigh}});
}

LineResult line_for_image(UsbPipe& pipe) noexcept {
  using namespace ftdi;
  return all_of(pipe, {{kModem, kDtrLow}, {kBaud, k143k}});
}

LineResult line_for_servo(UsbPipe& pipe) noexcept {
  using namespace ftdi;
  return all_of(pipe,
                {{kFormat, k8N1}, {kFlow, 0}, {kLatency, 1}, {kBaud, k1500k}, {kReset, kPurgeIn}, {kReset, kPurgeOut}});
}

}  // namespace tandem::hal
