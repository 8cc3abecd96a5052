#pragma once

#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/quality/link_summary.h"

namespace tandem::netsim {

/// Distribution of the age of information over time. The age grows with time and falls when a newer datagram arrives.
/// Each interval between two falls is added as a whole, so that quantiles are weighted by time without sampling.
class AgeOfInformation {
 public:
  AgeOfInformation();
  /// Adds an interval in which the age grew from `from` to `to`, ending at `end`. Ignored if `to` <= `from`.
  void add(Duration from, Duration to, Time end) noexcept TANDEM_REALTIME;
  [[nodiscard]] AgeSummary summary() const noexcept;

 private:
  /// The time spent in a bin is width * (intervals open at its begin) + rest. Both sums are exact, and `add` touches
  /// only two bins.
  struct Bin {
    std::int64_t begun = 0;  ///< intervals that began in this bin minus those that ended in it
    Duration rest{};         ///< signed correction for intervals that began or ended in this bin
  };
  [[nodiscard]] Duration quantile(double share) const noexcept;

  std::vector<Bin> bins_;
  Duration observed_{};
  double integral_ = 0;  ///< integral of the age over time [s^2]
  Duration max_{};
  Time max_at_;
};

}  // namespace tandem::netsim
