#pragma once

#include "tests/support/world_run.h"

namespace tandem::test {

/// A shipped scene under law `replica`, its tools without devices.
inline SceneSpec replica(const std::string& name) {
  SceneSpec scene = shipped(name);
  scene.channel.law = LawKind::kReplica;
  scene.channel.e0 = ChannelSpec{}.e0;
  for (ToolSpec& tool : scene.tools) {
    tool.is_virtual = true;
    tool.m_s = 0.02;
  }
  return scene;
}

/// One hand, alone, that presses along x against a surface at 0: at `shallow` from 3 s on and at `deep` from 6 s on [m].
inline SceneSpec pressing(double k_surface, double shallow, double deep) {
  SceneSpec scene = replica("contact");
  scene.seats[0].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}}, {2, {shallow, 0, 0}}, {5, {shallow, 0, 0}}, {6, {deep, 0, 0}}};
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
