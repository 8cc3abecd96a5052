#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/scenario.h"
#include "server/violations.h"

namespace tandem::netsim {

/// What became of one seed of a scenario.
struct SeedOutcome {
  enum class State : std::uint8_t {
    kNotRun,
    kPass,
    kFail,     ///< an invariant or a limit is broken
    kTrouble,  ///< it could not begin or never ran
    kCrash,    ///< the program died under it
  };
  std::uint64_t seed = 0;
  State state = State::kNotRun;
  std::string trouble;                        ///< of kTrouble and kCrash, for people
  std::vector<server::Violation> violations;  ///< expected ones too
  std::vector<double> values;                 ///< one per limit of the scenario; NaN: the run has no such number
  /// Seat and band of its link for force feedback (netsim/quality_text.h): `green`, `amber`, `red`, `too short`.
  std::vector<std::pair<std::string, std::string>> bands;
  std::vector<std::string> notes;  ///< events outside of the session, changed addresses: netsim/world_notes.h
  std::string words;   ///< what its network was like, as `run` says it (quality_report)
  double badness = 0;  ///< of its worst link (netsim/quality_text.h)
  std::string trace_hash;
  double duration_s = 0;                      ///< of the session
  double cpu_s = 0;
  std::string report;                         ///< JSON of `run --json` without cpu_s; only if asked for

  [[nodiscard]] bool failed() const noexcept { return state != State::kNotRun && state != State::kPass; }
};

/// For words such as `pass`, `fail`, as JSON has them.
[[nodiscard]] std::string_view name(SeedOutcome::State state) noexcept;

struct SeedRunWatch {
  std::function<void(double share)> progress = {};         ///< of the session [0, 1]
  std::function<void(std::string_view rows)> trace = {};   ///< as of WorldRunWatch
  bool report = false;                                     ///< whether SeedOutcome::report is wanted
};

/// Runs one seed to its end and judges invariants and limits.
[[nodiscard]] SeedOutcome run_seed(const Scenario& scenario, std::uint64_t seed, const SeedRunWatch& watch);

/// An outcome as bytes, from one process to another.
[[nodiscard]] std::string to_bytes(const SeedOutcome& outcome);
/// @throws std::exception if the bytes are not those of to_bytes.
[[nodiscard]] SeedOutcome outcome_from_bytes(const std::string& bytes);

}  // namespace tandem::netsim
