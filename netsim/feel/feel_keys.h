#pragma once

#include <span>
#include <string>
#include <string_view>

#include "netsim/feel/probes.h"

namespace tandem::netsim {

/// A number of the feel report.
struct FeelKey {
  std::string_view key;    ///< in JSON, CSV and limits; SI
  std::string_view words;  ///< for people
  std::string_view unit;   ///< of the number as people read it; empty: a plain number
  double factor = 1;       ///< from SI to that unit
  bool least_is_worst = false;
};

/// A heading and its numbers, in the order of the report.
struct FeelSection {
  Probe probe;  ///< that measures them; exposure belongs to press and free together
  std::string_view title;
  std::span<const FeelKey> keys;
};
[[nodiscard]] std::span<const FeelSection> feel_sections();

/// Null: there is no such number.
[[nodiscard]] const FeelKey* find_feel_key(std::string_view key);

/// The unit of a key's SI value, from its ending: `n_m` N/m, `n` N, `m` m, ...; empty: a plain number.
[[nodiscard]] std::string_view si_unit(std::string_view key);

/// The numbers that exposure gives: engaged_share, held_share, saturated_share, trips_per_min, delivered_error_n. NaN of no time.
void put_exposure(const Exposure& exposure, FeelValues& values);

}  // namespace tandem::netsim
