#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <thread>

#include "common/auth/io/state_directory.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/clock.h"

/// Locks of a state directory: one process at a time may change it, and every wait is bounded.
namespace tandem::auth {
namespace {

constexpr mode_t kLockFileMode = 0600;
constexpr auto kLookEvery = std::chrono::milliseconds(10);

}  // namespace

bool StateDirectory::wait_for(int fd, std::chrono::milliseconds patience) noexcept {
  const Time end = io::monotonic_now() + patience;
  while (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    if ((errno != EWOULDBLOCK && errno != EINTR) || io::monotonic_now() >= end) return false;
    std::this_thread::sleep_for(kLookEvery);
  }
  return true;
}

std::expected<StateDirectory::Lock, std::string> StateDirectory::lock(const std::string& name,
                                                                      std::chrono::milliseconds patience) const {
  Lock file{openat(folder_.get(), name.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kLockFileMode)};
  if (!file.open()) return std::unexpected(trouble(name, "opened"));
  if (wait_for(file.get(), patience)) return file;
  if (errno != EWOULDBLOCK && errno != EINTR) return std::unexpected(trouble(name, "locked"));
  return std::unexpected(
      format("%s was not free within %g s: %s holds it; wait until that has finished, or end it, then try again",
             path_of(name).c_str(), 1e-3 * static_cast<double>(patience.count()), holder_of(name).c_str()));
}

std::expected<std::optional<StateDirectory::Lock>, std::string> StateDirectory::try_lock(
    const std::string& name) const {
  Lock file{openat(folder_.get(), name.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kLockFileMode)};
  if (!file.open()) return std::unexpected(trouble(name, "opened"));
  if (flock(file.get(), LOCK_EX | LOCK_NB) == 0) return file;
  if (errno == EWOULDBLOCK) return std::nullopt;
  return std::unexpected(trouble(name, "locked"));
}

/// Parses /proc/locks [proc(5)]: `NUMBER: FLOCK ADVISORY WRITE PID MAJOR:MINOR:INODE 0 EOF`; waiting processes have
/// `->` before the kind. The device is not compared, because layered file systems report another one there than to
/// stat.
std::string StateDirectory::holder_of(const std::string& name) const {
  std::string unknown = "another process";
  struct stat s{};
  if (fstatat(folder_.get(), name.c_str(), &s, AT_SYMLINK_NOFOLLOW) != 0) return unknown;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advice, access, pid, file;
    if (!(words >> number >> kind >> advice >> access >> pid >> file) || kind != "FLOCK" ||
        !file.ends_with(":" + std::to_string(s.st_ino)))
      continue;
    if (pid == "0" || pid.starts_with('-')) return unknown;  // of another namespace
    std::string program;
    std::getline(std::ifstream("/proc/" + pid + "/comm"), program);
    return "process " + pid + (program.empty() ? "" : " (" + sanitize(program) + ")");
  }
  return unknown;
}

}  // namespace tandem::auth
