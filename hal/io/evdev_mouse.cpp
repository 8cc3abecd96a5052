#include "hal/io/evdev_mouse.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/base/format.h"

namespace tandem::hal {
namespace {

constexpr const char* kFolder = "/dev/input/";
constexpr unsigned kLeft = 1, kRight = 2, kMiddle = 4;
constexpr int kRoundsMax = 16;  // batches per exchange: a flood of events cannot block the servo

using KeyBits = std::array<unsigned char, KEY_MAX / 8 + 1>;

template <class Bits>
bool has(const Bits& bits, unsigned bit) noexcept {
  return (bits[bit / 8] >> (bit % 8) & 1U) != 0;
}

bool is_mouse(int fd) noexcept {
  std::array<unsigned char, REL_MAX / 8 + 1> axes{};
  KeyBits keys{};
  return ioctl(fd, EVIOCGBIT(EV_REL, axes.size()), axes.data()) >= 0 &&
         ioctl(fd, EVIOCGBIT(EV_KEY, keys.size()), keys.data()) >= 0 && has(axes, REL_X) && has(axes, REL_Y) &&
         has(keys, BTN_LEFT);
}

std::string name_of(int fd) {
  std::array<char, 128> name{};
  return ioctl(fd, EVIOCGNAME(name.size() - 1), name.data()) < 0 ? std::string() : std::string(name.data());
}

/// Returns whether sysfs lists the axes of a mouse; needs no permission.
bool looks_like_a_mouse(const std::string& node) {
  std::ifstream file("/sys/class/input/" + node + "/device/capabilities/rel");
  unsigned long axes = 0;
  return (file >> std::hex >> axes) && (axes & 3U) == 3;
}

/// Returns the ids from sysfs; needs no permission.
std::optional<EvdevMouse::Ids> ids_of(const std::string& node) {
  const std::string folder = "/sys/class/input/" + node + "/device/id/";
  std::ifstream vendor(folder + "vendor"), product(folder + "product");
  EvdevMouse::Ids ids;
  if (!(vendor >> std::hex >> ids.vendor) || !(product >> std::hex >> ids.product)) return std::nullopt;
  return ids;
}

}  // namespace

std::string EvdevMouse::library() {
  utsname system{};
  return uname(&system) == 0 ? std::string("evdev of ") + system.sysname + " " + system.release : "evdev";
}

std::string EvdevMouse::permission_advice(const std::string& path, std::optional<Ids> ids) {
  std::string advice = "mouse: " + path + ": you may not read it. ";
  if (ids) {
    advice += "For this mouse alone, put this udev rule into /etc/udev/rules.d/70-tandem-mouse.rules:\n  " +
              format(
                  "SUBSYSTEM==\"input\", KERNEL==\"event*\", ATTRS{id/vendor}==\"%04x\", ATTRS{id/product}==\"%04x\", "
                  "TAG+=\"uaccess\"",
                  ids->vendor, ids->product) +
              "\nthen `sudo udevadm control --reload` and plug the mouse in again. Or join";
  } else {
    advice += "Join";
  }
  return advice +
         " the group 'input' (`sudo usermod -aG input $USER`, then log in again): its members can read every keyboard, "
         "too. " +
         kWithout;
}

std::vector<EvdevMouse::Found> EvdevMouse::list() {
  std::vector<Found> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder, none)) {
    const std::string node = entry.path().filename().string();
    if (!node.starts_with("event")) continue;
    const int fd = ::open(entry.path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) {
      if ((errno == EACCES || errno == EPERM) && looks_like_a_mouse(node))
        found.push_back({node, "", permission_advice(kFolder + node, ids_of(node))});
      continue;
    }
    if (is_mouse(fd)) found.push_back({node, name_of(fd), ""});
    ::close(fd);
  }
  std::ranges::sort(found, {}, [](const Found& f) { return std::pair{f.node.size(), f.node}; });
  return found;
}

Result<std::unique_ptr<EvdevMouse>> EvdevMouse::open(const std::string& node, bool grab) {
  const std::string path = node.starts_with('/') ? node : kFolder + node;
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) {
    const int why = errno;
    if (why == EACCES || why == EPERM)
      return std::unexpected(
          DeviceError{Errc::kPermission, permission_advice(path, ids_of(path.substr(path.rfind('/') + 1)))});
    return std::unexpected(DeviceError{
        Errc::kNotFound, "mouse: " + path + ": " + std::strerror(why) + "; check that it is plugged in. " + kWithout});
  }
  auto mouse = std::make_unique<EvdevMouse>(fd);
  if (!is_mouse(fd))
    return std::unexpected(
        DeviceError{Errc::kUnsupported, "mouse: " + path + " is no mouse: it has no relative x and y with a button"});
  if (grab && ioctl(fd, EVIOCGRAB, 1) < 0)
    return std::unexpected(DeviceError{
        Errc::kBusy, "mouse: " + path + ": another program has it for itself; end that, or leave out grab=yes"});
  mouse->ask_buttons();
  return mouse;
}

EvdevMouse::~EvdevMouse() { ::close(fd_); }

void EvdevMouse::ask_buttons() noexcept {
  KeyBits keys{};
  if (ioctl(fd_, EVIOCGKEY(keys.size()), keys.data()) < 0) return;
  press(kLeft, has(keys, BTN_LEFT));
  press(kRight, has(keys, BTN_RIGHT));
  press(kMiddle, has(keys, BTN_MIDDLE));
}

std::expected<MouseMove, Errc> EvdevMouse::read() noexcept {
  MouseMove all;
  for (int round = 0; round < kRoundsMax; ++round) {
    std::array<input_event, 64> events;
    const ssize_t got = ::read(fd_, events.data(), sizeof events);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) break;
    if (got <= 0) return std::unexpected(Errc::kUnplugged);  // ENODEV; evdev delivers complete records only
    for (std::size_t i = 0; i < static_cast<std::size_t>(got) / sizeof(input_event); ++i) {
      const input_event& e = events[i];
      if (e.type == EV_SYN && e.code == SYN_DROPPED) {
        dropped_ = true;
      } else if (e.type == EV_SYN && e.code == SYN_REPORT) {
        if (dropped_) {
          ask_buttons();
        } else {
          all.right += pending_.right;
          all.forward += pending_.forward;
          all.wheel += pending_.wheel;
        }
        pending_ = {};
        dropped_ = false;
      } else if (dropped_) {
        continue;
      } else if (e.type == EV_REL) {
        if (e.code == REL_X) pending_.right += e.value;
        if (e.code == REL_Y) pending_.forward -= e.value;  // evdev counts towards the user
        if (e.code == REL_WHEEL) pending_.wheel += e.value;
      } else if (e.type == EV_KEY) {
        if (e.code == BTN_LEFT) press(kLeft, e.value != 0);
        if (e.code == BTN_RIGHT) press(kRight, e.value != 0);
        if (e.code == BTN_MIDDLE) press(kMiddle, e.value != 0);
      }
    }
    if (got < static_cast<ssize_t>(sizeof events)) break;
  }
  all.buttons = buttons_;
  return all;
}

}  // namespace tandem::hal
