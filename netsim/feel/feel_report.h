#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "proto/spec/scene_spec.h"

namespace tandem::netsim {

/// All results of a measurement.
struct FeelReport {
  std::string scene, network, channel;  ///< descriptions for reports
  SceneSpec spec;
  bool plain_hands = false;
  std::vector<Probe> probes;
  std::vector<FeelSeed> seeds;
  std::vector<std::string> recordings;
  std::vector<FeelLimit> limits;
  std::map<std::string, FeelNumber> numbers;  ///< summarised(seeds)
  double one_way_s = 0;                       ///< network delay each way [s], mean over the seeds; NaN: unknown
  std::vector<std::string> troubles;          ///< failures of single seeds and probes, for reports
  std::vector<std::string> notes;             ///< facts about the network
  double lived_s = 0, wall_s = 0;
  bool interrupted = false;

  /// Returns the number of a key; null if it was not measured.
  [[nodiscard]] const FeelNumber* find(std::string_view key) const;
  /// Returns whether a limit holds; a number that does not exist breaks it.
  [[nodiscard]] bool holds(const FeelLimit& limit) const;
  /// Returns the measured keys of a section and their numbers, in order.
  [[nodiscard]] std::vector<std::pair<const FeelKey*, FeelNumber>> rows(const FeelSection& section) const;
  /// Returns the limits that are broken, or whose number does not exist.
  [[nodiscard]] std::vector<const FeelLimit*> broken() const;
  /// Returns whether all was measured and every limit holds.
  [[nodiscard]] bool passed() const { return troubles.empty() && !interrupted && broken().empty(); }
};

/// Returns the report as text of 80 columns.
[[nodiscard]] std::string feel_text(const FeelReport& report);
/// Returns one row per number: `key,unit,mean,worst,worst_seed`, in SI units.
[[nodiscard]] std::string feel_csv(const FeelReport& report);
/// Returns the report as JSON with the keys of the manual, in SI units; NaN becomes null.
[[nodiscard]] std::string feel_json(const FeelReport& report);

/// Encodes a probe's result for transfer from one process to another.
[[nodiscard]] std::string to_bytes(const ProbeResult& result);
/// Decodes a result. @throws std::exception if the bytes are not those of to_bytes.
[[nodiscard]] ProbeResult probe_result_from_bytes(const std::string& bytes);

}  // namespace tandem::netsim
