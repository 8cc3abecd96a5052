#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hal/core/device.h"

namespace tandem::client {

/// Returns the statistics of a device's exchanges as JSON: counts, and `period_ms` and `round_trip_ms` with quantiles
/// and `buckets`. A bucket {from, to, count} [ms] counts the values v with from <= v < to; empty buckets are omitted.
/// `round_trip_ms` is null for a device without exchanges.
[[nodiscard]] nlohmann::ordered_json to_json(const hal::DeviceStats& stats, const hal::DeviceHistograms& histograms);

/// Returns the same as text, one line each. Buckets with less than a thousandth of the values are combined.
[[nodiscard]] std::vector<std::string> summary(const hal::DeviceStats& stats, const hal::DeviceHistograms& histograms);

}  // namespace tandem::client
