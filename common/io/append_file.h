#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <expected>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/io/fd.h"

namespace tandem::io {

/// Limits of an AppendFile.
struct AppendFileOptions {
  std::size_t backlog_max = std::size_t{16} << 20U;  ///< [bytes] that wait for the disk; beyond, `accepts` is false
  std::size_t reserve = std::size_t{2} << 20U;       ///< [bytes] that the disk keeps free for the end of the file
  std::chrono::milliseconds sync{500};               ///< between two fdatasync
};

/// New file that grows only at its end, written by a thread of its own. The caller never waits for the disk: bytes go
/// to a bounded backlog. A write that fails is repeated every 100 ms from the same byte, so the file continues without
/// a gap as soon as the disk accepts it. The thread holds a lock on the file (flock), by which repairs see that it is
/// in use. Until `close` succeeds the file has the name PATH.part.
class AppendFile {
 public:
  /// Creates PATH.part, mode 0640 without the bits of the umask. @return error: PATH or PATH.part exists, or the
  /// system's reason
  [[nodiscard]] static std::expected<std::unique_ptr<AppendFile>, std::string> create(
      const std::string& path, const AppendFileOptions& options = {});
  /// Ends the thread; bytes that the disk did not accept yet are lost. PATH.part stays if `close` did not succeed,
  /// unless it has no byte.
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// Appends to the backlog, in any case: the end of a file must follow whatever preceded it.
  void append(std::string bytes);
  /// False while the disk has no space for more than the end of the file, reports errors, or is too far behind.
  [[nodiscard]] bool accepts() const;

  struct State {
    std::uint64_t written = 0;       ///< [bytes] that the system accepted
    std::uint64_t backlog = 0;       ///< [bytes] that wait
    int error = 0;                   ///< errno of the last write, if it failed; 0: the disk accepts
    std::uint64_t failures = 0;      ///< failed attempts to write or to reserve space, so far
    std::uint64_t unsynced = 0;      ///< failed fdatasync so far: bytes may be missing after a power cut
    std::chrono::nanoseconds cpu{};  ///< processor time of the thread
    bool closed = false;             ///< the file has its name, or `close_error`
    std::string close_error{};       ///< why the complete file did not get its name
  };
  [[nodiscard]] State state() const;

  /// Lets the thread finish the file: all bytes on the disk, then its name. `state` says when. No `append` follows.
  void begin_close();
  /// As `begin_close`, and waits for it, at most `limit`.
  /// @return the error: PATH.part has what was written, and is removed if that is nothing; empty: the file is complete
  [[nodiscard]] std::string close(std::chrono::milliseconds limit);
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Name while the file grows.
  [[nodiscard]] std::string part() const { return path_ + ".part"; }

 private:
  AppendFile(std::string path, const AppendFileOptions& options, Fd file);
  void run();
  /// Writes what waits. @return errno of the failure; 0: all is written
  int write_waiting(std::unique_lock<std::mutex>& lock);
  int reserve_space();
  void sync(std::unique_lock<std::mutex>& lock);
  /// Gives the file its name. @return the error
  [[nodiscard]] std::string name_file(std::uint64_t size) const;

  std::string path_;
  AppendFileOptions options_;
  Fd file_;
  mutable std::mutex lock_;
  std::condition_variable wake_, done_;
  std::deque<std::string> waiting_;
  State state_;
  std::uint64_t reserved_ = 0;  ///< end of the reserved space [bytes]
  bool dirty_ = false;          ///< written since the last fdatasync
  bool closing_ = false;        ///< no reserve is needed any more
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tandem::io
