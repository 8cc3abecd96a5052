#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/report/report.h"

/// Limits of a scenario: ranges for numbers of a run's report.
namespace tandem::netsim {

/// A limit of one number of a report. netsim/scenario/scenario.h makes it; indices are those of the scene.
struct Limit {
  enum class Of : std::uint8_t { kSeat, kTool, kSession, kFeel } of = Of::kSeat;
  std::size_t index = 0;             ///< index of the seat or tool
  std::optional<std::size_t> phase;  ///< none: the whole run
  std::string metric;                ///< known_metric(of, metric)
  std::string subject;               ///< name in reports: `trainer`, `trainer in guidance`, `tool`, `session`, `feel`
  std::string unit;                  ///< empty: dimensionless
  std::optional<double> min, max;    ///< ends included
};

/// Traits of a metric: the phases in which it exists.
struct MetricTraits {
  bool by_phase = false;       ///< exists for a single phase
  bool needs_contact = false;  ///< exists only in phases marked `contact`
};
/// Returns the traits of a metric; nullopt if there is no metric of this name.
[[nodiscard]] std::optional<MetricTraits> known_metric(Limit::Of of, std::string_view metric);

/// Returns the number that the limit is for; NaN where the run has none.
[[nodiscard]] double value_of(const Limit& limit, const server::RunReport& report);

/// Returns the distance of a value to the nearest end of its range, in units of the value. Negative outside the range,
/// -inf for NaN.
[[nodiscard]] double slack(const Limit& limit, double value) noexcept;

/// Returns whether the value lies in the range. NaN never does.
[[nodiscard]] bool holds(const Limit& limit, double value) noexcept;

/// Returns the slack as a share of the end from which it is measured [%]; NaN when that end is 0.
[[nodiscard]] double margin_percent(const Limit& limit, double value) noexcept;

/// Returns the range as text: `at most 0.01 m`, `at least 4 %`, `4 to 6 %`, `exactly 0`.
[[nodiscard]] std::string range_text(const Limit& limit);

/// Returns a number with at most five digits: 0.0061234, 12.5, 100000.
[[nodiscard]] std::string short_number(double value);

}  // namespace tandem::netsim
