#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Returns the seconds of a monotonic clock.
[[nodiscard]] double monotonic_seconds();

/// Shows the progress: one updated line on a terminal; otherwise one line per run.
class Progress {
 public:
  /// @param rate  estimated session time per real time [s/s]; finished runs correct it
  Progress(std::vector<const RunPlan*> plans, double rate);
  void begin(std::size_t run);
  void at(double session_s);
  void end();
  /// Clears the line, before other output.
  void clear() const;

 private:
  [[nodiscard]] std::string remaining() const;

  std::vector<const RunPlan*> plans_;
  double rate_;
  bool terminal_;
  std::size_t run_ = 0;
  double session_s_ = 0, done_s_ = 0;              ///< of this run; of the runs before [s]
  double begun_ = 0, run_begun_ = 0, shown_ = -1;  ///< on the monotonic clock [s]
};

/// Returns a duration such as "45 s" or "2 min 05 s".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace tandem::netsim::demo
