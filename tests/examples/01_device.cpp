// A device written by hand: the driver of a motorised slider with one axis. ServoCore adds what all drivers share:
// phases, guard, soft start. A spring then pulls the slider, in virtual time.
//
// Prints:
//   100 ms: 4.1 mm
//   1100 ms: 50.0 mm
#include <tandem/hal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace tandem::hal;

struct SliderDriver final : Driver {
  SliderDriver() {
    caps_.joints = caps_.tip_axes = 1;
    caps_.prismatic = true;
    caps_.axis[0].peak = 3.0;
  }
  const DeviceId& id() const noexcept override { return id_; }
  const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp&) override { return {}; }  // here: firmware, calibration, first reading
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept override {
    // A real driver sends the counts and reads the encoder; this one is a model: 0.1 kg, 5 N s/m, 1 kHz.
    const double force = 1e-3 * std::lround(1e3 * std::clamp(command.effort[0], -3.0, 3.0));  // motor counts of 1 mN
    v_ += (force - 5 * v_) / 0.1 * 1e-3;
    x_ += v_ * 1e-3;
    state.q[0] = state.x[0] = 1e-5 * std::lround(x_ / 1e-5);  // encoder steps of 10 um
    state.dq[0] = state.dx[0] = v_;
    state.J(0, 0) = 1;
    state.tau_out[0] = state.f_out[0] = force;
    state.sampled_at = tandem::Time{std::chrono::milliseconds(++state.seq)};
    return Exchange::kFresh;
  }
  void send_zeros() noexcept override {}
  DeviceId id_{"slider", "1"};
  DeviceCaps caps_;
  double x_ = 0, v_ = 0;
};

struct Spring final : ServoClient, BringUp {
  Command tick(const State& state) noexcept override {
    const double force = 200 * (0.05 - state.x[0]);  // [N]
    return {state.seq, state.sampled_at + tandem::kCommandLifetimeMin, CommandKind::kJointEffort, {force}};
  }
  void lost(Errc) noexcept override {}
  void progress(std::string_view, double) override {}
  bool cancelled() const noexcept override { return false; }
};

int main() {
  Spring spring;
  ServoCore core{std::make_unique<SliderDriver>()};
  if (!core.bring_up(spring) || !core.enable()) return 1;
  for (int ms = 1; ms <= 1100; ++ms) {
    core.step(tandem::Time{std::chrono::milliseconds(ms)}, spring);
    if (ms % 1000 == 100) std::printf("%d ms: %.1f mm\n", ms, 1e3 * core.state().x[0]);
  }
}
