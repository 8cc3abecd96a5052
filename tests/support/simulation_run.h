#pragma once

#include <functional>
#include <string>
#include <vector>

#include "netsim/system/simulation.h"
#include "netsim/system/simulation_report.h"
#include "server/report/report.h"

namespace tandem::test {

/// Returns a shipped scene, parsed.
[[nodiscard]] SceneSpec shipped(const std::string& name);
/// Returns the same scene under law SET_POSITION with a simulated robot at every tool, for tests of that law. Scenes
/// without a law had this form before REPLICA became the default. Hands that press `contact` go 19 mm beyond the wall,
/// because three springs lie between them and it.
[[nodiscard]] SceneSpec set_position(const std::string& name);
/// Returns the scene under both laws, for properties of any passive law.
[[nodiscard]] std::vector<SceneSpec> under_both_laws(const std::string& name);

[[nodiscard]] netsim::SimpleNetwork delayed(double delay_ms, double jitter_ms = 0, double loss_percent = 0);
/// Adds outages of `length_s` every `period_s`, both directions.
[[nodiscard]] netsim::SimpleNetwork with_outages(netsim::SimpleNetwork net, double length_s, double period_s);

struct RunResult {
  server::RunReport report;
  std::string trouble;
  double hand_speed_max = 0;       ///< of any master's true tip, without its scripted deviations [m/s]
  double force_step_max = 0;       ///< largest change of a delivered force between two ticks [N]
  double authority_error_max = 0;  ///< largest |sum - 1| while the tool is not braked
  std::uint64_t ticks = 0;
  [[nodiscard]] const server::SeatReport& seat(const std::string& name) const;
  [[nodiscard]] const server::SeatMetrics& phase(const std::string& phase, const std::string& seat) const;
};

/// Called once per tick, after the simulation advanced.
using Observer = std::function<void(netsim::Simulation&)>;

/// Runs a scene to its end in virtual time and evaluates it.
[[nodiscard]] RunResult run(const SceneSpec& scene, const netsim::SimpleNetwork& net = {}, std::uint64_t seed = 1,
                            const Observer& observer = {});

/// Returns 1 with TANDEM_COUNTS=reduced or unset, more with full and nightly. The calling test prints the factor once.
[[nodiscard]] unsigned count_factor();

}  // namespace tandem::test
