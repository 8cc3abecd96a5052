#pragma once

#include <expected>
#include <memory>
#include <string>

#include "common/io/output_file.h"
#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "netsim/engine/replay.h"

namespace tandem::netsim {

/// Writes every decision of a simulated network to a file during the run, in the order of DecisionLog::sorted. It
/// implements option --log of `run`.
class RunLog {
 public:
  /// Opens the file. @param name  empty: no log is written
  /// @return the error; empty if there is none
  [[nodiscard]] std::string open(const std::string& name);
  /// Starts the log. Call it before the first datagram; `network` must outlive `close`.
  void attach(Network& network);
  /// Writes the decisions after a tick that ended at `now`. It does so once per second; other calls cost almost
  /// nothing.
  void on_tick(Time now);
  /// Closes the file. @return the error; empty if every row was written
  [[nodiscard]] std::string close();

 private:
  void write(Time until);

  io::OutputFile file_;
  DecisionLog log_{0};
  Network* network_ = nullptr;
  Time next_{};
};

/// Reads a decision log for replay: option --replay.
/// @return the recording, or the errors, one per line
[[nodiscard]] std::expected<std::shared_ptr<const Replay>, std::string> load_replay(const std::string& file);

}  // namespace tandem::netsim
