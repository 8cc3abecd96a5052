#include "hal/io/deadman.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace tandem::hal {
namespace {

constexpr int kRounds = 100;           // a millisecond apart
constexpr unsigned kUsbPatience = 20;  // [ms]
constexpr std::size_t kDevicesMax = 8;

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

void close_all_but(const Will& will, int line) noexcept {
  for (int fd = 0; fd < 1024; ++fd) {
    bool keep = fd == line;
    for (std::size_t i = 0; i < will.count; ++i) keep = keep || fd == will.devices[i].fd;
    if (!keep) ::close(fd);
  }
}

[[noreturn]] void keep_watch(Will& will, int line) noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  ::prctl(PR_SET_NAME, "tandem-deadman");
  close_all_but(will, line);
  char goodbye = 0;
  ssize_t got = 0;
  do {
    got = ::read(line, &goodbye, 1);
  } while (got < 0 && errno == EINTR);
  if (got != 1) {
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < will.count; ++i) say(will.devices[i]);
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
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return std::unexpected(DeviceError{Errc::kInternal, std::string("no pipe for the deadman: ") + std::strerror(errno)});
  }
  // A Ctrl-C just now must not meet a child that does not ignore it yet.
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) keep_watch(will, ends[0]);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[0]);
  if (child < 0) {
    ::close(ends[1]);
    return std::unexpected(DeviceError{Errc::kInternal, std::string("no process for the deadman: ") + std::strerror(errno)});
  }
  return std::unique_ptr<Deadman>(new Deadman(ends[1], child));
}

Deadman::~Deadman() {
  [[maybe_unused]] const auto written = ::write(line_, "b", 1);
  ::close(line_);
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
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
