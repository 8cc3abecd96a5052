#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal/device.h"

namespace tandem::client {

/// What a device's exchanges were like, for machines: counts; `period_ms` and `round_trip_ms` with quantiles and `buckets`,
/// {from, to, count} in ms, a value v with from <= v < to, only buckets that hold anything. `round_trip_ms` is null for a
/// device that exchanges nothing.
[[nodiscard]] nlohmann::ordered_json to_json(const hal::DeviceStats& stats, const hal::DeviceHistograms& histograms);

/// The same for people, a line each. Buckets of less than a thousandth are told together.
[[nodiscard]] std::vector<std::string> summary(const hal::DeviceStats& stats, const hal::DeviceHistograms& histograms);

}  // namespace tandem::client
