#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/auth/limiter.h"
#include "common/base/time.h"

namespace tandem::auth {

/// Rate limiter for audit lines about rejected peers, so that no peer fills the log. It limits the lines of each source
/// and of all sources together. Suppressed lines are counted and reported once per minute with their sources. Memory is
/// bounded.
class AuditThrottle {
 public:
  struct Limits {
    double source_per_s = 0.1, source_burst = 10;  ///< 6 lines per minute of each source
    double all_per_s = 1, all_burst = 60;          ///< 60 lines per minute of all sources
  };
  static constexpr std::size_t kSourcesMax = 1024;  ///< beyond it the entry unused for longest is dropped
  static constexpr std::size_t kNamedMax = 5;       ///< sources named in a summary: those with the most lines
  static constexpr Duration kSummaryInterval = std::chrono::seconds(60);

  AuditThrottle() : AuditThrottle(Limits{}) {}
  explicit AuditThrottle(const Limits& limits) : limits_(limits), all_(limits.all_per_s, limits.all_burst) {}

  /// Decides about one line. @param source  address or workstation  @return true: the line may be written; false: it
  /// was counted
  [[nodiscard]] bool admit(const std::string& source, Time now);
  /// @return text for the log about the lines suppressed since the last summary; nullopt if there are none or the first
  /// is less than a minute old
  [[nodiscard]] std::optional<std::string> summary(Time now);
  /// The same without the minute's delay, before the log ends.
  [[nodiscard]] std::optional<std::string> last_summary();
  /// Total number of suppressed lines.
  [[nodiscard]] std::uint64_t suppressed() const noexcept { return suppressed_; }

 private:
  struct Entry {
    TokenBucket bucket;
    Time heard;
    std::uint64_t left = 0;  ///< lines suppressed since the last summary
  };
  void forget_oldest();

  Limits limits_;
  TokenBucket all_;
  std::map<std::string, Entry> sources_;
  std::uint64_t suppressed_ = 0, unreported_ = 0;
  Time unreported_since_{};
};

}  // namespace tandem::auth
