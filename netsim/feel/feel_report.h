#pragma once

#include <map>
#include <string>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "proto/scene_spec.h"

namespace tandem::netsim {

/// Everything that was measured.
struct FeelReport {
  std::string scene, network, channel;  ///< for people
  SceneSpec spec;
  bool plain_hands = false;
  std::vector<Probe> probes;
  std::vector<FeelSeed> seeds;
  std::vector<std::string> recordings;
  std::vector<FeelLimit> limits;
  std::map<std::string, FeelNumber> numbers;  ///< summarised(seeds)
  double one_way_s = 0;                       ///< mean over the seeds; NaN: unknown
  std::vector<std::string> troubles;          ///< of single seeds and probes, for people
  std::vector<std::string> notes;             ///< of the network
  double lived_s = 0, wall_s = 0;
  bool interrupted = false;

  /// Limits that are broken, or whose number does not exist.
  [[nodiscard]] std::vector<const FeelLimit*> broken() const;
  /// Everything was measured, and every limit holds.
  [[nodiscard]] bool passed() const { return troubles.empty() && !interrupted && broken().empty(); }
};

/// Readable at 80 columns.
[[nodiscard]] std::string feel_text(const FeelReport& report);
/// One row per number: `key,unit,mean,worst,worst_seed`, SI.
[[nodiscard]] std::string feel_csv(const FeelReport& report);
/// Keys as in the manual; SI; NaN becomes null.
[[nodiscard]] std::string feel_json(const FeelReport& report);

/// A probe's result as text, from one process to another; and back.
[[nodiscard]] std::string to_bytes(const ProbeResult& result);
/// @throws std::exception if the bytes are not those of to_bytes.
[[nodiscard]] ProbeResult probe_result_from_bytes(const std::string& bytes);

}  // namespace tandem::netsim
