#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/support/world_run.h"

namespace tandem::test {

using netsim::Fault;
using What = server::AuditEvent::What;

/// A world, and what is always judged: forces, ledgers, tanks and roles by its own oracles; here steps of force and audit lines.
struct Life {
  explicit Life(netsim::WorldSetup setup) {
    auto made = netsim::World::make(setup);
    if (!made) throw std::runtime_error(made.error());
    world = std::move(*made);
    world->on_audit = [this](const server::AuditEvent& e) { ++audit[e.what]; };
    steps.resize(world->scene().seats.size());
    before.resize(steps.size(), hal::Vec3::Zero());
  }
  bool step() {
    const bool goes_on = world->step();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const hal::Vec3 f = world->device(i).state().f_out;
      steps[i] = std::max(steps[i], (f - before[i]).norm());
      before[i] = f;
    }
    return goes_on;
  }
  /// Up to `end` of network time.
  void until(Duration end) {
    while (at() < end && step()) {}
  }
  /// How long from now on until `reached`; at most `most`.
  Duration time_to(const std::function<bool()>& reached, Duration most) {
    const Duration begin = at();
    while (!reached() && at() - begin < most) step();
    return at() - begin;
  }
  [[nodiscard]] Duration at() const { return world->now() - Time{}; }
  [[nodiscard]] bool active(std::size_t i) const { return world->seat(i) != nullptr && world->seat(i)->gate().active(); }
  [[nodiscard]] double alpha(std::size_t i) const { return world->session().tool(0).authority.alpha(i); }
  [[nodiscard]] wire::SessionState state() const { return world->session().state(); }
  void forget_steps() { std::ranges::fill(steps, 0.0); }
  void expect_nothing_broken() const {
    EXPECT_EQ(world->trouble(), "");
    for (const auto& v : world->violations().list()) EXPECT_TRUE(v.expected) << v.invariant << " " << v.seat << " at " << v.at_s;
  }

  std::unique_ptr<netsim::World> world;
  std::map<What, int> audit;
  std::vector<double> steps;  ///< largest change of a delivered force within a tick, by seat [N]
  std::vector<hal::Vec3> before;
};

/// Two hands press the tool against a wall from 3 s on; both lead.
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

inline netsim::WorldSetup with(SceneSpec scene, std::vector<Fault> faults = {}) {
  netsim::WorldSetup setup{.scene = std::move(scene)};
  setup.faults = std::move(faults);
  return setup;
}

}  // namespace tandem::test
