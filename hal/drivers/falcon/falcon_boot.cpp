#include "hal/drivers/falcon/falcon_boot.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "hal/drivers/falcon/falcon_ftdi.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

constexpr std::array kGreeting{std::byte{0x0A}, std::byte{0x43}, std::byte{0x0D}};
constexpr std::array kGreeted{std::byte{0x0A}, std::byte{0x44}, std::byte{0x2C}, std::byte{0x0D}};
constexpr std::array kReady{std::byte{0x41}};
constexpr int kGreetings = 3;
constexpr std::size_t kGreetingReplyMax = 512;
constexpr Duration kGreetingWait = 100ms;
constexpr Duration kCtsWait = 50ms;  // some devices never raise CTS; then the loader continues without it
constexpr Duration kReadyWait = 100ms;
constexpr Duration kEchoWait = 200ms;
constexpr Duration kBootWriteWait = 200ms;
constexpr Duration kReadSlice = 5ms;
constexpr Duration kRest = 20ms;  // pause between two attempts
constexpr int kProbeFrames = 10;
constexpr Duration kProbeWait = 10ms;

}  // namespace

Result<> check_firmware(const FalconFirmware& firmware, const std::optional<std::string>& sha256) {
  const std::size_t size = firmware.image.size();
  const auto refuse = [&](const std::string& why) {
    return std::unexpected(DeviceError{Errc::kFirmware, firmware.file + ": " + why});
  };
  if (size < kFirmwareMin || size > kFirmwareMax) {
    const std::string has = size > kFirmwareMax ? "more than " + std::to_string(kFirmwareMax)
                                                : std::to_string(size);  // reading stops there
    return refuse("has " + has + " bytes; a Falcon's firmware image has " + std::to_string(kFirmwareMin) + " to " +
                  std::to_string(kFirmwareMax) +
                  ". Give the raw image of the vendor's driver, not an installer or a text");
  }
  const auto is_text = [](std::byte b) {
    return (b >= std::byte{0x20} && b < std::byte{0x7F}) || b == std::byte{'\n'} || b == std::byte{'\r'} ||
           b == std::byte{'\t'};
  };
  if (std::ranges::all_of(firmware.image, is_text)) {
    return refuse("is a text, not a firmware image; a hex file must be turned into raw bytes first");
  }
  if (std::ranges::all_of(firmware.image, [&](std::byte b) { return b == firmware.image[0]; })) {
    return refuse("is one byte repeated, not a firmware image; copy it again");
  }
  if (sha256 && *sha256 != firmware.sha256) {
    return refuse("has SHA-256 " + firmware.sha256 + ", the device's file expects " + *sha256 +
                  "; give that image, or correct firmware.sha256 if this one is known to work");
  }
  return {};
}

template <class Take>
std::expected<bool, FalconBoot::Trouble> FalconBoot::read_for(Duration wait, Take take) noexcept {
  const Time until = clock_.now() + wait;
  std::array<std::byte, kFtdiPacket> packet{};
  // Idle bridges send empty packets. The clock ends this loop; the packet count only guards against a stopped clock.
  for (int packets = 0; packets < 10000; ++packets) {
    const Time now = clock_.now();
    if (now >= until) return false;
    const Moved moved = pipe_.read(packet, std::min(kReadSlice, until - now));
    if (!moved) {
      if (moved.error() == Errc::kTimeout) continue;
      return std::unexpected(Trouble{moved.error(), "reading failed"});
    }
    const FtdiPacket p = ftdi_packet(std::span(packet).first(std::min(*moved, packet.size())));
    if (p.whole && take(p.payload, p.cts)) return true;
  }
  return false;
}

std::expected<std::optional<FalconReply>, Errc> FalconBoot::probe() noexcept {
  if (auto line = line_for_servo(pipe_); !line) return std::unexpected(line.error());
  FalconFramer framer;
  std::optional<FalconReply> reply;
  for (int i = 0; i < kProbeFrames && !reply; ++i) {
    if (watcher_.cancelled()) return std::optional<FalconReply>{};
    if (auto sent = write(encode(FalconCommand{})); !sent) {
      if (sent.error().code == Errc::kTimeout) continue;
      return std::unexpected(sent.error().code);
    }
    const auto read = read_for(kProbeWait, [&](std::span<const std::byte> payload, bool) {
      for (const std::byte b : payload) {
        if (const auto frame = framer.push(b)) {
          if (const auto decoded = decode_reply(*frame)) reply = *decoded;
        }
      }
      return reply.has_value();
    });
    if (!read) return std::unexpected(read.error().code);
  }
  return reply;
}

FalconBoot::Step FalconBoot::write(std::span<const std::byte> bytes) noexcept {
  const Moved moved = pipe_.write(bytes, kBootWriteWait);
  if (!moved) return std::unexpected(Trouble{moved.error(), "writing failed"});
  if (*moved != bytes.size()) return std::unexpected(Trouble{Errc::kTimeout, "not all bytes could be written"});
  return {};
}

FalconBoot::Step FalconBoot::greet() noexcept {
  if (auto line = line_for_boot(pipe_); !line)
    return std::unexpected(Trouble{line.error(), "the line could not be reset"});
  for (int i = 0; i < kGreetings; ++i) {
    if (auto sent = write(kGreeting); !sent) return sent;
    // The reply may arrive in pieces, after a zero byte, or twice: it is searched anywhere in the received bytes.
    std::size_t matched = 0, seen = 0;
    const auto read = read_for(kGreetingWait, [&](std::span<const std::byte> payload, bool) {
      for (const std::byte b : payload) {
        if (++seen > kGreetingReplyMax) return false;
        matched = b == kGreeted[matched] ? matched + 1 : (b == kGreeted[0] ? 1 : 0);
        if (matched == kGreeted.size()) return true;
      }
      return false;
    });
    if (!read) return std::unexpected(read.error());
    if (*read) return {};
  }
  return std::unexpected(Trouble{Errc::kFirmware, "the boot loader did not answer the greeting"});
}

FalconBoot::Step FalconBoot::open_for_image() noexcept {
  if (auto line = line_for_image(pipe_); !line)
    return std::unexpected(Trouble{line.error(), "the speed could not be set"});
  // Devices raise CTS when they are ready for the new speed; this is reported by users, not specified.
  if (const auto cts = read_for(kCtsWait, [](std::span<const std::byte>, bool raised) { return raised; }); !cts) {
    return std::unexpected(cts.error());
  }
  if (auto sent = write(kReady); !sent) return sent;
  const auto read = read_for(kReadyWait, [](std::span<const std::byte> payload, bool) {
    return std::ranges::find(payload, kReady[0]) != payload.end();  // 41, or 13 41
  });
  if (!read) return std::unexpected(read.error());
  if (!*read) return std::unexpected(Trouble{Errc::kFirmware, "the boot loader did not get ready for the image"});
  return {};
}

FalconBoot::Step FalconBoot::send_image(std::span<const std::byte> image) {
  for (std::size_t at = 0; at < image.size(); at += kFtdiPayload) {
    if (watcher_.cancelled()) return std::unexpected(Trouble{Errc::kBadState, "cancelled"});
    const auto block = image.subspan(at, std::min(kFtdiPayload, image.size() - at));
    if (auto sent = write(block); !sent) return sent;
    std::size_t echoed = 0;
    bool same = true;
    const auto read = read_for(kEchoWait, [&](std::span<const std::byte> payload, bool) {
      for (const std::byte b : payload) {
        same = same && echoed < block.size() && b == block[echoed];
        ++echoed;
      }
      return !same || echoed == block.size();
    });
    if (!read) return std::unexpected(read.error());
    if (!same)
      return std::unexpected(Trouble{Errc::kFirmware, "the image came back with other bytes than it was sent with"});
    if (!*read) return std::unexpected(Trouble{Errc::kFirmware, "the image stopped coming back"});
    watcher_.progress("loading firmware", static_cast<double>(at + block.size()) / static_cast<double>(image.size()));
  }
  return {};
}

FalconBoot::Step FalconBoot::attempt(std::span<const std::byte> image) {
  if (auto step = greet(); !step) return step;
  if (auto step = open_for_image(); !step) return step;
  return send_image(image);
}

Result<FalconReply> FalconBoot::load(const FalconFirmware& firmware) {
  Trouble last;
  for (attempts_ = 1; attempts_ <= kBootAttempts; ++attempts_) {
    if (watcher_.cancelled()) return std::unexpected(DeviceError{Errc::kBadState, "cancelled while loading firmware"});
    watcher_.progress("loading firmware", 0);
    if (auto step = attempt(firmware.image); !step) {
      last = step.error();
    } else {
      const auto reply = probe();
      if (reply && *reply) return **reply;
      last = reply ? Trouble{Errc::kFirmware, "the image was taken, but the device does not answer"}
                   : Trouble{reply.error(), "the device was lost after the image"};
    }
    if (last.code == Errc::kUnplugged) {
      return std::unexpected(DeviceError{Errc::kUnplugged, "the Falcon was unplugged while its firmware was loaded"});
    }
    if (last.code == Errc::kBadState) break;
    if (last.code == Errc::kProtocol) {
      if (const auto cleared = pipe_.clear_halt(); !cleared && cleared.error() == Errc::kUnplugged) {
        return std::unexpected(DeviceError{Errc::kUnplugged, "the Falcon was unplugged while its firmware was loaded"});
      }
    }
    clock_.wait_until(clock_.now() + kRest);
  }
  if (last.code == Errc::kBadState)
    return std::unexpected(DeviceError{Errc::kBadState, "cancelled while loading firmware"});
  attempts_ = kBootAttempts;
  return std::unexpected(DeviceError{
      Errc::kFirmware, "firmware " + firmware.file + " could not be loaded in " + std::to_string(kBootAttempts) +
                           " attempts; the last one: " + last.what +
                           ". Check the power supply, unplug power and USB for ten seconds, try another port, "
                           "and check that the file is the image of this device"});
}

}  // namespace tandem::hal
