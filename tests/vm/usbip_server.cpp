#include "tests/vm/usbip_server.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "tests/vm/uhid_device.h"

namespace tandem::test {

using hal::emulation::SetupPacket;
using hal::emulation::TransferResult;
using hal::emulation::TransferStatus;

namespace {

// USB/IP header: 48 bytes, big endian (Documentation/usb/usbip_protocol.rst of the kernel).
constexpr std::size_t kHeaderWords = 12;
constexpr std::uint32_t kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4;
constexpr std::size_t kSequence = 1, kDirection = 3, kEndpoint = 4, kLength = 6, kVictim = 5, kSetup = 10;
constexpr std::size_t kStatus = 5, kMoved = 6;
constexpr unsigned kFullSpeed = 2;
constexpr std::uint32_t kDevice = 0x00010002;
using Header = std::array<std::uint32_t, kHeaderWords>;

bool receive(int fd, void* into, std::size_t size) {
  for (std::size_t have = 0; have < size;) {
    const auto got = recv(fd, static_cast<char*>(into) + have, size - have, 0);
    if (got <= 0 && errno != EINTR) return false;
    have += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  }
  return true;
}

void transmit(int fd, const Header& header, std::span<const std::byte> data) {
  Header wire = header;
  for (auto& word : wire) word = htonl(word);
  std::vector<std::byte> all(sizeof wire);
  std::memcpy(all.data(), wire.data(), sizeof wire);
  all.insert(all.end(), data.begin(), data.end());
  for (std::size_t sent = 0; sent < all.size();) {
    const auto n = send(fd, all.data() + sent, all.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return;
    sent += static_cast<std::size_t>(n);
  }
}

std::size_t give(std::span<const std::byte> from, std::vector<std::byte>& into, std::size_t room) {
  const std::size_t n = std::min(from.size(), room);
  into.assign(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(n));
  return n;
}

}  // namespace

UsbipServer::UsbipServer(hal::emulation::EmulatedUsbDevice& model, unsigned port, Duration raster)
    : model_(model), raster_(raster), served_at_(on_raster(io::monotonic_now())) {
  int pair[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0) return;
  ours_ = io::Fd(pair[0]);
  const io::Fd theirs(pair[1]);  // the kernel keeps its own reference
  thread_ = std::jthread([this](std::stop_token stop) { serve(stop); });
  std::ofstream attach("/sys/devices/platform/vhci_hcd.0/attach");
  attach << port << ' ' << theirs.get() << ' ' << kDevice << ' ' << kFullSpeed << std::flush;
  attached_ = attach.good();
}

UsbipServer::~UsbipServer() { unplug(); }

void UsbipServer::unplug() {
  with_model([&] { model_.unplug(); });
  shutdown(ours_.get(), SHUT_RDWR);
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void UsbipServer::serve(std::stop_token stop) {
  (void)io::request_realtime(kDevicePriority);  // a real device does not wait for the host's processor
  while (!stop.stop_requested()) {
    pollfd one{ours_.get(), POLLIN, 0};
    // While a transfer is pending, the model advances at every step of its raster.
    const Duration until_next = on_raster(io::monotonic_now()) + raster_ - io::monotonic_now();
    const timespec timeout = io::to_timespec(pending_.empty() ? Duration(std::chrono::milliseconds(5)) : until_next);
    const int ready = ppoll(&one, 1, &timeout, nullptr);
    const std::lock_guard hold(mutex_);
    if (ready > 0 && !take_request()) return;
    finish_pending();
  }
}

bool UsbipServer::take_request() {
  Header h{};
  if (!receive(ours_.get(), h.data(), sizeof h)) return false;
  Transfer transfer;
  std::memcpy(transfer.setup.data(), &h[kSetup], transfer.setup.size());  // eight bytes, not numbers: their order stays
  for (auto& word : h) word = ntohl(word);
  transfer.sequence = h[kSequence];
  if (h[0] == kUnlink) {
    const auto victim = std::ranges::find(pending_, h[kVictim], &Transfer::sequence);
    Header reply{kUnlinked, transfer.sequence};
    if (victim != pending_.end()) {
      reply[kStatus] = static_cast<std::uint32_t>(-ECONNRESET);
      pending_.erase(victim);
    }
    transmit(ours_.get(), reply, {});
    return true;
  }
  if (h[0] != kSubmit) return false;
  transfer.in = h[kDirection] == 1;
  transfer.endpoint = h[kEndpoint];
  transfer.room = h[kLength];
  if (!transfer.in) {
    transfer.data.resize(transfer.room);
    if (!receive(ours_.get(), transfer.data.data(), transfer.room)) return false;
  }
  pending_.push_back(std::move(transfer));
  return true;
}

void UsbipServer::finish_pending() {
  const Time now = on_raster(io::monotonic_now());
  model_.advance(now - served_at_);
  served_at_ = now;
  for (auto one = pending_.begin(); one != pending_.end();) one = carry_out(*one) ? pending_.erase(one) : one + 1;
}

bool UsbipServer::carry_out(Transfer& transfer) {
  TransferResult moved = 0;
  constexpr std::uint8_t kIn = 0x80;
  const auto endpoint = static_cast<std::uint8_t>(transfer.endpoint | (transfer.in ? kIn : 0));
  if (transfer.endpoint == 0) {
    moved = control(transfer);
  } else if (transfer.in) {
    std::array<std::byte, 512> packet{};
    moved = model_.bulk_in(endpoint, packet);
    if (moved) moved = give(std::span(packet).first(*moved), transfer.data, transfer.room);
  } else {
    moved = model_.bulk_out(endpoint, transfer.data);
  }
  if (!moved && moved.error() == TransferStatus::kNak) return false;
  answer(transfer, moved ? 0 : moved.error() == TransferStatus::kStall ? -EPIPE : -ESHUTDOWN, moved.value_or(0));
  return true;
}

void UsbipServer::answer(const Transfer& transfer, int status, std::size_t moved) {
  Header reply{kSubmitted, transfer.sequence};
  reply[kStatus] = static_cast<std::uint32_t>(status);
  reply[kMoved] = static_cast<std::uint32_t>(moved);
  transmit(ours_.get(), reply,
           transfer.in ? std::span<const std::byte>(transfer.data).first(moved) : std::span<const std::byte>{});
}

/// Answers the standard requests of an enumeration; the model answers all others. (The controller handles SET_ADDRESS.)
TransferResult UsbipServer::control(Transfer& transfer) {
  const SetupPacket setup = hal::emulation::setup_from(transfer.setup);
  constexpr std::uint8_t kGetStatus = 0, kGetDescriptor = 6, kSetConfiguration = 9, kSetInterface = 11;
  constexpr std::uint8_t kOfDevice = 1, kOfConfiguration = 2, kOfString = 3;
  const bool standard = (setup.request_type & 0x60) == 0;
  if (standard && setup.request == kGetDescriptor) {
    const auto index = static_cast<std::uint8_t>(setup.value & 0xFF);
    switch (setup.value >> 8) {
      case kOfDevice:
        return give(model_.device_descriptor(), transfer.data, transfer.room);
      case kOfConfiguration:
        return give(model_.config_descriptor(), transfer.data, transfer.room);
      case kOfString: {
        std::vector<std::byte> text{std::byte{4}, std::byte{kOfString}, std::byte{0x09},
                                    std::byte{0x04}};  // language: US English
        if (index != 0) {
          text.resize(2);
          for (const char c : model_.string(index)) text.insert(text.end(), {static_cast<std::byte>(c), std::byte{0}});
          text[0] = static_cast<std::byte>(text.size());
        }
        return give(text, transfer.data, transfer.room);
      }
      default:
        return std::unexpected(TransferStatus::kStall);
    }
  }
  if (standard && setup.request == kGetStatus) {
    const std::array<std::byte, 2> nothing{};
    return give(nothing, transfer.data, transfer.room);
  }
  if (standard && (setup.request == kSetConfiguration || setup.request == kSetInterface)) return 0;
  std::vector<std::byte> room = transfer.data;
  if (transfer.in) room.resize(transfer.room);
  const TransferResult moved = model_.control(setup, room);
  if (moved && transfer.in) transfer.data = room;
  return moved;
}

}  // namespace tandem::test
