#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/auth/io/state_directory.h"

namespace tandem::auth {

/// Retention of the audit log: `audit.log`, and the rotated files `audit.log.1` (newest) to `audit.log.OLDER`.
struct AuditLimits {
  std::uint64_t file_max = 8U << 20;  ///< [bytes] size of a file above which the next line begins a new one
  std::uint32_t older = 7;            ///< rotated files kept, at least 1
};

/// The audit log of a state directory: one JSON object per line with `ts` [s], `event`, `name` and optionally `detail`.
/// Each line is on disk when `write` returns. Texts are sanitised as for a screen (common/base/sanitize.h). A line that
/// cannot be written is counted. The next successful write is preceded by `audit_lost` with the count, so every gap is
/// recorded. Several processes may append. One thread at a time.
class AuditLog {
 public:
  static constexpr const char* kFile = "audit.log";
  static constexpr std::size_t kTextMax = 1024;  ///< [bytes] of a name or detail; the rest is cut

  /// Makes `write` rotate from now on. For one process per directory, the server's.
  void enable_rotation(const AuditLimits& limits) noexcept { limits_ = limits; }

  /// @return the error, empty if the line is on disk
  std::string write(const StateDirectory& folder, std::int64_t now, std::string_view event, std::string_view name,
                    std::string_view detail);
  /// Tries to record the number of lost lines after a failure. @return the remaining error
  std::string retry(const StateDirectory& folder, std::int64_t now);

  /// Returns why lines cannot be written or the file cannot be rotated; empty: no error.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Returns the number of lines lost since this process began.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  std::string put(const StateDirectory& folder, std::int64_t now, const std::string& line);

  std::optional<AuditLimits> limits_;
  std::string error_;
  std::uint64_t lost_ = 0, owed_ = 0;  ///< lost lines; those that the log does not report yet
  std::int64_t lost_since_ = 0;        ///< [s] time of the first unreported line
};

}  // namespace tandem::auth
