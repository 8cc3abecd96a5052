#include "netsim/app/test_progress.h"

#include <unistd.h>

#include <cmath>

#include "common/base/format.h"

namespace tandem::netsim {

TestProgress::TestProgress(bool quiet) : line_(quiet || isatty(STDERR_FILENO) == 0) {}

void TestProgress::show(const io::JobProgress& p, std::size_t failed) {
  if (!line_.wanted()) return;
  std::string words = format("%3.0f %%  %zu of %zu seeds done, %zu running, %zu failed", 100 * p.share, p.done, p.count,
                             p.running, failed);
  if (std::isfinite(p.left_s) && p.done < p.count) words += ", about " + length_text(p.left_s) + " left";
  line_.show(words);
}

std::string length_text(double seconds) {
  return seconds < 100 ? format("%.0f s", seconds) : format("%.1f min", seconds / 60);
}

}  // namespace tandem::netsim
