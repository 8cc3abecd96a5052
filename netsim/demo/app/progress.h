#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Seconds on a clock that never jumps.
[[nodiscard]] double monotonic_seconds();

/// One line that stays alive on a terminal; on anything else one line per run.
class Progress {
 public:
  /// @param rate  seconds of session time that pass in a second, as far as known before; runs correct it
  Progress(std::vector<const RunPlan*> plans, double rate);
  void begin(std::size_t run);
  void at(double session_s);
  void end();
  /// Clears the line, before something else is printed.
  void clear() const;

 private:
  [[nodiscard]] std::string remaining() const;

  std::vector<const RunPlan*> plans_;
  double rate_;
  bool terminal_;
  std::size_t run_ = 0;
  double session_s_ = 0, done_s_ = 0;              ///< of this run; of those before [s]
  double begun_ = 0, run_begun_ = 0, shown_ = -1;  ///< own clock [s]
};

/// "45 s", "2 min 05 s".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace tandem::netsim::demo
