#pragma once

#include <string>

#include "common/io/parallel_jobs.h"
#include "common/io/terminal.h"

namespace tandem::netsim {

/// Shows the progress of all seeds on one line of the terminal; prints nothing without a terminal.
class TestProgress {
 public:
  explicit TestProgress(bool quiet);
  void show(const io::JobProgress& progress, std::size_t failed);
  void end() { line_.clear(); }

 private:
  io::StatusLine line_;
};

/// Returns the estimated rest as text: `, about 12 s left`, `, about 3.5 min left`; empty if it is unknown.
[[nodiscard]] std::string left_text(const io::JobProgress& progress);

}  // namespace tandem::netsim
