#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "netsim/score/metrics.h"
#include "netsim/score/part_scores.h"

/// How far a part's data can be trusted, in numbers and words.
namespace tandem::netsim::score {

/// Whether a value may be shown. kAbsent: the lesson has no such value.
enum class Trust : std::uint8_t { kGood, kFlagged, kWithheld, kAbsent };
[[nodiscard]] std::string_view to_text(Trust trust) noexcept;

/// One reason to distrust metrics of some groups.
struct Doubt {
  Trust trust = Trust::kFlagged;
  std::vector<MetricGroup> groups;  ///< whose metrics it concerns
  std::string reason;               ///< a clause for people, such as `2.1 % of the samples are missing (limit 1 %)`
};

struct Quality {
  double expected_s = 0;        ///< time of the part, ticks without rows included [s]
  double missing_share = 0;     ///< ticks without a new sample of this seat [0, 1]
  double longest_gap_s = 0;     ///< between two new samples; a clean signal has one tick [s]
  bool freshness_known = true;  ///< false: the file does not state which samples are new, so only missing rows count
  bool gate_known = true;       ///< false: the file states neither the gate's state nor its trips
  std::uint32_t gate_trips = 0;
  double clipped_share = 0;        ///< ticks in which the commanded force was above the limit of the seat [0, 1]
  double margin_min_j = kUnknown;  ///< least passivity margin so far [J]; below 0: the account was overdrawn
  std::vector<Doubt> doubts;
};

/// @param losses  of the link in this part, as the client counted them (Metric::kGateTrips); NaN: unknown
[[nodiscard]] Quality quality_of(const PartInput& in, double losses);

/// Trust in one metric, and the reasons against full trust as one text.
struct MetricTrust {
  Trust trust = Trust::kGood;
  std::string reason;
};
[[nodiscard]] MetricTrust trust_in(const Quality& quality, Metric metric, double value);

/// Largest force that the gate of a master delivers [N].
[[nodiscard]] double force_limit_of(const SceneSpec& scene, std::size_t seat) noexcept;

}  // namespace tandem::netsim::score
