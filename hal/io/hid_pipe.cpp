#include "hal/io/hid_pipe.h"

#include <fcntl.h>
#include <hidapi/hidapi.h>
#include <libudev.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "hal/core/report_descriptor.h"
#include "hal/io/hidapi_lock.h"
#include "hal/io/udev_rule.h"

namespace tandem::hal {
namespace {

/// Returns the error of a failed hidapi call, which leaves the system's errno. 0: poll reported that the device is
/// unplugged.
Errc from_errno(int error) noexcept {
  switch (error) {
    case 0:
    case ENODEV:
    case ENXIO:
    case EIO:
    case ESHUTDOWN:
      return Errc::kUnplugged;
    case EPIPE:
    case EPROTO:
    case EILSEQ:
    case EOVERFLOW:
      return Errc::kProtocol;
    case ETIMEDOUT:
      return Errc::kTimeout;
    case EACCES:
    case EPERM:
      return Errc::kPermission;
    case EBUSY:
      return Errc::kBusy;
    default:
      return Errc::kInternal;
  }
}

/// Reads the report descriptor from sysfs; hidapi provides it only from 0.14 on. Empty: none.
std::vector<std::byte> read_descriptor(const std::string& node) {
  std::vector<std::byte> bytes;
  udev* context = udev_new();
  if (context == nullptr) return bytes;
  const std::string name = node.substr(node.rfind('/') + 1);
  if (udev_device* device = udev_device_new_from_subsystem_sysname(context, "hidraw", name.c_str())) {
    std::ifstream file(std::string(udev_device_get_syspath(device)) + "/device/report_descriptor", std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::ranges::transform(all, std::back_inserter(bytes), [](char c) { return static_cast<std::byte>(c); });
    udev_device_unref(device);
  }
  udev_unref(context);
  return bytes;
}

DeviceError opening_error(int error, const AttachedDevice& device) {
  const Errc code = error == ENOENT ? Errc::kUnplugged : from_errno(error);
  if (code == Errc::kPermission) return {code, permission_advice(device)};
  if (code == Errc::kUnplugged) return {code, describe(device) + " was unplugged while it was being opened."};
  return {code, "cannot open " + device.node + " (" + describe(device) + "): " + std::strerror(error) + "."};
}

}  // namespace

struct HidrawPipe::Impl {
  hid_device* device = nullptr;
  int lock = -1;  ///< second descriptor of the node, only for the lock: hidapi does not expose its own
  bool numbered = false;
  bool lost = false;
  std::array<unsigned char, kReportMax + 1> out{};

  ~Impl() {
    if (device != nullptr) {
      const HidapiLock alone;
      hid_close(device);
    }
    if (lock >= 0) ::close(lock);
  }

  std::unexpected<Errc> fail(int error) noexcept {
    const Errc code = from_errno(error);
    lost = lost || code == Errc::kUnplugged;
    return std::unexpected(code);
  }
};

HidrawPipe::HidrawPipe(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HidrawPipe::~HidrawPipe() = default;

Result<std::unique_ptr<HidrawPipe>> HidrawPipe::open(const AttachedDevice& device) {
  const auto present = list_hidraw();
  if (std::ranges::find_if(present, [&](const AttachedDevice& a) {
        return a.node == device.node && a.instance == device.instance;
      }) == present.end()) {
    return std::unexpected(
        DeviceError{Errc::kNotFound, describe(device) + " is no longer attached at " + device.node + "."});
  }
  auto impl = std::make_unique<Impl>();
  // Opened for writing as hidapi does, so that a missing permission is reported with its reason.
  impl->lock = ::open(device.node.c_str(), O_RDWR | O_CLOEXEC);
  if (impl->lock < 0) return std::unexpected(opening_error(errno, device));
  if (flock(impl->lock, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return std::unexpected(opening_error(errno, device));
    return std::unexpected(DeviceError{Errc::kBusy, describe(device) +
                                                        " is in use by another Tandem program. End that program "
                                                        "('sudo fuser -v " +
                                                        device.node + "' names it)."});
  }
  impl->numbered = has_report_ids(read_descriptor(device.node));
  {
    const HidapiLock alone;
    errno = 0;
    impl->device = hid_open_path(device.node.c_str());
    if (impl->device == nullptr) return std::unexpected(opening_error(errno, device));
  }
  return std::unique_ptr<HidrawPipe>(new HidrawPipe(std::move(impl)));
}

Moved HidrawPipe::write(std::span<const std::byte> report) noexcept {
  Impl& i = *impl_;
  if (i.lost) return std::unexpected(Errc::kUnplugged);
  if (report.size() > kReportMax) return std::unexpected(Errc::kInternal);
  const std::size_t lead = i.numbered ? 0 : 1;
  i.out[0] = 0;
  std::ranges::transform(report, i.out.begin() + static_cast<std::ptrdiff_t>(lead),
                         [](std::byte b) { return static_cast<unsigned char>(b); });
  errno = 0;
  const int written = hid_write(i.device, i.out.data(), report.size() + lead);
  if (written < 0) return i.fail(errno);
  return static_cast<std::size_t>(written) - std::min(lead, static_cast<std::size_t>(written));
}

Moved HidrawPipe::read(std::span<std::byte> into, Duration timeout) noexcept {
  Impl& i = *impl_;
  if (i.lost) return std::unexpected(Errc::kUnplugged);
  const auto whole = std::chrono::ceil<std::chrono::milliseconds>(std::max(timeout, Duration::zero())).count();
  constexpr std::int64_t kLongest = std::numeric_limits<int>::max();
  errno = 0;
  const int got = hid_read_timeout(i.device, reinterpret_cast<unsigned char*>(into.data()), into.size(),
                                   static_cast<int>(std::min<std::int64_t>(whole, kLongest)));
  if (got >= 0) return static_cast<std::size_t>(got);
  if (errno == EINTR) return std::size_t{0};  // interrupted by a signal; the caller retries
  return i.fail(errno);
}

}  // namespace tandem::hal
