#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/support/simulation_run.h"

namespace tandem::test {

using netsim::Fault;
using What = server::AuditEvent::What;

/// Runs a simulation and checks what every test requires. The simulation's own checkers judge forces, ledgers, tanks
/// and roles; the driver records steps of force and audit events.
struct SessionDriver {
  explicit SessionDriver(netsim::SimulationConfig setup) {
    auto made = netsim::Simulation::make(setup);
    if (!made) throw std::runtime_error(made.error());
    simulation = std::move(*made);
    simulation->on_audit = [this](const server::AuditEvent& e) { ++audit[e.what]; };
    steps.resize(simulation->scene().seats.size());
    before.resize(steps.size(), hal::Vec3::Zero());
  }
  bool step() {
    const bool goes_on = simulation->step();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const hal::Vec3 f = simulation->device(i).state().f_out;
      steps[i] = std::max(steps[i], (f - before[i]).norm());
      before[i] = f;
    }
    return goes_on;
  }
  /// Runs until the network time `end`.
  void until(Duration end) {
    while (at() < end && step()) {
    }
  }
  /// Returns the time until `reached` is true; at most `most`.
  Duration time_to(const std::function<bool()>& reached, Duration most) {
    const Duration begin = at();
    while (!reached() && at() - begin < most) step();
    return at() - begin;
  }
  [[nodiscard]] Duration at() const { return simulation->now() - Time{}; }
  [[nodiscard]] bool active(std::size_t i) const {
    return simulation->seat(i) != nullptr && simulation->seat(i)->gate().active();
  }
  [[nodiscard]] double alpha(std::size_t i) const { return simulation->session().tool(0).authority.alpha(i); }
  [[nodiscard]] wire::SessionState state() const { return simulation->session().state(); }
  void forget_steps() { std::ranges::fill(steps, 0.0); }
  void expect_nothing_broken() const {
    EXPECT_EQ(simulation->trouble(), "");
    for (const auto& v : simulation->violations().list())
      EXPECT_TRUE(v.expected) << v.invariant << " " << v.seat << " at " << v.at_s;
  }

  std::unique_ptr<netsim::Simulation> simulation;
  std::map<What, int> audit;
  std::vector<double> steps;  ///< largest change of a delivered force within a tick, by seat [N]
  std::vector<hal::Vec3> before;
};

/// Returns a scene in which two hands lead the tool and press it against a wall from 3 s on.
inline SceneSpec contact(double trainer = 0.5) {
  SceneSpec scene = set_position("contact");
  scene.seats[0].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}}, {1.5, {0, 0, 0}}, {3, {0.012, 0, 0}}};
  scene.seats[1].hand = scene.seats[0].hand;
  scene.authority[0].alpha = {trainer, 1 - trainer};
  scene.timeline.clear();
  scene.duration = 60;
  scene.phases = {{"press", 3, 60, false}};
  return scene;
}

inline netsim::SimulationConfig with(SceneSpec scene, std::vector<Fault> faults = {}) {
  netsim::SimulationConfig setup{.scene = std::move(scene)};
  setup.faults = std::move(faults);
  return setup;
}

}  // namespace tandem::test
