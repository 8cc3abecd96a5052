#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/io/output_file.h"
#include "netsim/system/simulation.h"
#include "netsim/system/simulation_config.h"
#include "server/recording/recording_writer.h"
#include "server/session/input_journal.h"

namespace tandem::netsim {

/// Writes the recording of a simulated session: options --record of `run` and --record-failures of `test`. Seats have
/// their values of each tick without the delay of the network, as in the trace.
class RunRecording {
 public:
  /// @param setup  of the simulation; outlives this object
  /// @param facts  more metadata of the file (server::RecordingInfo::metadata); they replace equal names
  explicit RunRecording(const SimulationConfig& setup, std::map<std::string, std::string> facts = {});

  /// Journal of the session's inputs, for SimulationConfig::journal.
  [[nodiscard]] server::InputJournal& journal() noexcept { return journal_; }

  /// Opens the file. @param name  empty: nothing is recorded
  /// @return the error; empty if there is none
  [[nodiscard]] std::string open(const std::string& name);
  /// Receives the session's events from now on. @param simulation  outlives this object
  void attach(Simulation& simulation);
  /// Records a tick. Call it after every step.
  void on_tick(const Simulation& simulation);
  /// Ends the recording and closes the file. @return the error; empty if every byte was written
  [[nodiscard]] std::string close();

 private:
  void take_inputs();

  const SimulationConfig* setup_;
  std::map<std::string, std::string> facts_;
  server::InputJournal journal_;
  std::vector<std::byte> piece_;
  io::OutputFile file_;
  std::unique_ptr<server::RecordingWriter> writer_;
  std::uint64_t steps_ = 0;
};

}  // namespace tandem::netsim
