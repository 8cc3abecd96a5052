#include "tests/vm/uhid_device.h"

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "hal/core/report_descriptor.h"

namespace tandem::test {
namespace {

constexpr int kEventsMax = 32;  // length of the kernel's queue

template <std::size_t N>
void copy(std::string_view text, __u8 (&into)[N]) {
  std::memcpy(into, text.data(), std::min(text.size(), N - 1));
}

bool post(int fd, const uhid_event& event) {
  return write(fd, &event, sizeof event) == static_cast<ssize_t>(sizeof event);
}

}  // namespace

UhidDevice::UhidDevice(hal::emulation::EmulatedHidDevice& model, Duration raster)
    : model_(model),
      raster_(raster),
      fd_(open("/dev/uhid", O_RDWR | O_NONBLOCK | O_CLOEXEC)),
      numbered_(hal::has_report_ids(model.report_descriptor())),
      served_at_(io::monotonic_now()) {
  auto event = std::make_unique<uhid_event>();
  event->type = UHID_CREATE2;
  auto& request = event->u.create2;
  copy(model.product(), request.name);
  copy(model.serial(), request.uniq);
  const auto descriptor = model.report_descriptor();
  std::memcpy(request.rd_data, descriptor.data(), descriptor.size());
  request.rd_size = static_cast<__u16>(descriptor.size());
  request.bus = BUS_USB;
  request.vendor = model.vendor_id();
  request.product = model.product_id();
  if (!fd_.open() || !post(fd_.get(), *event)) {
    fd_.reset();
    return;
  }
  thread_ = std::jthread([this](std::stop_token stop) { serve(stop); });
}

UhidDevice::~UhidDevice() { unplug(); }

void UhidDevice::unplug() {
  if (!fd_.open()) return;
  with_model([&] { model_.unplug(); });
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  fd_.reset();  // the kernel destroys the device when its last file descriptor closes
}

void UhidDevice::serve(std::stop_token stop) {
  (void)io::request_realtime(kDevicePriority);  // a real device does not wait for the host's processor
  while (!stop.stop_requested()) {
    pollfd one{fd_.get(), POLLIN, 0};
    const timespec raster = io::to_timespec(raster_);
    const int ready = ppoll(&one, 1, &raster, nullptr);
    const std::lock_guard hold(mutex_);
    const Time now = io::monotonic_now();
    model_.advance(now - served_at_);
    served_at_ = now;
    for (int events = 0; ready > 0 && events < kEventsMax && take_event(); ++events) {
    }
    send_reports();
  }
}

bool UhidDevice::take_event() {
  uhid_event event{};
  if (read(fd_.get(), &event, sizeof event) <= 0) return false;
  uhid_event reply{};
  switch (event.type) {
    case UHID_OUTPUT: {
      const auto bytes = std::as_bytes(std::span(&event.u.output.data[0], event.u.output.size));
      if (!bytes.empty()) (void)model_.report_out(numbered_ ? bytes : bytes.subspan(1));
      return true;
    }
    case UHID_GET_REPORT:
      reply.type = UHID_GET_REPORT_REPLY;
      reply.u.get_report_reply.id = event.u.get_report.id;
      reply.u.get_report_reply.err = EIO;
      break;
    case UHID_SET_REPORT:
      reply.type = UHID_SET_REPORT_REPLY;
      reply.u.set_report_reply.id = event.u.set_report.id;
      reply.u.set_report_reply.err = EIO;
      break;
    default:
      return true;
  }
  (void)post(fd_.get(), reply);
  return true;
}

void UhidDevice::send_reports() {
  uhid_event event{};
  event.type = UHID_INPUT2;
  const auto room = std::as_writable_bytes(std::span(&event.u.input2.data[0], UHID_DATA_MAX));
  while (const auto got = model_.report_in(room)) {
    event.u.input2.size = static_cast<__u16>(*got);
    (void)post(fd_.get(), event);
  }
}

}  // namespace tandem::test
