#include "netsim/system/device_guard_checker.h"

namespace tandem::netsim {
namespace {

constexpr unsigned kInvalidMax = 3;  // samples for which the last good reading is used
constexpr double kSpeedMax = 1.6;    // [m/s]
constexpr unsigned kTicksMax = 5;    // ticks within which a guard acts
constexpr double kLong = 0.2, kFar = 0.01,
                 kPull = 1;  // [s], [m], [N]: twice the limits of the guard for frozen sensors

/// Counts consecutive ticks with a condition. Returns whether they exceed `most`.
bool lasts(unsigned& ticks, bool condition, unsigned most) noexcept {
  ticks = condition ? ticks + 1 : 0;
  return ticks > most;
}

}  // namespace

void DeviceGuardChecker::check(const ObservedSeat& seat) {
  const SimulatedClient& client = seat.client;
  const control::ForceGate& gate = seat.core().gate();
  if (lasts(invalid_readings_, client.invalid_reading(), kInvalidMax) &&
      (gate.phase() != control::GatePhase::kFault || seat.force() != 0))
    seat.violated("bad_reading_faults");
  check_frozen_sensor(seat);
  const bool readable = gate.active() && !client.invalid_reading();
  if (lasts(fast_, readable && !seat.frozen() && client.device().state().dx.norm() > kSpeedMax, kTicksMax))
    seat.violated("over_speed");
  if (lasts(hot_, readable && client.faults().active(Fault::Kind::kHot, client.last_run()), kTicksMax))
    seat.violated("over_temperature");
}

/// Checks that the client releases a hand whose reading stays frozen while the reference moves far and the pull
/// changes.
void DeviceGuardChecker::check_frozen_sensor(const ObservedSeat& seat) {
  const client::Seat& core = seat.core();
  const AxisArray ref = core.motion_scale().position_at_hand(core.tools().end(0).state().ref);
  const AxisArray& scale = core.setup().axis_scale;
  const Time now = seat.client.last_run();
  const bool frozen = !seat.slave() && core.gate().active() && seat.frozen() && !seat.client.invalid_reading();
  if (!frozen || !frozen_.on) frozen_ = {now, ref, core.effort(), frozen};
  if (!frozen || seconds(now - frozen_.since) < kLong) return;
  double way = 0;
  AxisArray pull{};
  for (std::size_t a = 0; a < seat.scene.dof; ++a) {
    way += (ref[a] - frozen_.ref[a]) * (ref[a] - frozen_.ref[a]) * scale[a];
    pull[a] = core.effort()[a] - frozen_.effort[a];
  }
  if (way > kFar * kFar && tip_norm(pull, scale, seat.scene.dof) > kPull) seat.violated("frozen_sensor");
}

}  // namespace tandem::netsim
