#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/scenario/scenario.h"
#include "server/report/violations.h"

namespace tandem::netsim {

/// Result of one seed of a scenario.
struct SeedOutcome {
  enum class State : std::uint8_t {
    kNotRun,
    kPass,
    kFail,     ///< an invariant or a limit is broken
    kTrouble,  ///< the session could not begin or never ran
    kCrash,    ///< the process died during the run
  };
  std::uint64_t seed = 0;
  State state = State::kNotRun;
  std::string trouble;                        ///< reason of kTrouble and kCrash, for reports
  std::vector<server::Violation> violations;  ///< includes expected violations
  std::vector<double> values;                 ///< one per limit of the scenario; NaN: the run has no such number
  /// Seat, and band of its link for force feedback (netsim/quality/quality_text.h): `green`, `amber`, `red`, `too
  /// short`.
  std::vector<std::pair<std::string, std::string>> bands;
  std::vector<std::string> notes;  ///< events outside the session, changed addresses: netsim/system/session_notes.h
  std::string network_text;        ///< description of its network, as `run` prints it (quality_report)
  double badness = 0;              ///< badness of its worst link (netsim/quality/quality_text.h)
  std::string trace_hash;
  double duration_s = 0;  ///< of the session
  double cpu_s = 0;
  std::string report;                  ///< JSON of `run --json` without cpu_s; only on request
  std::string recording = {};          ///< file that has the run; empty: none
  std::string recording_problem = {};  ///< why there is no such file, or what it lacks; empty: nothing

  [[nodiscard]] bool failed() const noexcept { return state != State::kNotRun && state != State::kPass; }
};

/// Returns the state as in JSON, for example `pass` or `fail`.
[[nodiscard]] std::string_view name(SeedOutcome::State state) noexcept;

/// Recording of a run that is requested.
struct RecordingRequest {
  std::string file;                          ///< empty: nothing is recorded
  std::map<std::string, std::string> facts;  ///< metadata of the file, as in RunRecording
};

struct SeedRunObserver {
  std::function<void(double share)> progress = {};        ///< receives the share of the session that has run [0, 1]
  std::function<void(std::string_view rows)> trace = {};  ///< as in SimulationObserver
  bool report = false;                                    ///< whether SeedOutcome::report is requested
  RecordingRequest recording = {};                        ///< fills SeedOutcome::recording and recording_problem
};

/// Runs one seed to its end and judges invariants and limits.
[[nodiscard]] SeedOutcome run_seed(const Scenario& scenario, std::uint64_t seed, const SeedRunObserver& observer);

/// Returns the JSON report of a run without its key cpu_s, which differs between equal runs.
[[nodiscard]] std::string without_cpu_time(const std::string& report);

/// Encodes an outcome for transfer from one process to another.
[[nodiscard]] std::string to_bytes(const SeedOutcome& outcome);
/// Decodes an outcome. @throws std::exception if the bytes are not those of to_bytes.
[[nodiscard]] SeedOutcome outcome_from_bytes(const std::string& bytes);

}  // namespace tandem::netsim
