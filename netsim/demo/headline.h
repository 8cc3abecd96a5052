#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/demo/comparison.h"
#include "netsim/demo/run_numbers.h"

/// Summary of the demo: one sentence and key numbers. Pure functions.
namespace tandem::netsim::demo {

/// A number for the top of the page.
struct KeyNumber {
  std::string value;   ///< "1.4 mm"
  std::string what;    ///< description of the value
  std::string beside;  ///< "paper 8.2 mm; bad network 5.4 mm"
};
/// Disturbances of all runs by a busy machine.
struct Disturbance {
  /// Late ticks beyond this share of all ticks of server and clients count as a disturbance: more than 6 of the 342 000
  /// ticks of all six runs. Two cores at load 8 had 11 of them, and missed two limits that --quick keeps.
  static constexpr double kLateShareMax = 2e-5;

  /// Up to this share of late ticks, kept limits hold. Limits bound errors from above (stiffness from below), and a
  /// late tick makes an error larger: a force is held for longer, a hand follows later. One tick in a thousand changes
  /// an RMS by less than what is printed.
  static constexpr double kLateShareHeavy = 1e-3;

  double gate_trips = 0;  ///< of both hands in all runs
  double late_ticks = 0;  ///< more than 1 ms late, of server and clients in all runs; 0 in virtual time
  double ticks = 0;       ///< of server and clients in all runs

  /// Whether gates released a hand, or more ticks were late than on an idle machine.
  [[nodiscard]] bool found() const noexcept { return gate_trips > 0 || late_ticks > kLateShareMax * ticks; }
  /// Whether kept limits prove nothing: a released hand feels no force, and so has no error of force.
  [[nodiscard]] bool heavy() const noexcept { return gate_trips > 0 || late_ticks > kLateShareHeavy * ticks; }
};
/// Returns the disturbances of `runs`; unknown numbers count as 0.
[[nodiscard]] Disturbance disturbance_of(std::span<const RunResult> runs);

/// Returns the warning about disturbed runs: numbers, their meaning, the remedy; empty if they were not disturbed.
[[nodiscard]] std::string disturbance_text(const Disturbance& disturbance);

struct Headline {
  std::string sentence;
  std::string disturbed;            ///< `disturbance_text` of the runs; empty: undisturbed
  std::vector<std::string> missed;  ///< each missed limit: row, setting, value, limit
  std::vector<KeyNumber> numbers;   ///< of the runs in this report
};

[[nodiscard]] Headline headline_of(std::span<const RunResult> runs, const Comparison& comparison);

/// Returns the name of a setting, for example "Defaults on the bad network".
[[nodiscard]] std::string_view name_of(Setting setting) noexcept;

}  // namespace tandem::netsim::demo
