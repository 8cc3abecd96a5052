#pragma once

#include <string>

#include "common/io/parallel_jobs.h"
#include "common/io/terminal.h"

namespace tandem::netsim {

/// How far all seeds are, on one line of the terminal; silent without one.
class TestProgress {
 public:
  explicit TestProgress(bool quiet);
  void show(const io::JobsProgress& progress, std::size_t failed);
  void end() { line_.clear(); }

 private:
  io::StatusLine line_;
};

/// `12 s`, `3.5 min`
[[nodiscard]] std::string length_text(double seconds);

}  // namespace tandem::netsim
