#include "hal/io/watchdog_process.h"

#include <dirent.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <new>

#include "hal/io/periodic_timer.h"

namespace tandem::hal {
namespace {

constexpr int kRounds = 100;          // one per millisecond
constexpr unsigned kUsbTimeout = 20;  // [ms]
constexpr std::size_t kDevicesMax = 8;
constexpr rlim_t kFilesMax = 1U << 20;  // the kernel's default limit of descriptors
constexpr int kWatchdogPriority = 61;
constexpr int kShutdownPolls = 500;  // [ms]

struct WatchedDevices {
  std::array<ShutdownFrame, kDevicesMax> devices{};
  std::size_t count = 0;
};

// In the forked child of a threaded program only system calls are allowed, so the functions below use nothing else.

void send_frame(ShutdownFrame& words) noexcept {
  if (words.usb_endpoint == 0) {
    [[maybe_unused]] const auto written = ::write(words.fd, words.frame.data(), words.size);
    return;
  }
  usbdevfs_bulktransfer transfer{words.usb_endpoint, static_cast<unsigned>(words.size), kUsbTimeout,
                                 words.frame.data()};
  ::ioctl(words.fd, USBDEVFS_BULK, &transfer);
}

/// Closes the descriptors from `first` to `last`, both inclusive.
void close_between(unsigned first, unsigned last) noexcept {
  if (first > last || ::close_range(first, last, 0) == 0) return;
  // Kernels before 5.9 and older system call filters lack close_range: close one by one, up to the limit of
  // descriptors.
  rlimit files{kFilesMax, kFilesMax};
  ::getrlimit(RLIMIT_NOFILE, &files);
  const auto end = static_cast<unsigned>(std::min<rlim_t>(files.rlim_max, kFilesMax));
  for (unsigned fd = first; fd <= std::min(last, end); ++fd) ::close(static_cast<int>(fd));
}

/// Closes every descriptor except the socket to the client process and the devices.
void close_all_but(const WatchedDevices& watched, int line) noexcept {
  std::array<int, kDevicesMax + 1> kept{};
  std::size_t count = 0;
  kept[count++] = line;
  for (std::size_t i = 0; i < watched.count; ++i) kept[count++] = watched.devices[i].fd;
  std::sort(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count));
  unsigned next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept[i] < 0) continue;  // a device without a file
    const auto fd = static_cast<unsigned>(kept[i]);
    if (fd > next) close_between(next, fd - 1);
    next = fd + 1;
  }
  close_between(next, std::numeric_limits<unsigned>::max());
}

void send_all(WatchedDevices& watched) noexcept {
  for (std::size_t i = 0; i < watched.count; ++i) send_frame(watched.devices[i]);
}

/// Monitors the client process until it ends. @return whether it ended with a clean shutdown
bool supervise(WatchedDevices& watched, int line, const Heartbeat& pulse) noexcept {
  std::uint32_t seen = Heartbeat::kIdle;
  int rounds_left = kRounds;
  Time moved_at = MonotonicClock{}.now();
  while (true) {
    pollfd file{line, POLLIN, 0};
    const bool late = MonotonicClock{}.now() - moved_at >= WatchdogProcess::kTimeout;
    const int ready =
        ::poll(&file, 1, late && rounds_left > 0 ? 1 : static_cast<int>(WatchdogProcess::kPollInterval.count()));
    if (ready > 0) {
      char shutdown = 0;
      const ssize_t got = ::read(line, &shutdown, 1);
      if (got >= 0 || errno != EINTR) return got == 1;
    }
    const std::uint32_t beats = pulse.beats();
    if (beats == Heartbeat::kIdle || beats != seen) {
      seen = beats;
      rounds_left = kRounds;
      moved_at = MonotonicClock{}.now();
    } else if (rounds_left > 0 && MonotonicClock{}.now() - moved_at >= WatchdogProcess::kTimeout) {
      --rounds_left;
      send_all(watched);
    }
  }
}

[[noreturn]] void run_watchdog(WatchedDevices& watched, int line, const Heartbeat& pulse) noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  ::setsid();  // own session: signals to the client's process group or terminal do not reach this process
  ::prctl(PR_SET_NAME, "tandem-watchdog");
  const sched_param priority{kWatchdogPriority};
  ::sched_setscheduler(0, SCHED_FIFO,
                       &priority);  // priority above the servo; if the system refuses, the default priority remains
  close_all_but(watched, line);
  if (!supervise(watched, line, pulse)) {
    for (int round = 0; round < kRounds; ++round) {
      send_all(watched);
      const timespec pause{0, 1'000'000};
      ::nanosleep(&pause, nullptr);
    }
  }
  ::_exit(0);
}

}  // namespace

Result<std::unique_ptr<WatchdogProcess>> WatchdogProcess::start(std::span<const ShutdownFrame> devices) {
  WatchedDevices watched;
  for (const ShutdownFrame& words : devices) {
    if (watched.count < kDevicesMax) watched.devices[watched.count++] = words;
  }
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return std::unexpected(
        DeviceError{Errc::kInternal, std::string("no socket to the watchdog process: ") + std::strerror(errno)});
  }
  void* const shared = ::mmap(nullptr, sizeof(Heartbeat), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) {
    for (const int end : ends) ::close(end);
    return std::unexpected(DeviceError{
        Errc::kInternal, std::string("no memory to share with the watchdog process: ") + std::strerror(errno)});
  }
  Heartbeat* const pulse = new (shared) Heartbeat;
  // All signals are blocked during fork: a Ctrl-C must not reach the child before it ignores SIGINT.
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) run_watchdog(watched, ends[0], *pulse);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[0]);
  if (child < 0) {
    ::close(ends[1]);
    ::munmap(shared, sizeof(Heartbeat));
    return std::unexpected(
        DeviceError{Errc::kInternal, std::string("cannot start the watchdog process: ") + std::strerror(errno)});
  }
  return std::unique_ptr<WatchdogProcess>(new WatchdogProcess(ends[1], child, pulse));
}

WatchdogProcess::~WatchdogProcess() {
  [[maybe_unused]] const auto sent =
      ::send(line_, "b", 1, MSG_NOSIGNAL);  // the watchdog may have been ended from outside
  ::close(line_);
  int status = 0;
  for (int looks = 0; child_ > 0 && ::waitpid(child_, &status, WNOHANG) == 0; ++looks) {
    if (looks == kShutdownPolls)
      ::kill(child_, SIGKILL);  // blocked in a transfer; the devices have received zeros from this process
    const timespec pause{0, 1'000'000};
    ::nanosleep(&pause, nullptr);
  }
  ::munmap(heartbeat_, sizeof(Heartbeat));
}

bool WatchdogProcess::alive() noexcept {
  int status = 0;
  if (child_ > 0 && ::waitpid(child_, &status, WNOHANG) == child_) child_ = 0;
  return child_ > 0;
}

std::optional<int> find_open_file(const std::string& node) {
  DIR* const files = ::opendir("/proc/self/fd");
  if (files == nullptr) return std::nullopt;
  std::optional<int> found;
  while (const dirent* entry = ::readdir(files)) {
    std::array<char, PATH_MAX> target{};
    const ssize_t size = ::readlinkat(::dirfd(files), entry->d_name, target.data(), target.size() - 1);
    if (size > 0 && node == target.data()) found = std::atoi(entry->d_name);
  }
  ::closedir(files);
  return found;
}

}  // namespace tandem::hal
