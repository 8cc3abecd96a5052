#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "common/auth/io/state_directory.h"

namespace tandem::auth {

/// Retention of the audit log: `audit.log`, and the rotated files `audit.log.1` (newest) to `audit.log.OLDER`.
struct AuditLimits {
  std::uint64_t file_max = 8U << 20;  ///< [bytes] size of a file above which the next line begins a new one
  std::uint32_t older = 7;            ///< rotated files kept, at least 1
};

/// The audit log of a state directory: one JSON object per line with `ts` [s], `event`, `name` and optionally `detail`.
/// Texts are sanitised as for a screen (common/base/sanitize.h). A line that cannot be written is counted. The next
/// successful write is preceded by `audit_lost` with the count, so every gap is recorded. Several processes may append.
/// One thread at a time calls `write` and `retry`.
class AuditLog {
 public:
  static constexpr const char* kFile = "audit.log";
  static constexpr std::size_t kTextMax = 1024;    ///< [bytes] of a name or detail; the rest is cut
  static constexpr std::size_t kQueuedMax = 4096;  ///< lines that wait for the disk; one more counts as lost

  AuditLog() = default;  // the end appends the lines that wait
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;

  /// Makes `write` rotate from now on. For one process per directory, the server's.
  void enable_rotation(const AuditLimits& limits) noexcept { limits_ = limits; }
  /// Starts a thread that appends the lines from now on, so that `write` never waits for the disk. For a server, whose
  /// thread for consoles must take an order to stop while the disk is busy. Call it after `enable_rotation`.
  void write_behind(std::shared_ptr<const StateDirectory> folder);

  /// The line is on disk when this returns, or soon after with `write_behind`.
  /// @return the error; empty if the line is on disk or waits
  std::string write(const StateDirectory& folder, std::int64_t now, std::string_view event, std::string_view name,
                    std::string_view detail);
  /// Tries to record the number of lost lines after a failure. @return the remaining error
  std::string retry(const StateDirectory& folder, std::int64_t now);

  /// Returns why lines cannot be written or the file cannot be rotated; empty: no error. Any thread.
  [[nodiscard]] std::string error() const;
  /// Returns the number of lines lost since this process began. Any thread.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  struct Lines {
    std::int64_t now;
    std::string text;  ///< empty: only the number of lost lines is to be written
    std::uint64_t count;
  };
  void append_queued(const StateDirectory& folder, const std::stop_token& stop);
  std::string append(const StateDirectory& folder, const Lines& lines);
  std::string put(const StateDirectory& folder, const Lines& lines);
  void count_lost(std::int64_t now, std::uint64_t count);

  std::optional<AuditLimits> limits_;
  mutable std::mutex mutex_;  ///< guards what follows; never held while the file is written
  std::condition_variable_any queued_;
  std::deque<Lines> queue_;
  std::string error_;
  std::uint64_t lost_ = 0, owed_ = 0;  ///< lost lines; those that the log does not report yet
  std::int64_t lost_since_ = 0;        ///< [s] time of the first unreported line
  std::jthread behind_;                ///< last: it uses the others
};

}  // namespace tandem::auth
