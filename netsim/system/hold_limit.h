#pragma once

#include <algorithm>

#include "proto/spec/scene_spec.h"

namespace tandem::netsim {

/// Longest time between two datagrams of a seat in a scene with `send` [s]; 0 without. The checkers compute it from
/// the scene by themselves: the value of the program that they judge may be wrong.
[[nodiscard]] inline double hold_limit(const SceneSpec& scene, double tick) noexcept {
  const SendSpec& send = scene.send;
  if (!send.is_on()) return 0;
  const double by_rate = send.rate > 0 ? 1 / send.rate + tick : 0;
  if (!send.dead_band) return by_rate;
  return std::max(by_rate, send.heartbeat > 0 ? send.heartbeat : heartbeat_max(scene.gate, scene.channel.law));
}

}  // namespace tandem::netsim
