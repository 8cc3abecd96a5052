// A disk that a test makes slow or full while a program runs: a library for LD_PRELOAD. It reads one word from the file
// that TANDEM_SLOW_DISK names before each write and sync of a recording: ok, slow or full. With the word inputs it is
// full for files without a name, in which a server keeps inputs, and for no other. With the word nospace it is full for
// checkpoints, and with the word stuck each of their syncs takes seconds; no other word concerns them. With the word
// lists each sync of the list of workstations takes seconds.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

constexpr useconds_t kSlow = 1'500'000, kStuck = 4'000'000;  // [us] of each call

enum class File { kOther, kRecording, kInputs, kCheckpoint, kLists };

File kind_of(int file) {
  char link[4096];
  const std::string of = "/proc/self/fd/" + std::to_string(file);
  const long n = syscall(SYS_readlink, of.c_str(), link, sizeof link);
  const std::string_view name(link, n > 0 ? static_cast<std::size_t>(n) : 0);
  return name.ends_with(".mcap.part")                     ? File::kRecording
         : name.ends_with("(deleted)")                    ? File::kInputs
         : name.ends_with(".checkpoint.new")              ? File::kCheckpoint
         : name.ends_with("/.workstations.textproto.new") ? File::kLists
                                                          : File::kOther;
}

/// @return whether the call succeeds
bool pass(int file) {
  const char* const control = std::getenv("TANDEM_SLOW_DISK");
  const File kind = control == nullptr ? File::kOther : kind_of(file);
  if (kind == File::kOther) return true;
  char word[8]{};
  const int in = static_cast<int>(syscall(SYS_openat, AT_FDCWD, control, O_RDONLY));
  if (in >= 0) {
    [[maybe_unused]] const long n = syscall(SYS_read, in, word, sizeof word - 1);
    syscall(SYS_close, in);
  }
  constexpr const char* kFull[] = {"", "full", "inputs", "nospace", ""};
  if (*kFull[static_cast<int>(kind)] != 0 && std::strncmp(word, kFull[static_cast<int>(kind)], 4) == 0) {
    errno = ENOSPC;
    return false;
  }
  if (kind == File::kRecording && std::strncmp(word, "slow", 4) == 0) usleep(kSlow);
  if (kind == File::kLists && std::strncmp(word, "lists", 5) == 0) usleep(kStuck);
  if (kind == File::kCheckpoint && std::strncmp(word, "stuck", 4) == 0) usleep(kStuck);
  return true;
}

}  // namespace

extern "C" {
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return pass(file) ? syscall(SYS_pwrite64, file, bytes, size, at) : -1;
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off_t at) { return pwrite(file, bytes, size, at); }
int fsync(int file) { return pass(file) ? static_cast<int>(syscall(SYS_fsync, file)) : -1; }
int fdatasync(int file) { return pass(file) ? static_cast<int>(syscall(SYS_fdatasync, file)) : -1; }
}
