#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "common/base/format.h"
#include "common/base/time.h"

namespace tandem::server {

/// Notices that the wall clock of this computer was set while the server runs. Sessions and leases use other clocks;
/// tickets, enrolment codes and vouchers are judged by this one.
class ClockWatch {
 public:
  static constexpr std::int64_t kStepMax = 60;  ///< [s] a smaller step is not reported

  /// Compares two clocks with their last readings.
  /// @param wall_s  of the wall clock, since 1970, UTC [s]
  /// @param boot    of CLOCK_BOOTTIME at the same moment
  /// @return message for the operator; empty: the wall clock was not set
  [[nodiscard]] std::string update(std::int64_t wall_s, Time boot) {
    const std::int64_t offset = wall_s - static_cast<std::int64_t>(seconds(boot.time_since_epoch()));
    const std::int64_t step = offset - offset_.value_or(offset);
    offset_ = offset;
    if (std::abs(step) <= kStepMax) return {};
    return "the clock of this computer was set " + span(std::abs(step)) + (step > 0 ? " forward" : " back") +
           " while the server runs. Sessions that run go on. Tickets, enrolment codes and vouchers are judged by the "
           "new time: if it is wrong, joins are refused until the clock is set (`timedatectl`)";
  }

 private:
  static std::string span(std::int64_t s) {
    constexpr std::int64_t kHour = 3600, kDay = 24 * kHour;
    if (s < 2 * kHour) return format("%lld min", static_cast<long long>(s / 60));
    if (s < 2 * kDay) return format("%lld h", static_cast<long long>(s / kHour));
    return format("%lld days", static_cast<long long>(s / kDay));
  }

  std::optional<std::int64_t> offset_;
};

}  // namespace tandem::server
