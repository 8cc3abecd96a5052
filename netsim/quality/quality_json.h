#pragma once

#include <nlohmann/json_fwd.hpp>

#include "netsim/quality/link_summary.h"

namespace tandem::netsim {

/// Returns the quality of a link as JSON. Keys contain their units; later versions only add keys:
///   verdict: green | amber | red | too short
///   up, down: verdict, from_s, until_s, sent, lost, lost_percent, arrived, duplicates, reordered, reordered_percent,
///     reordered_by_max, delay_{mean,p5,p50,p95,p99,max}_ms, jitter_ms (p99 - p50), age_{mean,p50,p99,max}_ms,
///     age_max_at_s, longest_gap_ms, longest_gap_at_s, sender_pauses, sender_paused_s, windows
///   round_trip: verdict, count, {mean,p5,p50,p95,p99,max}_ms, windows
///   windows: one entry per length: length_s, step_s, judged, {green,amber,red}_percent, and for each of loss, gap,
///     jitter or round_trip_p99: {green,amber,red} (windows), worst_percent or worst_ms, worst_to_s (end of the worst)
[[nodiscard]] nlohmann::ordered_json quality_json(const LinkSummary& link);

/// Returns the quality of one direction.
[[nodiscard]] nlohmann::ordered_json quality_json(const DirectionSummary& way);

}  // namespace tandem::netsim
