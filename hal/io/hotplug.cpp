#include "hal/io/hotplug.h"

#include <libudev.h>
#include <poll.h>

#include <algorithm>

#include "common/io/clock.h"

namespace tandem::hal {
namespace {

std::vector<AttachedDevice> look() {
  std::vector<AttachedDevice> all = list_usb();
  std::ranges::move(list_hidraw(), std::back_inserter(all));
  return all;
}

bool holds(const std::vector<AttachedDevice>& list, const AttachedDevice& device) {
  return std::ranges::any_of(list, [&](const AttachedDevice& a) {
    return a.bus == device.bus && a.node == device.node && a.instance == device.instance;
  });
}

}  // namespace

struct HotplugMonitor::Impl {
  udev* context = nullptr;
  udev_monitor* monitor = nullptr;
  std::vector<AttachedDevice> present;
  Time looked_at{};

  ~Impl() {
    if (monitor != nullptr) udev_monitor_unref(monitor);
    if (context != nullptr) udev_unref(context);
  }

  bool listen() {
    context = udev_new();
    if (context == nullptr) return false;
    monitor = udev_monitor_new_from_netlink(context, "udev");
    return monitor != nullptr && udev_monitor_filter_add_match_subsystem_devtype(monitor, "usb", "usb_device") >= 0 &&
           udev_monitor_filter_add_match_subsystem_devtype(monitor, "hidraw", nullptr) >= 0 &&
           udev_monitor_enable_receiving(monitor) >= 0;
  }

  /// @return whether udev sent an event
  bool drain(Duration timeout) {
    pollfd one{udev_monitor_get_fd(monitor), POLLIN, 0};
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(timeout, Duration::zero())).count();
    if (poll(&one, 1, static_cast<int>(ms)) <= 0) return false;
    while (udev_device* event = udev_monitor_receive_device(monitor)) udev_device_unref(event);
    return true;
  }

  std::vector<HotplugEvent> difference() {
    std::vector<AttachedDevice> fresh = look();
    looked_at = io::monotonic_now();
    std::vector<HotplugEvent> changes;
    for (const AttachedDevice& a : present) {
      if (!holds(fresh, a)) changes.push_back({false, a});
    }
    for (const AttachedDevice& a : fresh) {
      if (!holds(present, a)) changes.push_back({true, a});
    }
    present = std::move(fresh);
    return changes;
  }
};

HotplugMonitor::HotplugMonitor(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HotplugMonitor::~HotplugMonitor() = default;

Result<std::unique_ptr<HotplugMonitor>> HotplugMonitor::open() {
  auto impl = std::make_unique<Impl>();
  if (!impl->listen()) {
    return std::unexpected(
        DeviceError{Errc::kInternal, "udev does not let this program listen for devices (libudev's monitor)."});
  }
  (void)impl->difference();  // after the subscription, so that no change is missed
  return std::unique_ptr<HotplugMonitor>(new HotplugMonitor(std::move(impl)));
}

const std::vector<AttachedDevice>& HotplugMonitor::present() const noexcept { return impl_->present; }

std::vector<HotplugEvent> HotplugMonitor::wait(Duration timeout) {
  const Time until = io::monotonic_now() + timeout;
  for (;;) {
    const Time next = std::min(until, impl_->looked_at + kLookAnyway);
    const bool woken = impl_->drain(next - io::monotonic_now());
    if (woken || io::monotonic_now() >= impl_->looked_at + kLookAnyway) {
      if (auto changes = impl_->difference(); !changes.empty()) return changes;
    }
    if (io::monotonic_now() >= until) return {};
  }
}

}  // namespace tandem::hal
