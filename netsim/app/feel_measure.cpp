#include "netsim/app/feel_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kTroublesShown = 5;

std::string_view name_of(Probe probe) { return std::ranges::find(kProbes, probe, &ProbeName::probe)->name; }

}  // namespace

void measure_feel(const FeelSetup& setup, const FeelOptions& options, FeelReport& report) {
  const std::size_t probes = options.probes.size();
  const auto results =
      io::run_jobs(options.seeds * probes,
                   [&](std::size_t i, io::JobProgressReporter) {
                     return to_bytes(run_probe(options.probes[i % probes], setup, options.first + i / probes));
                   },
                   {.jobs = options.jobs, .stop_fd = options.stop_fd, .watch = [&](const io::JobProgress& p) {
                      report.wall_s = p.elapsed_s;
                      if (options.on_progress) options.on_progress(p);
                    }});
  report.probes = options.probes;
  double one_way = 0, counted = 0;
  std::size_t troubles = 0;
  const auto trouble = [&](std::uint64_t seed, Probe probe, const std::string& why) {
    if (++troubles <= kTroublesShown)
      report.troubles.push_back(
          format("seed %llu, probe %s: ", static_cast<unsigned long long>(seed), std::string(name_of(probe)).c_str()) +
          why);
  };
  for (std::uint64_t s = 0; s < options.seeds; ++s) {
    FeelSeed seed{.seed = options.first + s, .values = {}};
    Exposure exposure;
    bool whole = true;
    for (std::size_t k = 0; k < probes; ++k) {
      const io::JobResult& job = results[s * probes + k];
      if (job.state != io::JobResult::State::kDone) {
        whole = false;
        if (job.state == io::JobResult::State::kCrashed) trouble(seed.seed, options.probes[k], job.reason);
        continue;
      }
      const ProbeResult one = probe_result_from_bytes(job.text);
      if (!one.trouble.empty()) trouble(seed.seed, options.probes[k], one.trouble);
      seed.values.insert(one.values.begin(), one.values.end());
      exposure.add(one.exposure);
      report.lived_s += one.lived_s;
      if (std::isfinite(one.one_way_s)) {
        one_way += one.one_way_s;
        counted += 1;
      }
    }
    if (!whole) {
      report.interrupted = true;
      continue;  // partial results are left out, because means are of whole seeds
    }
    if (exposure.s > 0) put_exposure(exposure, seed.values);
    report.seeds.push_back(std::move(seed));
  }
  if (troubles > kTroublesShown) report.troubles.push_back(format("and %zu more", troubles - kTroublesShown));
  report.one_way_s = counted > 0 ? one_way / counted : std::numeric_limits<double>::quiet_NaN();
  report.numbers = summarised(report.seeds);
}

}  // namespace tandem::netsim
