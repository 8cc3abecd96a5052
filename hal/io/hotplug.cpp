#include "hal/io/hotplug.h"

#include <libudev.h>
#include <poll.h>

#include <algorithm>
#include <ctime>

namespace tandem::hal {
namespace {

Time now() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{std::chrono::seconds(t.tv_sec) + Duration{t.tv_nsec}};
}

std::vector<Attached> look() {
  std::vector<Attached> all = list_usb();
  std::ranges::move(list_hidraw(), std::back_inserter(all));
  return all;
}

bool holds(const std::vector<Attached>& list, const Attached& device) {
  return std::ranges::any_of(list, [&](const Attached& a) {
    return a.bus == device.bus && a.node == device.node && a.instance == device.instance;
  });
}

}  // namespace

struct PlugWatch::Impl {
  udev* context = nullptr;
  udev_monitor* monitor = nullptr;
  std::vector<Attached> present;
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

  /// @return whether udev had something to say
  bool drain(Duration patience) {
    pollfd one{udev_monitor_get_fd(monitor), POLLIN, 0};
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(patience, Duration::zero())).count();
    if (poll(&one, 1, static_cast<int>(ms)) <= 0) return false;
    while (udev_device* event = udev_monitor_receive_device(monitor)) udev_device_unref(event);
    return true;
  }

  std::vector<PlugChange> difference() {
    std::vector<Attached> fresh = look();
    looked_at = now();
    std::vector<PlugChange> changes;
    for (const Attached& a : present) {
      if (!holds(fresh, a)) changes.push_back({false, a});
    }
    for (const Attached& a : fresh) {
      if (!holds(present, a)) changes.push_back({true, a});
    }
    present = std::move(fresh);
    return changes;
  }
};

PlugWatch::PlugWatch(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PlugWatch::~PlugWatch() = default;

Result<std::unique_ptr<PlugWatch>> PlugWatch::open() {
  auto impl = std::make_unique<Impl>();
  if (!impl->listen()) {
    return std::unexpected(
        DeviceError{Errc::kInternal, "udev does not let this program listen for devices (libudev's monitor)."});
  }
  (void)impl->difference();  // after listening began, so that nothing falls between
  return std::unique_ptr<PlugWatch>(new PlugWatch(std::move(impl)));
}

const std::vector<Attached>& PlugWatch::present() const noexcept { return impl_->present; }

std::vector<PlugChange> PlugWatch::wait(Duration patience) {
  const Time until = now() + patience;
  for (;;) {
    const Time next = std::min(until, impl_->looked_at + kLookAnyway);
    const bool woken = impl_->drain(next - now());
    if (woken || now() >= impl_->looked_at + kLookAnyway) {
      if (auto changes = impl_->difference(); !changes.empty()) return changes;
    }
    if (now() >= until) return {};
  }
}

}  // namespace tandem::hal
