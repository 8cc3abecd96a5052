#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/trust/io/state_folder.h"

namespace tandem::trust {

/// How much of the audit log is kept: `audit.log`, and beside it `audit.log.1` (newest) to `audit.log.OLDER`.
struct AuditLimits {
  std::uint64_t file_max = 8U << 20;  ///< [bytes] of a file, above which the next line begins a new one
  std::uint32_t older = 7;            ///< files kept beside it, at least 1
};

/// The audit log of a state folder: one JSON object per line with `ts` [s], `event`, `name` and, if there is one, `detail`. Each line is on
/// disk when `write` returns. Texts pass the same filter as on a screen (common/base/printable.h). A line that cannot be written is counted,
/// and the next one that can be is preceded by `audit_lost` with their number: a gap is never silent. Several processes may append.
/// One thread at a time.
class AuditLog {
 public:
  static constexpr const char* kFile = "audit.log";
  static constexpr std::size_t kTextMax = 1024;  ///< [bytes] of a name or detail; what is longer is cut

  /// From now on `write` rotates. For one process per folder, the server's.
  void keep(const AuditLimits& limits) noexcept { limits_ = limits; }

  /// @return what is wrong, empty if the line is on disk
  std::string write(const StateFolder& folder, std::int64_t now, std::string_view event, std::string_view name, std::string_view detail);
  /// After a failure: tries to write down how many lines were lost. @return what is wrong still
  std::string retry(const StateFolder& folder, std::int64_t now);

  /// Why lines cannot be written, or the file not be rotated; empty: all is well.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  /// Lines lost since this process began.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  std::string put(const StateFolder& folder, std::int64_t now, const std::string& line);

  std::optional<AuditLimits> limits_;
  std::string trouble_;
  std::uint64_t lost_ = 0, owed_ = 0;  ///< lines; those that the log does not tell of yet
  std::int64_t lost_since_ = 0;        ///< [s] first of those owed
};

}  // namespace tandem::trust
