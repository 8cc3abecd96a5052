#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "client/app/seat_pump.h"
#include "common/io/output_file.h"

namespace tandem::client {

/// An ordinary thread that writes a seat's own samples: `t_s[s]`, joints, tip, forces (wanted, let through by the gate,
/// delivered), gate, alpha, one row per servo tick. Before the session began, t_s is minus the time at the seat.
class SampleTrace {
 public:
  /// @param file  opened
  SampleTrace(io::OutputFile& file, std::size_t joints, bool prismatic);
  ~SampleTrace() { finish(); }

  [[nodiscard]] SampleQueue& queue() noexcept { return queue_; }
  /// Once the servo is over: writes what is left.
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
