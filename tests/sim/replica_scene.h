#pragma once

#include "tests/support/simulation_run.h"

namespace tandem::test {

/// Returns a scene with one hand that presses along x against a surface at 0. Its depth is `shallow` from 3 s on and
/// `deep` from 6 s on [m].
inline SceneSpec pressing(double k_surface, double shallow, double deep) {
  SceneSpec scene = shipped("contact");
  scene.seats[0].hand.trajectory.waypoints = {
      {0.5, {-0.02, 0, 0}}, {2, {shallow, 0, 0}}, {5, {shallow, 0, 0}}, {6, {deep, 0, 0}}};
  scene.seats[1].hand = {};
  scene.seats[1].hand.model = HandModel::kRelaxed;
  scene.seats[1].hand.b = 2;
  scene.seats[1].hand.m = 0.1;
  scene.tools[0].environment.wall = WallSpec{.axis = 0, .at = 0, .k = k_surface, .b = 5, .from_below = true};
  scene.timeline.clear();
  scene.phases = {{"all", 0, 12, false}};
  scene.duration = 12;
  return scene;
}

}  // namespace tandem::test
