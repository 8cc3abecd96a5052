#pragma once

#include <cstddef>
#include <string>

/// Injects disk faults below the C library's file calls of the program that links this. It counts the calls that touch
/// files below one folder: open, write, pwrite, fsync, fdatasync, rename, ftruncate, unlink. The interception covers
/// all code of the program, so no call site is missed. Locks (flock) are not counted.
namespace tandem::test {

struct FileFault {
  enum class Kind {
    kNone,           ///< counts only
    kNoSpace,        ///< ENOSPC from write, fsync, rename, and from an open that creates a file
    kInputOutput,    ///< EIO from every call
    kNoDescriptors,  ///< EMFILE from open
    kNoSync,         ///< EIO from fsync and fdatasync
    kNoLocks,        ///< ENOLCK from every flock
    kWritersLocks,   ///< EBADF from every flock of a descriptor that cannot write, as on NFSv4
    kHalf,           ///< half of a write reaches the file, the next write gives ENOSPC; other calls: as kNoSpace
    kKill,           ///< the process ends before the call
    kKillHalfway,    ///< half of a write reaches the file, then the process ends; other calls: it ends after them
  };
  Kind kind = Kind::kNone;
  std::size_t at = 0;    ///< number of the call, from 0
  bool lasting = false;  ///< this call and all later ones; otherwise this one only
};
/// Exit code of a process that a fault killed.
inline constexpr int kKilledByFault = 77;

/// Injects `fault` from now on and restarts the count at 0. @param folder  absolute path
void inject(const std::string& folder, const FileFault& fault);
/// Number of calls since `inject`.
[[nodiscard]] std::size_t file_calls() noexcept;
/// Returns whether the fault hit a call.
[[nodiscard]] bool fault_hit() noexcept;
/// Returns call number `at` as text, such as `write /folder/name`; only in the counting process.
[[nodiscard]] std::string file_call(std::size_t at);
/// Ends the injection; the counts stay.
void no_faults() noexcept;

}  // namespace tandem::test
