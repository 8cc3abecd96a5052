#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/report.h"

/// Limits of a scenario: which number of a run's report must lie where.
namespace tandem::netsim {

/// One number of a report that must lie in a range. Made by netsim/scenario.h; indices are those of the scene.
struct Limit {
  enum class Of : std::uint8_t { kSeat, kTool, kSession, kFeel } of = Of::kSeat;
  std::size_t index = 0;             ///< seat or tool
  std::optional<std::size_t> phase;  ///< none: the whole run
  std::string metric;                ///< known_metric(of, metric)
  std::string subject;               ///< for people: `trainer`, `trainer in guidance`, `tool`, `session`, `feel`
  std::string unit;                  ///< empty: a plain number
  std::optional<double> min, max;    ///< ends included
};

/// What a metric can be asked of.
struct MetricTraits {
  bool by_phase = false;       ///< exists for one phase alone
  bool needs_contact = false;  ///< exists only in phases marked `contact`
};
/// Nothing: there is no metric of this name.
[[nodiscard]] std::optional<MetricTraits> known_metric(Limit::Of of, std::string_view metric);

/// The number; NaN where the run has none.
[[nodiscard]] double value_of(const Limit& limit, const server::RunReport& report);

/// How far inside its range a value lies, in units of the value: negative when it is broken, -inf for NaN.
[[nodiscard]] double slack(const Limit& limit, double value) noexcept;

/// Whether the value lies in the range. NaN never does: unknown is not fine.
[[nodiscard]] bool holds(const Limit& limit, double value) noexcept;

/// Slack as a share of the end it is measured from [%]; NaN when that end is 0.
[[nodiscard]] double margin_percent(const Limit& limit, double value) noexcept;

/// `at most 0.01 m`, `at least 4 %`, `4 to 6 %`, `exactly 0`
[[nodiscard]] std::string range_text(const Limit& limit);

/// At most five digits: 0.0061234, 12.5, 100000.
[[nodiscard]] std::string short_number(double value);

}  // namespace tandem::netsim
