#include "netsim/system/hand_energy_checker.h"

#include <algorithm>
#include <utility>

namespace tandem::netsim {
namespace {

constexpr double kSlack = 5e-3;  // [J], rounding of readings over a session; measured: below 2.2 mJ in 700 sessions

/// Returns the largest force that the gate of this hand may pass [N].
double motor_max(const ObservedSeat& seat) noexcept {
  const hal::DeviceCaps& caps = seat.client.device().caps();
  double most = seat.scene.gate.force_max;
  for (std::size_t a = 0; a < caps.tip_axes; ++a) most = std::min(most, caps.axis[a].peak.value_or(most));
  return seat.force_share() * most;
}

}  // namespace

void HandEnergyChecker::check(const ObservedSeat& seat) {
  const SimulatedClient& client = seat.client;
  motor_work_ += client.motor_work();
  sensor_failed_ |= client.invalid_reading() || seat.frozen();
  ++ticks_;
  if (client.seat() == nullptr || !client.ran_in_tick()) return;
  double by_readings = 0;
  for (std::size_t a = 0; a < seat.scene.dof; ++a) {
    const double x = seat.core().sample().telemetry.x[a];
    by_readings += std::exchange(effort_[a], seat.core().effort()[a]) * (x - std::exchange(x_[a], x));
  }
  HandEnergyBalance::Sample sample{.seat = client.seat(), .motor_max = motor_max(seat), .motor_work = motor_work_};
  if (sensor_failed_ || ticks_ > 1) sample.unaccountable_work = std::max(0.0, motor_work_ - by_readings);
  sample.program_restarted = std::exchange(starts_, client.program().starts()) != client.program().starts();
  sample.account_restarted = std::exchange(joins_, client.program().joins()) != client.program().joins();
  motor_work_ = 0;
  ticks_ = 0;
  sensor_failed_ = false;
  if (balance_.excess(sample) > kSlack) seat.violated("hand_energy");
}

}  // namespace tandem::netsim
