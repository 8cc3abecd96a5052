#include "hal/io/deadman.h"

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

#include "hal/io/servo_pace.h"

namespace tandem::hal {
namespace {

constexpr int kRounds = 100;           // a millisecond apart
constexpr unsigned kUsbPatience = 20;  // [ms]
constexpr std::size_t kDevicesMax = 8;
constexpr rlim_t kFilesMax = 1U << 20;  // the kernel's own limit of descriptors, unless it was raised
constexpr int kPriority = 61;
constexpr int kFarewell = 500;         // [ms]

struct Will {
  std::array<LastWords, kDevicesMax> devices{};
  std::size_t count = 0;
};

// From here on only what is allowed after fork in a program with threads: system calls.

void say(LastWords& words) noexcept {
  if (words.usb_endpoint == 0) {
    [[maybe_unused]] const auto written = ::write(words.fd, words.frame.data(), words.size);
    return;
  }
  usbdevfs_bulktransfer transfer{words.usb_endpoint, static_cast<unsigned>(words.size), kUsbPatience, words.frame.data()};
  ::ioctl(words.fd, USBDEVFS_BULK, &transfer);
}

/// Closes the descriptors from `first` to `last`, both included.
void close_between(unsigned first, unsigned last) noexcept {
  if (first > last || ::close_range(first, last, 0) == 0) return;
  // Kernels before 5.9, and system call filters older than the call: one by one, up to the limit of descriptors.
  rlimit files{kFilesMax, kFilesMax};
  ::getrlimit(RLIMIT_NOFILE, &files);
  const auto end = static_cast<unsigned>(std::min<rlim_t>(files.rlim_max, kFilesMax));
  for (unsigned fd = first; fd <= std::min(last, end); ++fd) ::close(static_cast<int>(fd));
}

/// Closes every descriptor except the line to the program and the devices.
void close_all_but(const Will& will, int line) noexcept {
  std::array<int, kDevicesMax + 1> kept{};
  std::size_t count = 0;
  kept[count++] = line;
  for (std::size_t i = 0; i < will.count; ++i) kept[count++] = will.devices[i].fd;
  std::sort(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count));
  unsigned next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept[i] < 0) continue;  // a device that has no file
    const auto fd = static_cast<unsigned>(kept[i]);
    if (fd > next) close_between(next, fd - 1);
    next = fd + 1;
  }
  close_between(next, std::numeric_limits<unsigned>::max());
}

void say_all(Will& will) noexcept {
  for (std::size_t i = 0; i < will.count; ++i) say(will.devices[i]);
}

/// Ends with the program. @return whether it said goodbye
bool watch_over(Will& will, int line, const Pulse& pulse) noexcept {
  std::uint32_t seen = Pulse::kAtRest;
  int rounds_left = kRounds;
  Time moved_at = MonotonicClock{}.now();
  while (true) {
    pollfd file{line, POLLIN, 0};
    const bool late = MonotonicClock{}.now() - moved_at >= Deadman::kPatience;
    const int ready = ::poll(&file, 1, late && rounds_left > 0 ? 1 : static_cast<int>(Deadman::kLook.count()));
    if (ready > 0) {
      char goodbye = 0;
      const ssize_t got = ::read(line, &goodbye, 1);
      if (got >= 0 || errno != EINTR) return got == 1;
    }
    const std::uint32_t beats = pulse.beats();
    if (beats == Pulse::kAtRest || beats != seen) {
      seen = beats;
      rounds_left = kRounds;
      moved_at = MonotonicClock{}.now();
    } else if (rounds_left > 0 && MonotonicClock{}.now() - moved_at >= Deadman::kPatience) {
      --rounds_left;
      say_all(will);
    }
  }
}

[[noreturn]] void keep_watch(Will& will, int line, const Pulse& pulse) noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  ::setsid();  // what is done to the program's group or terminal is not done to this process
  ::prctl(PR_SET_NAME, "tandem-deadman");
  const sched_param priority{kPriority};
  ::sched_setscheduler(0, SCHED_FIFO, &priority);  // above the servo; where the system refuses, as everybody
  close_all_but(will, line);
  if (!watch_over(will, line, pulse)) {
    for (int round = 0; round < kRounds; ++round) {
      say_all(will);
      const timespec pause{0, 1'000'000};
      ::nanosleep(&pause, nullptr);
    }
  }
  ::_exit(0);
}

}  // namespace

Result<std::unique_ptr<Deadman>> Deadman::watch(std::span<const LastWords> devices) {
  Will will;
  for (const LastWords& words : devices) {
    if (will.count < kDevicesMax) will.devices[will.count++] = words;
  }
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return std::unexpected(DeviceError{Errc::kInternal, std::string("no line to the deadman: ") + std::strerror(errno)});
  }
  void* const shared = ::mmap(nullptr, sizeof(Pulse), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) {
    for (const int end : ends) ::close(end);
    return std::unexpected(DeviceError{Errc::kInternal, std::string("no memory to share with the deadman: ") + std::strerror(errno)});
  }
  Pulse* const pulse = new (shared) Pulse;
  // A Ctrl-C just now must not meet a child that does not ignore it yet.
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) keep_watch(will, ends[0], *pulse);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[0]);
  if (child < 0) {
    ::close(ends[1]);
    ::munmap(shared, sizeof(Pulse));
    return std::unexpected(DeviceError{Errc::kInternal, std::string("no process for the deadman: ") + std::strerror(errno)});
  }
  return std::unique_ptr<Deadman>(new Deadman(ends[1], child, pulse));
}

Deadman::~Deadman() {
  [[maybe_unused]] const auto sent = ::send(line_, "b", 1, MSG_NOSIGNAL);  // somebody may have ended it
  ::close(line_);
  int status = 0;
  for (int looks = 0; child_ > 0 && ::waitpid(child_, &status, WNOHANG) == 0; ++looks) {
    if (looks == kFarewell) ::kill(child_, SIGKILL);  // stuck in a transfer; the devices were silenced without it
    const timespec pause{0, 1'000'000};
    ::nanosleep(&pause, nullptr);
  }
  ::munmap(pulse_, sizeof(Pulse));
}

bool Deadman::alive() noexcept {
  int status = 0;
  if (child_ > 0 && ::waitpid(child_, &status, WNOHANG) == child_) child_ = 0;
  return child_ > 0;
}

std::optional<int> open_file_of(const std::string& node) {
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
