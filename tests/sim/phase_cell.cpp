#include "tests/sim/phase_cell.h"

#include <stdexcept>

#include "netsim/feel/meters.h"
#include "tests/support/simulation_run.h"

namespace tandem::test {

double loop_of(const netsim::FeelSetup& setup, std::uint64_t seed) {
  constexpr double kFrom = 2, kEnd = 4;  // [s]
  const netsim::DrawnHand hand{setup.hands, seed, 0};
  const netsim::FeelTrace trace = netsim::run_probe(setup, {.length = kEnd, .hands = {{netsim::relaxed(hand)}}}, seed);
  if (!trace.trouble.empty()) throw std::runtime_error(trace.trouble);
  return netsim::mean(trace.part(trace.hands[0].loop, kFrom, kEnd));
}

netsim::FeelValues felt(const SceneSpec& scene, double one_way_ms, netsim::ClientPhases phases, std::uint64_t seed) {
  netsim::FeelSetup setup{.scene = scene, .network = netsim::link_from(delayed(one_way_ms)), .phases = phases};
  netsim::FeelValues values{{"loop_s", loop_of(setup, seed)}};
  for (const netsim::Probe probe : {netsim::Probe::kFree, netsim::Probe::kPress, netsim::Probe::kRest}) {
    netsim::ProbeResult result = netsim::run_probe(probe, setup, seed);
    if (!result.trouble.empty()) throw std::runtime_error(result.trouble);
    values.merge(result.values);
  }
  return values;
}

}  // namespace tandem::test
