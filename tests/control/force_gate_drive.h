#pragma once

#include <cmath>

#include "common/base/time.h"
#include "common/control/force_gate.h"

namespace tandem::control::test {

using namespace std::chrono_literals;

/// A gate and the input of its next tick; one axis pulls, time runs in milliseconds.
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
  /// Engaged, ramped in, `force` reached.
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
