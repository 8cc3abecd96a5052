#pragma once

#include <cstddef>
#include <string>

/// Faults of a disk, injected below the C library's file calls of the program that links this. Counted are the calls that touch files
/// below one folder: open, write, pwrite, fsync, fdatasync, rename, ftruncate, unlink. Whatever code makes them, none can be forgotten.
namespace tandem::test {

struct FileFault {
  enum class Kind {
    kNone,           ///< only counts
    kNoSpace,        ///< ENOSPC of write, fsync, rename, and open of a file that is made
    kInputOutput,    ///< EIO of every call
    kNoDescriptors,  ///< EMFILE of open
    kHalf,           ///< half of a write reaches the file, the next write is ENOSPC; other calls: as kNoSpace
    kKill,           ///< the process ends before the call
    kKillHalfway,    ///< half of a write reaches the file, then the process ends; other calls: it ends behind them
  };
  Kind kind = Kind::kNone;
  std::size_t at = 0;    ///< number of the call, from 0
  bool lasting = false;  ///< this call and all behind it; else this one only
};
/// Exit code of a process that a fault killed.
inline constexpr int kKilledByFault = 77;

/// From now on, with numbers from 0. @param folder  absolute
void inject(const std::string& folder, const FileFault& fault);
/// Calls counted since `inject`.
[[nodiscard]] std::size_t file_calls() noexcept;
/// Whether the fault hit a call.
[[nodiscard]] bool fault_hit() noexcept;
/// What call number `at` was, such as `write /folder/name`; from the counting process only.
[[nodiscard]] std::string file_call(std::size_t at);
/// No more faults; counts stay.
void no_faults() noexcept;

}  // namespace tandem::test
