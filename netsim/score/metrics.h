#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// The metrics of a lesson: names, units, definitions.
namespace tandem::netsim::score {

/// Metrics of one hand in one part of a lesson. The order is that of `kMetrics`.
enum class Metric : std::uint8_t {
  // Motion of the hand
  kTime,
  kIdleTime,
  kPathLength,
  kStraightShare,
  kSpeedMean,
  kSpeedPeak,
  kSpeedPeaks,
  kWorkspace,
  kHullVolume,
  kAngularPath,
  kSquaredJerk,
  kNormalisedJerk,
  kDimensionlessJerk,
  kLogJerk,
  kSparc,
  kMotionFrequency,
  // Force on the hand
  kForcePeak,
  kForceMean,
  kForceRms,
  kImpulse,
  kForceRateRms,
  kForceRatePeak,
  kWork,
  kExcessTime,
  kForceDeviation,
  kForceEllipsoid,
  kOffAxisShare,
  kForceSparc,
  // Contact of the tool
  kContacts,
  kContactTimeMean,
  kContactForcePeak,
  kContactForceMean,
  kContactImpulse,
  kPenetrationMax,
  // Tracking and transparency
  kTracking,
  kTrackingNoDelay,
  kTrackingDelay,
  kJointTracking,
  kReflectionError,
  kReflectionErrorShare,
  kRenderedStiffness,
  kTransparency,
  kDrift,
  // Sharing
  kAuthorityShare,
  kAuthorityShareContact,
  kWeightedTime,
  kWeightedPath,
  kWeightedImpulse,
  kInterventions,
  kInterventionTime,
  kHandoverJump,
  kHandoverRate,
  // Passivity
  kPassivityMargin,
  kControllerShare,
  kDissipated,
  // Link
  kRoundTrip50,
  kRoundTrip95,
  kRoundTrip99,
  kLossUp,
  kLossDown,
  kGapUp,
  kGapDown,
  kAge99,
  kGateTrips,
  kLateTicks
};
inline constexpr std::size_t kMetricCount = 65;

/// Values by Metric, SI; NaN: the lesson has no such value.
using MetricValues = std::array<double, kMetricCount>;

/// Groups of metrics that the same disturbances spoil.
enum class MetricGroup : std::uint8_t { kMotion, kForce, kContact, kTracking, kSharing, kPassivity, kLink };

/// Which values are better. kNeither: a fact, not a score.
enum class Better : std::uint8_t { kLow, kHigh, kNeither };

/// Description of one metric.
struct MetricRow {
  Metric metric;
  MetricGroup group;
  std::string_view key;      ///< in JSON and CSV
  std::string_view title;    ///< in reports
  std::string_view si_unit;  ///< in JSON and CSV; `1`: dimensionless
  std::string_view unit;     ///< in reports
  double factor;             ///< from SI to that unit
  Better better;
  std::string_view definition;  ///< one sentence
};

/// Returns whether the metric judges a person. Facts about the link and the passivity of the channel do not, nor do
/// metrics without a better side: they get no thresholds of experts and no learning curve.
[[nodiscard]] constexpr bool judges_person(const MetricRow& row) noexcept {
  return row.better != Better::kNeither && row.group != MetricGroup::kLink && row.group != MetricGroup::kPassivity;
}

/// All metrics, in the order of Metric.
[[nodiscard]] const std::array<MetricRow, kMetricCount>& metric_rows() noexcept;
[[nodiscard]] const MetricRow& row_of(Metric metric) noexcept;
/// Returns the metric with this key.
[[nodiscard]] std::optional<Metric> metric_named(std::string_view key) noexcept;
[[nodiscard]] std::string_view title_of(MetricGroup group) noexcept;

/// Returns a value in the unit of reports with three significant digits, without unit; an en dash if it is NaN.
/// Less than 1e-9 is 0.
/// @param value  SI
[[nodiscard]] std::string value_text(const MetricRow& row, double value);
/// The same with its unit, such as `34.1 mm`.
[[nodiscard]] std::string value_with_unit(const MetricRow& row, double value);

/// The scores that a learner reads first.
[[nodiscard]] std::span<const Metric> main_metrics() noexcept;

[[nodiscard]] inline double& of(MetricValues& values, Metric metric) noexcept {
  return values[static_cast<std::size_t>(metric)];
}
[[nodiscard]] inline double of(const MetricValues& values, Metric metric) noexcept {
  return values[static_cast<std::size_t>(metric)];
}

}  // namespace tandem::netsim::score
