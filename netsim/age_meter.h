#pragma once

#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/quality_summary.h"

namespace tandem::netsim {

/// Age of information over time: it grows as time does, and falls when something newer comes. Each stretch between two
/// falls is added whole, so that quantiles are weighted by time and nothing is sampled.
class AgeMeter {
 public:
  AgeMeter();
  /// The age grew from `from` to `to`, which it had at `end`; nothing when it did not grow.
  void add(Duration from, Duration to, Time end) noexcept TANDEM_REALTIME;
  [[nodiscard]] AgeSummary summary() const noexcept;

 private:
  /// Time spent in a bin is width * (stretches over its begin) + rest; both sums are exact, adding touches two bins.
  struct Bin {
    std::int64_t begun = 0;  ///< stretches that began in it less those that ended in it
    Duration rest{};         ///< of stretches that began or ended in it: what they have of it, more or less than all or none
  };
  [[nodiscard]] Duration quantile(double share) const noexcept;

  std::vector<Bin> bins_;
  Duration watched_{};
  double integral_ = 0;  ///< of the age over time [s^2]
  Duration max_{};
  Time max_at_;
};

}  // namespace tandem::netsim
