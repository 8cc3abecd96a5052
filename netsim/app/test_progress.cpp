#include "netsim/app/test_progress.h"

#include <unistd.h>

#include <cmath>

#include "common/base/format.h"

namespace tandem::netsim {

TestProgress::TestProgress(bool quiet) : line_(quiet || isatty(STDERR_FILENO) == 0) {}

void TestProgress::show(const io::JobProgress& p, std::size_t failed) {
  if (!line_.wanted()) return;
  line_.show(format("%3.0f %%  %zu of %zu seeds done, %zu running, %zu failed", 100 * p.share, p.done, p.count,
                    p.running, failed) +
             left_text(p));
}

std::string left_text(const io::JobProgress& p) {
  if (!std::isfinite(p.left_s) || p.done >= p.count) return {};
  return p.left_s < 100 ? format(", about %.0f s left", p.left_s) : format(", about %.1f min left", p.left_s / 60);
}

}  // namespace tandem::netsim
