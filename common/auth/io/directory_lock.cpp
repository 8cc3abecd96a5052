#include "common/auth/io/directory_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <thread>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/clock.h"

namespace tandem::auth {
namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(10);

/// Opens the file of a lock.
std::expected<io::Fd, std::string> open_lock(const StateDirectory& folder, const std::string& name) {
  io::Fd file{openat(folder.fd(), name.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, StateDirectory::kFileMode)};
  if (!file.open()) return std::unexpected(folder.call_error(name, "opened"));
  return file;
}

}  // namespace

bool DirectoryLock::wait_for(int fd, std::chrono::milliseconds timeout) noexcept {
  const Time end = io::monotonic_now() + timeout;
  while (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    if ((errno != EWOULDBLOCK && errno != EINTR) || io::monotonic_now() >= end) return false;
    std::this_thread::sleep_for(kLookEvery);
  }
  return true;
}

std::expected<DirectoryLock, std::string> DirectoryLock::wait(const StateDirectory& folder, const std::string& name,
                                                              std::chrono::milliseconds timeout) {
  auto file = open_lock(folder, name);
  if (!file) return std::unexpected(std::move(file.error()));
  if (wait_for(file->get(), timeout)) return DirectoryLock(std::move(*file));
  if (errno != EWOULDBLOCK && errno != EINTR) return std::unexpected(folder.call_error(name, "locked"));
  return std::unexpected(format(
      "%s was not free within %g s: %s holds it; wait until that has finished, or end it, "
      "then try again",
      folder.path_of(name).c_str(), 1e-3 * static_cast<double>(timeout.count()), holder_of(folder, name).c_str()));
}

std::expected<std::optional<DirectoryLock>, std::string> DirectoryLock::attempt(const StateDirectory& folder,
                                                                                const std::string& name) {
  auto file = open_lock(folder, name);
  if (!file) return std::unexpected(std::move(file.error()));
  if (flock(file->get(), LOCK_EX | LOCK_NB) == 0) return DirectoryLock(std::move(*file));
  if (errno == EWOULDBLOCK) return std::nullopt;
  return std::unexpected(folder.call_error(name, "locked"));
}

/// Parses /proc/locks [proc(5)]: `NUMBER: FLOCK ADVISORY WRITE PID MAJOR:MINOR:INODE 0 EOF`; waiting processes have
/// `->` before the kind. The device is not compared, because layered file systems report another one there than to
/// stat.
std::string DirectoryLock::holder_of(const StateDirectory& folder, const std::string& name) {
  std::string unknown = "another process";
  struct stat s{};
  if (fstatat(folder.fd(), name.c_str(), &s, AT_SYMLINK_NOFOLLOW) != 0) return unknown;
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
