#pragma once

#include <functional>
#include <string>
#include <vector>

#include "netsim/world.h"
#include "netsim/world_report.h"
#include "server/report.h"

namespace tandem::test {

/// A shipped scene, parsed.
[[nodiscard]] SceneSpec shipped(const std::string& name);
/// The same under law SET_POSITION, with a simulated robot at every tool, as scenes without a law had it before REPLICA was the default:
/// for what is claimed of that law. Hands that press `contact` go 19 mm beyond the wall, since three springs lie between them and it.
[[nodiscard]] SceneSpec set_position(const std::string& name);
/// Both of these: for claims about any law that promises passivity.
[[nodiscard]] std::vector<SceneSpec> under_both_laws(const std::string& name);

[[nodiscard]] netsim::SimpleNetwork delayed(double delay_ms, double jitter_ms = 0, double loss_percent = 0);
/// Adds outages of `length_s` every `period_s`, both directions.
[[nodiscard]] netsim::SimpleNetwork with_outages(netsim::SimpleNetwork net, double length_s, double period_s);

struct RunResult {
  server::RunReport report;
  std::string trouble;
  double hand_speed_max = 0;       ///< of any master's true tip, deviations aside [m/s]
  double force_step_max = 0;       ///< largest change of a delivered force between two ticks [N]
  double authority_error_max = 0;  ///< |sum - 1| while not held
  std::uint64_t ticks = 0;
  [[nodiscard]] const server::SeatReport& seat(const std::string& name) const;
  [[nodiscard]] const server::SeatMetrics& phase(const std::string& phase, const std::string& seat) const;
};

/// Called once per tick, after the world moved.
using Observer = std::function<void(netsim::World&)>;

/// Runs a scene to its end in virtual time and judges it.
[[nodiscard]] RunResult run(const SceneSpec& scene, const netsim::SimpleNetwork& net = {}, std::uint64_t seed = 1,
                            const Observer& observer = {});

/// 1 with TANDEM_COUNTS=reduced or unset, more with full and nightly; printed once by whoever scales with it.
[[nodiscard]] unsigned count_factor();

}  // namespace tandem::test
