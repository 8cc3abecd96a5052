#include "hal/io/usb_pipe.h"

#include <libusb-1.0/libusb.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "common/base/raw_bytes.h"
#include "common/io/clock.h"
#include "hal/io/udev_rule.h"

namespace tandem::hal {
namespace {

constexpr std::uint8_t kVendorOut = 0x40;  ///< bmRequestType: host to device, vendor, device

Errc from_call(int code) noexcept {
  switch (code) {
    case LIBUSB_ERROR_NO_DEVICE:
      return Errc::kUnplugged;
    case LIBUSB_ERROR_ACCESS:
      return Errc::kPermission;
    case LIBUSB_ERROR_BUSY:
      return Errc::kBusy;
    case LIBUSB_ERROR_NOT_FOUND:
      return Errc::kNotFound;
    case LIBUSB_ERROR_TIMEOUT:
      return Errc::kTimeout;
    case LIBUSB_ERROR_PIPE:
    case LIBUSB_ERROR_OVERFLOW:
    case LIBUSB_ERROR_IO:
      return Errc::kProtocol;
    case LIBUSB_ERROR_NOT_SUPPORTED:
      return Errc::kUnsupported;
    default:
      return Errc::kInternal;
  }
}

/// Maps a transfer status. A broken transfer counts like a broken frame: it occurs on bad cables and just before
/// unplugging is detected.
Errc from_transfer(libusb_transfer_status status) noexcept {
  switch (status) {
    case LIBUSB_TRANSFER_NO_DEVICE:
      return Errc::kUnplugged;
    case LIBUSB_TRANSFER_STALL:
    case LIBUSB_TRANSFER_OVERFLOW:
    case LIBUSB_TRANSFER_ERROR:
      return Errc::kProtocol;
    case LIBUSB_TRANSFER_TIMED_OUT:
    case LIBUSB_TRANSFER_CANCELLED:
      return Errc::kTimeout;
    default:
      return Errc::kInternal;
  }
}

/// A transfer that is allocated once and submitted repeatedly.
struct Slot {
  libusb_transfer* transfer = nullptr;
  bool under_way = false;
  int done = 0;  ///< int, as libusb requires

  Slot() : transfer(libusb_alloc_transfer(0)) {}
  Slot(const Slot&) = delete;
  ~Slot() { release(); }
  /// Frees the transfer; call it before its context is freed.
  void release() noexcept { libusb_free_transfer(std::exchange(transfer, nullptr)); }
};

void LIBUSB_CALL on_done(libusb_transfer* transfer) noexcept { static_cast<Slot*>(transfer->user_data)->done = 1; }

/// Returns the packet size of the IN endpoint [bytes] if the interface has both bulk endpoints.
std::optional<std::size_t> packet_size(libusb_device* device, const UsbInterface& wanted) {
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(device, &config) != 0) return std::nullopt;
  std::size_t found = 0;
  bool has_out = false;
  for (const libusb_interface& i : std::span(config->interface, config->bNumInterfaces)) {
    if (i.num_altsetting == 0 || i.altsetting[0].bInterfaceNumber != wanted.number) continue;
    for (const libusb_endpoint_descriptor& e : std::span(i.altsetting[0].endpoint, i.altsetting[0].bNumEndpoints)) {
      if ((e.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_BULK) continue;
      if (e.bEndpointAddress == wanted.in) found = e.wMaxPacketSize;
      has_out = has_out || e.bEndpointAddress == wanted.out;
    }
  }
  libusb_free_config_descriptor(config);
  return has_out && found > 0 ? std::optional(found) : std::nullopt;
}

DeviceError opening_error(int code, const AttachedDevice& device, const UsbInterface& interface) {
  const Errc errc = from_call(code);
  const std::string who = describe(device);
  switch (errc) {
    case Errc::kPermission:
      return {errc, permission_advice(device)};
    case Errc::kBusy:
      return {errc,
              "interface " + std::to_string(interface.number) + " of " + who +
                  " is in use by another program: another tandem-client, the maker's software or a virtual machine. "
                  "End that program ('sudo fuser -v " +
                  device.node + "' names it)."};
    case Errc::kUnplugged:
      return {errc, who + " was unplugged while it was being opened."};
    default:
      return {errc, "cannot open " + who + ": libusb says '" + libusb_strerror(code) + "'."};
  }
}

}  // namespace

struct LibusbPipe::Impl {
  libusb_context* context = nullptr;
  libusb_device_handle* handle = nullptr;
  UsbInterface interface;
  bool claimed = false;
  bool lost = false;
  std::size_t packet = 0;
  Slot in, out, request;
  std::array<std::byte, 1024> in_bytes{};  // the largest bulk packet
  std::array<std::byte, kWriteMax> out_bytes{};
  std::array<std::byte, LIBUSB_CONTROL_SETUP_SIZE> request_bytes{};
  // libusb waits in whole milliseconds, so the pipe waits with ppoll. The set is constant while the device is open.
  std::array<pollfd, 8> wakers{};
  nfds_t waker_count = 0;

  ~Impl() {
    for (Slot* slot : {&in, &out, &request}) {
      if (slot->under_way) cancel(*slot);
    }
    if (claimed) libusb_release_interface(handle, interface.number);
    if (handle != nullptr) libusb_close(handle);
    for (Slot* slot : {&in, &out, &request}) slot->release();
    if (context != nullptr) libusb_exit(context);
  }

  int open(const AttachedDevice& device, bool& fits) {
    if (const int code = libusb_init(&context); code != 0) return code;
    libusb_device** list = nullptr;
    const auto count = libusb_get_device_list(context, &list);
    if (count < 0) return static_cast<int>(count);
    int code = LIBUSB_ERROR_NO_DEVICE;
    for (libusb_device* d : std::span(list, static_cast<std::size_t>(count))) {
      if (libusb_get_bus_number(d) != device.bus_number || libusb_get_device_address(d) != device.address) continue;
      code = libusb_open(d, &handle);
      if (code == 0) {
        const auto size = packet_size(d, interface);
        fits = size.has_value() && *size <= in_bytes.size();
        packet = size.value_or(0);
      }
    }
    libusb_free_device_list(list, 1);
    if (code != 0 || !fits) return code;
    libusb_set_auto_detach_kernel_driver(handle, 1);  // fails only on systems without kernel drivers
    code = libusb_claim_interface(handle, interface.number);
    claimed = code == 0;
    return claimed ? remember_wakers() : code;
  }

  int remember_wakers() {
    const libusb_pollfd** list = libusb_get_pollfds(context);
    if (list == nullptr) return LIBUSB_ERROR_NO_MEM;
    for (const libusb_pollfd** one = list; *one != nullptr && waker_count < wakers.size(); ++one) {
      wakers[waker_count++] = {(*one)->fd, (*one)->events, 0};
    }
    libusb_free_pollfds(list);
    return 0;
  }

  /// @return whether the transfer ended within `timeout`
  bool wait(Slot& slot, Duration timeout) noexcept {
    const Time until = io::monotonic_now() + timeout;
    Duration left = timeout;
    while (slot.done == 0) {  // may have ended during the wait for another transfer
      const timespec rest = io::to_timespec(left);
      if (ppoll(wakers.data(), waker_count, &rest, nullptr) > 0) {
        timeval no_wait{};
        libusb_handle_events_timeout_completed(context, &no_wait, &slot.done);
      }
      if (slot.done == 0 && left <= Duration::zero()) return false;
      left = until - io::monotonic_now();
    }
    slot.under_way = false;
    return true;
  }

  std::expected<void, Errc> submit(Slot& slot) noexcept {
    if (slot.transfer == nullptr) return std::unexpected(Errc::kInternal);
    slot.done = 0;
    if (const int code = libusb_submit_transfer(slot.transfer); code != 0) return fail(from_call(code));
    slot.under_way = true;
    return {};
  }

  /// Cancels a transfer. @return false: it did not end, and its buffer must not be used again
  bool cancel(Slot& slot) noexcept {
    libusb_cancel_transfer(slot.transfer);
    return wait(slot, kTimeout);
  }

  std::unexpected<Errc> fail(Errc code) noexcept {
    lost = lost || code == Errc::kUnplugged;
    return std::unexpected(code);
  }

  /// Submits and waits; cancels the transfer at the time-out. @return bytes moved
  Moved run(Slot& slot, Duration timeout) noexcept {
    if (slot.under_way && !cancel(slot)) return std::unexpected(Errc::kInternal);
    if (const auto sent = submit(slot); !sent) return std::unexpected(sent.error());
    if (!wait(slot, timeout) && !cancel(slot)) return std::unexpected(Errc::kInternal);
    const auto moved = static_cast<std::size_t>(slot.transfer->actual_length);
    if (slot.transfer->status == LIBUSB_TRANSFER_COMPLETED) return moved;
    const Errc code = from_transfer(slot.transfer->status);
    if (code == Errc::kTimeout && moved > 0) return moved;
    return fail(code);
  }
};

LibusbPipe::LibusbPipe(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LibusbPipe::~LibusbPipe() = default;

Result<std::unique_ptr<LibusbPipe>> LibusbPipe::open(const AttachedDevice& device, UsbInterface interface) {
  auto impl = std::make_unique<Impl>();
  impl->interface = interface;
  bool fits = false;
  const int code = impl->open(device, fits);
  if (code != 0) return std::unexpected(opening_error(code, device, interface));
  if (!fits) {
    return std::unexpected(
        DeviceError{Errc::kUnsupported, describe(device) + " has no interface " + std::to_string(interface.number) +
                                            " with the bulk endpoints this driver talks to: it is another "
                                            "device with the same USB id, or a newer model."});
  }
  Impl& i = *impl;
  libusb_fill_bulk_transfer(i.in.transfer, i.handle, interface.in, raw(i.in_bytes.data()), static_cast<int>(i.packet),
                            on_done, &i.in, 0);
  return std::unique_ptr<LibusbPipe>(new LibusbPipe(std::move(impl)));
}

std::expected<void, Errc> LibusbPipe::control(std::uint8_t request, std::uint16_t value, std::uint16_t index) noexcept {
  Impl& i = *impl_;
  if (i.lost) return std::unexpected(Errc::kUnplugged);
  if (i.request.under_way && !i.cancel(i.request)) return std::unexpected(Errc::kInternal);
  libusb_fill_control_setup(raw(i.request_bytes.data()), kVendorOut, request, value, index, 0);
  libusb_fill_control_transfer(i.request.transfer, i.handle, raw(i.request_bytes.data()), on_done, &i.request, 0);
  if (const Moved moved = i.run(i.request, kTimeout); !moved) return std::unexpected(moved.error());
  return {};
}

Moved LibusbPipe::write(std::span<const std::byte> bytes, Duration timeout) noexcept {
  Impl& i = *impl_;
  if (i.lost) return std::unexpected(Errc::kUnplugged);
  if (bytes.size() > kWriteMax) return std::unexpected(Errc::kInternal);
  if (i.out.under_way && !i.cancel(i.out)) return std::unexpected(Errc::kInternal);
  std::ranges::copy(bytes, i.out_bytes.begin());
  libusb_fill_bulk_transfer(i.out.transfer, i.handle, i.interface.out, raw(i.out_bytes.data()),
                            static_cast<int>(bytes.size()), on_done, &i.out, 0);
  return i.run(i.out, timeout);
}

Moved LibusbPipe::read(std::span<std::byte> into, Duration timeout) noexcept {
  Impl& i = *impl_;
  if (i.lost) return std::unexpected(Errc::kUnplugged);
  if (into.size() < i.packet) return std::unexpected(Errc::kInternal);
  if (!i.in.under_way) {
    if (const auto sent = i.submit(i.in); !sent) return std::unexpected(sent.error());
  }
  if (!i.wait(i.in, timeout)) return std::size_t{0};
  if (i.in.transfer->status != LIBUSB_TRANSFER_COMPLETED) return i.fail(from_transfer(i.in.transfer->status));
  const auto moved = static_cast<std::size_t>(i.in.transfer->actual_length);
  std::ranges::copy(std::span(i.in_bytes).first(moved), into.begin());
  (void)i.submit(i.in);  // the next packet may arrive between calls; if this fails, the next call returns the error
  return moved;
}

std::expected<void, Errc> LibusbPipe::clear_halt() noexcept {
  Impl& i = *impl_;
  if (i.lost) return std::unexpected(Errc::kUnplugged);
  if (i.in.under_way && !i.cancel(i.in)) return std::unexpected(Errc::kInternal);
  for (const std::uint8_t endpoint : {i.interface.in, i.interface.out}) {
    if (const int code = libusb_clear_halt(i.handle, endpoint); code != 0) return i.fail(from_call(code));
  }
  return {};
}

}  // namespace tandem::hal
