#pragma once

#include <expected>
#include <memory>
#include <string>

#include "common/io/output_file.h"
#include "netsim/decision_log.h"
#include "netsim/network.h"
#include "netsim/replay.h"

namespace tandem::netsim {

/// Option --log of `run`: every decision of a virtual network, written as the run goes on, in the order of
/// DecisionLog::sorted.
class RunLog {
 public:
  /// @param name  empty: nothing is wanted
  /// @return what is wrong, empty if nothing
  [[nodiscard]] std::string open(const std::string& name);
  /// Before the first datagram; `network` must outlive `close`.
  void attach(Network& network);
  /// After a tick that ended at `now`; cheap unless a second went by.
  void on_tick(Time now);
  /// @return what is wrong, empty if every row was written
  [[nodiscard]] std::string close();

 private:
  void write(Time until);

  io::OutputFile file_;
  DecisionLog log_{0};
  Network* network_ = nullptr;
  Time next_{};
};

/// Reads a decision log to play it: option --replay.
/// @return the recording, or what is wrong: one mistake per line
[[nodiscard]] std::expected<std::shared_ptr<const Replay>, std::string> load_replay(const std::string& file);

}  // namespace tandem::netsim
