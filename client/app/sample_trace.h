#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "client/app/sample.h"
#include "common/io/output_file.h"

namespace tandem::client {

/// Writes a seat's samples as CSV on an ordinary thread, one row per servo tick: `t_s[s]`, joints, tip, forces (wanted,
/// after the gate, delivered), gate, alpha. Before the session, t_s is minus the time at the seat.
class SampleTrace {
 public:
  /// @param file  open file; must outlive this object
  SampleTrace(io::OutputFile& file, std::size_t joints, bool prismatic);
  ~SampleTrace() { finish(); }

  [[nodiscard]] SampleQueue& queue() noexcept { return queue_; }
  /// Writes the remaining samples and ends the thread. Call after the servo thread has ended.
  void finish();

 private:
  void work();
  void drain();

  io::OutputFile* file_;
  std::size_t joints_;
  SampleQueue queue_{4096};
  std::string rows_;
  std::atomic<bool> finish_{false};
  std::thread thread_;
};

}  // namespace tandem::client
