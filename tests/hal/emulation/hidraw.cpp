#include "tests/hal/emulation/hidraw.h"

#include <linux/hidraw.h>
#include <linux/input.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>

#include "hal/core/report_descriptor.h"

namespace tandem::test {

using hal::emulation::TransferStatus;

namespace {

constexpr std::size_t kReportMax = 4096;

int error_of(TransferStatus status) {
  return status == TransferStatus::kStall ? EPIPE : status == TransferStatus::kNak ? ETIMEDOUT : ENODEV;
}

}  // namespace

HidrawNode::HidrawNode(hal::emulation::EmulatedHidDevice& model)
    : ModelNode(model), numbered_(hal::has_report_ids(model.report_descriptor())) {
  appear();
}
HidrawNode::~HidrawNode() { vanish(); }

void HidrawNode::serve() {
  if (gone()) return;
  advance();
  std::array<std::byte, kReportMax> report{};
  while (const auto got = model().report_in(report)) {
    if (queue_.size() < kQueueMax)
      queue_.emplace_back(report.begin(), report.begin() + static_cast<std::ptrdiff_t>(*got));
  }
  if (!queue_.empty()) changed_.notify_all();
}

void HidrawNode::service() {
  const std::lock_guard hold(mutex_);
  serve();
}

ssize_t HidrawNode::on_read(void* into, std::size_t size) {
  const std::lock_guard hold(mutex_);
  serve();
  if (queue_.empty()) return gone() ? -EIO : -EAGAIN;
  const auto& report = queue_.front();
  const std::size_t moved = std::min(size, report.size());
  std::memcpy(into, report.data(), moved);
  queue_.pop_front();
  return static_cast<ssize_t>(moved);
}

std::optional<short> HidrawNode::on_poll(int timeout_ms) {
  std::unique_lock hold(mutex_);
  serve();
  const auto ready = [&] { return gone() || !queue_.empty(); };
  if (timeout_ms < 0) {
    changed_.wait(hold, ready);
  } else {
    changed_.wait_for(hold, std::chrono::milliseconds(timeout_ms), ready);
  }
  return static_cast<short>(gone() ? POLLERR | POLLHUP : queue_.empty() ? 0 : POLLIN);
}

void HidrawNode::end_transfers() {
  queue_.clear();
  changed_.notify_all();
}

ssize_t HidrawNode::on_write(const void* from, std::size_t size) {
  const std::lock_guard hold(mutex_);
  if (!hand_in()) return -ENODEV;
  if (size < 1) return -EINVAL;
  serve();
  const std::span bytes(static_cast<const std::byte*>(from), size);
  const auto moved = model().report_out(numbered_ ? bytes : bytes.subspan(1));
  serve();
  return moved ? static_cast<ssize_t>(size) : -error_of(moved.error());
}

long HidrawNode::on_ioctl(int, unsigned long request, void* argument) {
  const std::lock_guard hold(mutex_);
  if (gone()) return -ENODEV;
  const auto descriptor = model().report_descriptor();
  const std::size_t room = _IOC_SIZE(request);
  if (request == HIDIOCGRDESCSIZE) {
    *static_cast<int*>(argument) = static_cast<int>(descriptor.size());
    return 0;
  }
  if (request == HIDIOCGRDESC) {
    auto& answer = *static_cast<hidraw_report_descriptor*>(argument);
    std::memcpy(answer.value, descriptor.data(), std::min<std::size_t>(answer.size, descriptor.size()));
    return 0;
  }
  if (request == HIDIOCGRAWINFO) {
    auto& answer = *static_cast<hidraw_devinfo*>(argument);
    answer = {BUS_USB, static_cast<short>(model().vendor_id()), static_cast<short>(model().product_id())};
    return 0;
  }
  constexpr unsigned kSetFeature = 6, kGetFeature = 7;  // HIDIOCSFEATURE and HIDIOCGFEATURE carry a length
  const std::span buffer(static_cast<std::byte*>(argument), room);
  if (_IOC_NR(request) == kSetFeature || _IOC_NR(request) == kGetFeature) {
    const auto moved = _IOC_NR(request) == kSetFeature ? model().feature_set(buffer) : model().feature_get(buffer);
    return moved ? static_cast<long>(*moved) : -error_of(moved.error());
  }
  return -EINVAL;
}

}  // namespace tandem::test
