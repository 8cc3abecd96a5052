#pragma once

#include <span>
#include <string>
#include <string_view>

#include "netsim/feel/probes.h"

namespace tandem::netsim {

/// Description of one number of the feel report.
struct FeelKey {
  std::string_view key;          ///< key in JSON, CSV and limits; values are in SI units
  std::string_view description;  ///< description for reports
  std::string_view unit;         ///< unit in reports; empty: dimensionless
  double factor = 1;             ///< factor from SI to that unit
  bool least_is_worst = false;
};

/// A section of the report: title and numbers, in order.
struct FeelSection {
  Probe probe;  ///< probe that measures them; press and free both measure exposure
  std::string_view title;
  std::span<const FeelKey> keys;
};
[[nodiscard]] std::span<const FeelSection> feel_sections();

/// Returns the description of a key; null if the key is unknown.
[[nodiscard]] const FeelKey* find_feel_key(std::string_view key);

/// Returns the unit of a key's SI value, from its ending: `n_m` N/m, `n` N, `m` m, ...; empty: dimensionless.
[[nodiscard]] std::string_view si_unit(std::string_view key);

/// Writes the numbers of an exposure: engaged_share, held_share, saturated_share, trips_per_min, delivered_error_n.
/// They are NaN if the exposure has no time.
void put_exposure(const Exposure& exposure, FeelValues& values);

}  // namespace tandem::netsim
