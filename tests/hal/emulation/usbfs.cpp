#include "tests/hal/emulation/usbfs.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <utility>

namespace tandem::test {

using hal::emulation::SetupPacket;
using hal::emulation::TransferResult;
using hal::emulation::TransferStatus;

/// The kernel's record of a transfer; results are copied to the caller's record only on reaping.
struct UsbfsNode::Urb {
  usbdevfs_urb* owner = nullptr;
  int status = 0;
  int moved = 0;
};

namespace {

constexpr std::size_t kSetupSize = 8;
constexpr std::size_t kPacketMax = 1024;

std::span<std::byte> bytes_of(void* buffer, int size) {
  return {static_cast<std::byte*>(buffer), static_cast<std::size_t>(std::max(size, 0))};
}

}  // namespace

UsbfsNode::UsbfsNode(hal::emulation::EmulatedUsbDevice& model, std::string kernel_driver)
    : ModelNode(model), driver_(std::move(kernel_driver)) {
  appear();
}
UsbfsNode::~UsbfsNode() { vanish(); }

void UsbfsNode::serve() {
  if (gone()) return;
  advance();
  // Sent data may be answered at once by a read submitted earlier.
  for (bool moved = true; moved;) {
    moved = false;
    for (auto urb = pending_.begin(); urb != pending_.end();) {
      if (carry_out(*urb)) {
        finish(*urb);
        urb = pending_.erase(urb);
        moved = true;
      } else {
        ++urb;
      }
    }
  }
}

void UsbfsNode::service() {
  const std::lock_guard hold(mutex_);
  serve();
}

/// Performs a transfer. @return whether it ended
bool UsbfsNode::carry_out(Urb& urb) {
  usbdevfs_urb& u = *urb.owner;
  const auto buffer = bytes_of(u.buffer, u.buffer_length);
  TransferResult moved = std::unexpected(TransferStatus::kStall);
  if (u.type == USBDEVFS_URB_TYPE_CONTROL) {
    const SetupPacket setup = hal::emulation::setup_from(buffer.first<kSetupSize>());
    moved = model().control(
        setup, buffer.subspan(kSetupSize).first(std::min<std::size_t>(setup.length, buffer.size() - kSetupSize)));
  } else if ((u.endpoint & 0x80) != 0) {
    std::array<std::byte, kPacketMax> packet{};
    moved = model().bulk_in(u.endpoint, packet);
    if (moved) {
      const std::size_t kept = std::min(*moved, buffer.size());
      std::copy_n(packet.begin(), kept, buffer.begin());
      urb.status = kept < *moved ? -EOVERFLOW : 0;
      *moved = kept;
    }
  } else {
    moved = model().bulk_out(u.endpoint, buffer);
  }
  if (moved) {
    urb.moved = static_cast<int>(*moved);
    return true;
  }
  if (moved.error() == TransferStatus::kNak) return false;
  urb.status = moved.error() == TransferStatus::kStall ? -EPIPE : -ESHUTDOWN;
  return true;
}

void UsbfsNode::finish(Urb urb) {
  if (done_.empty()) gate().writable(true);
  done_.push_back(urb);
}

long UsbfsNode::submit(void* argument) {
  if (!hand_in()) return -ENODEV;
  auto* owner = static_cast<usbdevfs_urb*>(argument);
  if (owner->type == USBDEVFS_URB_TYPE_CONTROL && owner->buffer_length < static_cast<int>(kSetupSize)) return -EINVAL;
  if (owner->type != USBDEVFS_URB_TYPE_CONTROL && owner->type != USBDEVFS_URB_TYPE_BULK) return -EINVAL;
  pending_.push_back({owner});
  serve();
  return 0;
}

long UsbfsNode::reap(void* argument) {
  if (done_.empty()) return gone() ? -ENODEV : -EAGAIN;
  const Urb urb = done_.front();
  done_.pop_front();
  if (done_.empty() && !gone()) gate().writable(false);
  urb.owner->status = urb.status;
  urb.owner->actual_length = urb.moved;
  *static_cast<void**>(argument) = urb.owner;
  return 0;
}

long UsbfsNode::discard(void* argument) {
  const auto urb = std::ranges::find(pending_, static_cast<usbdevfs_urb*>(argument), &Urb::owner);
  if (urb == pending_.end()) return gone() ? -ENODEV : -EINVAL;
  finish({urb->owner, -ENOENT, 0});
  pending_.erase(urb);
  return 0;
}

long UsbfsNode::claim(int fd) {
  if (!driver_.empty() || (claimed_by_ && *claimed_by_ != fd)) return -EBUSY;
  claimed_by_ = fd;
  return 0;
}

/// Unbinds and binds the kernel's own driver.
long UsbfsNode::driver_request(void* argument) {
  const auto& command = *static_cast<usbdevfs_ioctl*>(argument);
  if (static_cast<unsigned>(command.ioctl_code) == USBDEVFS_DISCONNECT) {
    if (driver_.empty()) return -ENODATA;
    detached_ = std::exchange(driver_, {});
    return 0;
  }
  if (static_cast<unsigned>(command.ioctl_code) == USBDEVFS_CONNECT) {
    if (claimed_by_ || detached_.empty()) return -EBUSY;
    driver_ = std::exchange(detached_, {});
    return 1;
  }
  return -ENOTTY;
}

void UsbfsNode::end_transfers() {
  for (Urb& urb : pending_) finish({urb.owner, -ESHUTDOWN, 0});
  pending_.clear();
}

std::string UsbfsNode::kernel_driver() const {
  const std::lock_guard hold(mutex_);
  return driver_;
}

long UsbfsNode::on_ioctl(int fd, unsigned long request, void* argument) {
  const std::lock_guard hold(mutex_);
  switch (request) {
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      return reap(argument);
    case USBDEVFS_DISCARDURB:
      return discard(argument);
    case USBDEVFS_SUBMITURB:
      return submit(argument);
    default:
      break;
  }
  if (gone()) return -ENODEV;
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<std::uint32_t*>(argument) =
          USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return 0;
    case USBDEVFS_CLAIMINTERFACE:
      return claim(fd);
    case USBDEVFS_RELEASEINTERFACE:
      if (claimed_by_ == fd) claimed_by_.reset();
      return 0;
    case USBDEVFS_GETDRIVER: {
      auto& answer = *static_cast<usbdevfs_getdriver*>(argument);
      const std::string name = claimed_by_ ? "usbfs" : driver_;
      if (name.empty()) return -ENODATA;
      std::strncpy(answer.driver, name.c_str(), sizeof answer.driver - 1);
      return 0;
    }
    case USBDEVFS_IOCTL:
      return driver_request(argument);
    case USBDEVFS_CLEAR_HALT: {
      constexpr std::uint8_t kToEndpoint = 0x02, kClearFeature = 1;
      const auto endpoint = static_cast<std::uint16_t>(*static_cast<unsigned*>(argument));
      advance();
      return model().control({kToEndpoint, kClearFeature, 0, endpoint, 0}, {}) ? 0 : -EPIPE;
    }
    default:
      return -ENOTTY;  // also USBDEVFS_DISCONNECT_CLAIM: libusb then performs both steps separately
  }
}

}  // namespace tandem::test
