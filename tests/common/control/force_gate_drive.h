#pragma once

#include <cmath>

#include "common/base/time.h"
#include "common/control/force_gate.h"

namespace tandem::control::test {

using namespace std::chrono_literals;

/// A gate and the input of its next tick. One axis has a wanted effort; a tick lasts 1 ms.
struct GateDrive {
  explicit GateDrive(const GateParams& p = {}) : gate(p) {
    in.now = Time{5s};
    in.engage = true;
    in.fresh = true;
    in.rtt_p99 = 2ms;
  }
  ForceGate::Output tick() {
    in.now += 1ms;
    out = gate.step(in);
    in.reset = false;
    return out;
  }
  void ticks(int n) {
    for (int i = 0; i < n; ++i) tick();
  }
  /// Runs until the gate is engaged and ramped in and the effort has reached `force` [N].
  void hold(double force) {
    in.wanted[0] = force;
    ticks(700);
  }
  ForceGate gate;
  ForceGate::Input in;
  ForceGate::Output out;
};

inline double norm(const AxisArray& f, const GateParams& p) {
  double n = 0;
  for (std::size_t a = 0; a < p.dof; ++a) n += f[a] * f[a] / p.scale[a];
  return std::sqrt(n);
}

}  // namespace tandem::control::test
