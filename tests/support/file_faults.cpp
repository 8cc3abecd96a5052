#undef _FORTIFY_SOURCE  // its inline versions of these calls would bypass the replacements
#include "tests/support/file_faults.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <mutex>
#include <vector>

namespace tandem::test {
namespace {

using Kind = FileFault::Kind;
enum class Call { kOpen, kMake, kWrite, kSync, kRename, kOther };

std::mutex settings_lock;
FileFault fault;
std::string below;  // empty: nothing is counted
std::atomic<std::size_t> count{0};
std::atomic<bool> hit{false};
std::mutex names_lock;
std::vector<std::string> names;

/// Returns the absolute path of `name`; empty if it is not below the folder.
std::string path_of(int folder, const char* name) {
  std::string counted;
  {
    const std::lock_guard lock{settings_lock};
    counted = below;
  }
  if (counted.empty()) return {};
  std::string path;
  if (name == nullptr || *name != '/') {
    if (folder == AT_FDCWD) return {};
    std::array<char, 4096> link;
    const std::string of = "/proc/self/fd/" + std::to_string(folder);
    const long n = syscall(SYS_readlink, of.c_str(), link.data(), link.size());
    if (n <= 0) return {};
    path.assign(link.data(), static_cast<std::size_t>(n));
    if (name != nullptr) path += std::string("/") + name;
  } else {
    path = name;
  }
  return path.starts_with(counted) ? path : std::string();
}

FileFault injected() {
  const std::lock_guard lock{settings_lock};
  return fault;
}

enum class Verdict { kPass, kFail, kHalf, kKillBehind };

/// Counts a call and decides its outcome. Sets errno for kFail.
Verdict judge(const char* word, Call call, const std::string& path) {
  if (path.empty()) return Verdict::kPass;
  const std::size_t number = count++;
  const FileFault now = injected();
  if (now.kind == Kind::kNone) {
    const std::lock_guard lock{names_lock};
    names.resize(std::max(names.size(), number + 1));
    names[number] = std::string(word) + " " + path;
    return Verdict::kPass;
  }
  const bool behind_a_half = now.kind == Kind::kHalf && number == now.at + 1 && call == Call::kWrite;
  if (number < now.at || (number > now.at && !now.lasting && !behind_a_half)) return Verdict::kPass;
  const bool needs_space = call == Call::kMake || call == Call::kWrite || call == Call::kSync || call == Call::kRename;
  switch (now.kind) {
    case Kind::kKill:
      syscall(SYS_exit_group, kKilledByFault);
      break;
    case Kind::kKillHalfway:
      return call == Call::kWrite ? Verdict::kHalf : Verdict::kKillBehind;
    case Kind::kInputOutput:
      hit = true;
      errno = EIO;
      return Verdict::kFail;
    case Kind::kNoDescriptors:
      if (call != Call::kOpen && call != Call::kMake) return Verdict::kPass;
      hit = true;
      errno = EMFILE;
      return Verdict::kFail;
    case Kind::kNoSync:
      if (call != Call::kSync) return Verdict::kPass;
      hit = true;
      errno = EIO;
      return Verdict::kFail;
    case Kind::kHalf:
      if (call == Call::kWrite && number == now.at) return Verdict::kHalf;
      [[fallthrough]];
    case Kind::kNoSpace:
      if (!needs_space) return Verdict::kPass;
      hit = true;
      errno = ENOSPC;
      return Verdict::kFail;
    case Kind::kNoLocks:
    case Kind::kWritersLocks:
    case Kind::kNone:
      break;
  }
  return Verdict::kPass;
}

/// Decides the outcome of a lock. Sets errno if it fails.
bool lock_fails(int file) {
  if (path_of(file, nullptr).empty()) return false;
  const Kind kind = injected().kind;
  const bool reader = (::fcntl(file, F_GETFL) & O_ACCMODE) == O_RDONLY;
  if (kind != Kind::kNoLocks && (kind != Kind::kWritersLocks || !reader)) return false;
  hit = true;
  errno = kind == Kind::kNoLocks ? ENOLCK : EBADF;
  return true;
}

template <class Real>
long call(Verdict verdict, Real real) {
  if (verdict == Verdict::kFail) return -1;
  const long result = real();
  if (verdict == Verdict::kKillBehind) syscall(SYS_exit_group, kKilledByFault);
  return result;
}

/// Makes a write call under the fault. @param real  performs it with the given size
template <class Real>
long write_with(int file, std::size_t size, Real real) {
  const Verdict verdict = judge("write", Call::kWrite, path_of(file, nullptr));
  if (verdict != Verdict::kHalf) return call(verdict, [&] { return real(size); });
  const long written = real(size / 2);
  if (injected().kind == Kind::kKillHalfway) syscall(SYS_exit_group, kKilledByFault);
  hit = true;
  return written;
}

}  // namespace

void inject(const std::string& folder, const FileFault& what) {
  const std::lock_guard lock{settings_lock};
  below = folder;
  fault = what;
  count = 0;
  hit = false;
  names.clear();
}
std::size_t file_calls() noexcept { return count; }
bool fault_hit() noexcept { return hit; }
std::string file_call(std::size_t at) { return at < names.size() ? names[at] : std::string(); }
void no_faults() noexcept {
  const std::lock_guard lock{settings_lock};
  below.clear();
}

}  // namespace tandem::test

// Replacements of the C library's calls.

extern "C" {

using tandem::test::Call;
using tandem::test::call;
using tandem::test::judge;
using tandem::test::path_of;

ssize_t write(int file, const void* bytes, size_t size) {
  return tandem::test::write_with(file, size, [&](std::size_t n) { return syscall(SYS_write, file, bytes, n); });
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return tandem::test::write_with(file, size, [&](std::size_t n) { return syscall(SYS_pwrite64, file, bytes, n, at); });
}
// The files need not survive a power failure; a real sync would only cost time.
int fsync(int file) {
  return static_cast<int>(call(judge("fsync", Call::kSync, path_of(file, nullptr)), [] { return 0L; }));
}
int fdatasync(int file) {
  return static_cast<int>(call(judge("fdatasync", Call::kSync, path_of(file, nullptr)), [] { return 0L; }));
}
int ftruncate(int file, off_t size) {
  return static_cast<int>(call(judge("ftruncate", Call::kOther, path_of(file, nullptr)),
                               [&] { return syscall(SYS_ftruncate, file, size); }));
}
int flock(int file, int what) noexcept {
  return tandem::test::lock_fails(file) ? -1 : static_cast<int>(syscall(SYS_flock, file, what));
}
int openat(int folder, const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return static_cast<int>(call(judge("open", (flags & O_CREAT) != 0 ? Call::kMake : Call::kOpen, path_of(folder, name)),
                               [&] { return syscall(SYS_openat, folder, name, flags, mode); }));
}
int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return static_cast<int>(
      call(judge("open", (flags & O_CREAT) != 0 ? Call::kMake : Call::kOpen, path_of(AT_FDCWD, name)),
           [&] { return syscall(SYS_openat, AT_FDCWD, name, flags, mode); }));
}
int renameat(int from, const char* old_name, int to, const char* new_name) noexcept {
  return static_cast<int>(call(judge("rename", Call::kRename, path_of(from, old_name)),
                               [&] { return syscall(SYS_renameat, from, old_name, to, new_name); }));
}
int rename(const char* old_name, const char* new_name) noexcept {
  return renameat(AT_FDCWD, old_name, AT_FDCWD, new_name);
}
int unlinkat(int folder, const char* name, int flags) noexcept {
  return static_cast<int>(call(judge("unlink", Call::kOther, path_of(folder, name)),
                               [&] { return syscall(SYS_unlinkat, folder, name, flags); }));
}
}  // extern "C"
