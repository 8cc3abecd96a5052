#include "netsim/system/silence_checker.h"

#include <algorithm>

#include "common/base/command_lifetime.h"
#include "netsim/system/hold_limit.h"

namespace tandem::netsim {
namespace {

constexpr double kRampOut = 0.1;                                      // [s]
constexpr double kTankPerKg = 0.18, kTankMin = 0.02, kTankMax = 0.1;  // [J/kg], [J]
constexpr double kUnseen = 1.6e-4;  // [m] that the gate cannot see, because it measures by encoders: two of their steps

}  // namespace

void SilenceChecker::check_energy(const ObservedSeat& seat) {
  if (seat.client.seat() == nullptr || fresh_ == Time{}) return;
  if (seat.core().gate().active() && !seat.was_active) energy_.restart();
  const double later_work = seat.client.motor_work_after_run();
  energy_.add(seat.client.motor_work() - later_work);
  if (!seat.client.ran_in_tick()) return;  // its gate can act only when the program wakes up
  const double tank =
      seat.force_share() * std::clamp(kTankPerKg * seat.client.device().caps().mass.value_or(0), kTankMin, kTankMax);
  const double unseen = seat.force_share() * seat.scene.gate.force_max * kUnseen;
  const Time now = seat.client.last_run();
  const SilenceEnergy::Bound bound{.tank = tank + unseen,
                                   .step_max = seconds(command_lifetime(from_seconds(seat.tick())))};
  const double step = ran_ == Time{} ? 0 : seconds(now - ran_);
  if (!energy_.wake_up(step, bound)) seat.violated("loss_energy");
  ran_ = now;
  energy_.add(later_work);
}

void SilenceChecker::check(const ObservedSeat& seat) {
  const Time now = seat.client.last_run();
  const client::Seat& core = seat.core();
  const GateSpec& gate = seat.scene.gate;
  const bool active = core.gate().active();
  const transport::LinkTiming& link = core.link().timing();
  if (link.heard() && link.arrived() != arrived_) {
    arrived_ = link.arrived();
    limit_ = 0;
    fresh_ = now;
    // A datagram that makes the gate release also restarts the sum, except one so old that it ended the link.
    if (active || (seat.was_active && core.gate().trips() == trips_)) {
      energy_.restart();
      energy_.add(seat.client.motor_work_after_run());
    }
  }
  trips_ = core.gate().trips();
  const double half_tick = 0.5 * seat.tick();
  if (fresh_ != Time{}) {
    const double silence = seconds(now - fresh_);
    // The longest limit since the last fresh datagram applies. A client that loses authority or its server during a
    // silence releases from that moment.
    limit_ =
        std::max(limit_, seat.slave() ? gate.silence_limit
                                      : silence_limits(gate, seat.scene.channel.law, core.tools().authority()).most);
    if (active && silence > limit_ + half_tick) seat.violated("silence_ramps");
    if (silence > limit_ + kRampOut + 3 * half_tick) {
      double power = 0;  // the remaining force may brake a hand and never push it
      for (std::size_t a = 0; a < seat.scene.dof; ++a) power += core.effort()[a] * core.sample().port.v[a];
      if (power > 1e-9) seat.violated("silence_brakes");
    }
  }
  double extra =
      seat.master_of_law_replica() ? silence_limits(gate, LawKind::kReplica, core.tools().authority()).most : 0;
  if (seat.scene.send.is_on() && !seat.slave())  // each end may hold a datagram back, and sends it at its next tick
    extra += 2 * (seat.tick() + hold_limit(seat.scene, seat.tick()));
  if (active && seconds(link.loop_age(seat.client.own_time(now))) > gate.loop_age_max + extra + 1e-9)
    seat.violated("loop_age");
}

}  // namespace tandem::netsim
