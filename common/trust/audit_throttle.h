#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/base/time.h"
#include "common/trust/limiter.h"

namespace tandem::trust {

/// Decides which lines about refused peers the audit log takes, so that none of them fills it: so many of each source, and so many of all
/// together. What is left out is counted, and told once a minute with the sources it came from. Memory is bounded.
class AuditThrottle {
 public:
  struct Limits {
    double source_per_s = 0.1, source_burst = 10;  ///< 6 lines a minute of each source
    double all_per_s = 1, all_burst = 60;          ///< 60 lines a minute of all
  };
  static constexpr std::size_t kSourcesMax = 1024;  ///< beyond it the one heard of longest ago is forgotten
  static constexpr std::size_t kNamedMax = 5;       ///< sources named in a summary, those with the most lines
  static constexpr Duration kTellEvery = std::chrono::seconds(60);

  AuditThrottle() : AuditThrottle(Limits{}) {}
  explicit AuditThrottle(const Limits& limits) : limits_(limits), all_(limits.all_per_s, limits.all_burst) {}

  /// @param source  address or workstation  @return whether the line may be written; false: it is counted
  [[nodiscard]] bool admit(const std::string& source, Time now);
  /// @return what was left out since the summary before, for a person; nothing: nothing was, or the first of it is less than a minute old
  [[nodiscard]] std::optional<std::string> summary(Time now);
  /// The same without waiting, before the log ends.
  [[nodiscard]] std::optional<std::string> last_summary();
  /// Lines left out in all.
  [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }

 private:
  struct Entry {
    TokenBucket bucket;
    Time heard;
    std::uint64_t left = 0;  ///< lines left out since the last summary
  };
  void forget_oldest();

  Limits limits_;
  TokenBucket all_;
  std::map<std::string, Entry> sources_;
  std::uint64_t left_out_ = 0, untold_ = 0;
  Time untold_since_{};
};

}  // namespace tandem::trust
