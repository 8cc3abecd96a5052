#include <algorithm>
#include <cmath>
#include <utility>

#include "netsim/system/invariant_checker.h"

/// Checks of each end of a channel: energy accounts, steps of its reference, and starvation.
namespace tandem::netsim {

namespace {

constexpr double kStarvedMax = 0.3;              // [s]
constexpr double kAside = 0.002, kLeash = 0.98;  // [m] from a target that counts as reached; share of the motor's force
constexpr std::uint64_t kEmptyNj = 10'000;       // [nJ], less than the cost of any step of a reference
constexpr double kTogether = 1e-5;               // [m], at which hand and tool count as together
constexpr double kRecovered = 0.5;               // share of the initial energy at which an account counts as refilled
constexpr double kLeads = 0.5;  // share of authority of a seat that moves the tool and is not moved by it
/// Speed that a prediction may add [m/s]: a user accelerates by at most 0.35 m/s^2 over the longest prediction of 265
/// ms. A tool moves to a better prediction by at most 150 mm/s where a scene's approach speed is less.
constexpr double kFollowerSpeedGain = 0.35 * 0.265 + 0.15;
/// Speed by which a follower's tool may exceed the others while they accelerate [m/s].
constexpr double kFollowGainsSpeed = 0.04;
constexpr double kHandSlack = 5e-3;  // [J], rounding of readings over a session; measured: below 2.2 mJ in 700 sessions

}  // namespace

/// Returns the largest force that the gate of this hand may pass [N].
double InvariantChecker::motor_max(std::size_t i, const SimulatedClient& station) const noexcept {
  double most = scene_->gate.force_max;
  for (std::size_t a = 0; a < station.device().caps().tip_axes; ++a)
    most = std::min(most, station.device().caps().axis[a].peak.value_or(most));
  return share(i) * most;
}

/// Checks the energy that a hand receives in its whole session, from the motor's work, the readings and the account's
/// sums. A device drops the effort of a paused program, and a wrong sensor hides motion. In both cases the excess over
/// effort times reading is not charged to the law.
void InvariantChecker::check_hand(std::size_t i, const SimulatedClient& station) {
  SeatState::Hand& hand = seats_[i].hand;
  const client::Seat* const seat = station.seat();
  hand.motor_work += station.motor_work();
  hand.sensor_invalid |= station.invalid_reading() || station.has_fault(Fault::Kind::kFrozen, station.last_run());
  ++hand.ticks;
  if (seat == nullptr || !station.ran_in_tick()) return;
  const AxisArray effort = hand.effort, q = hand.q;
  double by_readings = 0;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    hand.effort[a] = seat->effort()[a];
    hand.q[a] = seat->sample().telemetry.x[a];
    by_readings += effort[a] * (hand.q[a] - q[a]);
  }
  HandEnergyChecker::Sample look{.seat = seat, .motor_max = motor_max(i, station), .motor_work = hand.motor_work};
  if (hand.sensor_invalid || hand.ticks > 1) look.unaccountable_work = std::max(0.0, hand.motor_work - by_readings);
  look.program_restarted = std::exchange(hand.starts, station.starts()) != station.starts();
  look.account_restarted = std::exchange(hand.joins, station.joins()) != station.joins();
  hand.motor_work = 0;
  hand.ticks = 0;
  hand.sensor_invalid = false;
  const double excess = hand.energy.check(look);
  if (excess > kHandSlack) note("hand_energy", i);
}

/// Returns the position that the server's end of a seat's spring is coupled to: the tool, or a slave's target.
AxisArray InvariantChecker::coupled_position(std::size_t i, std::size_t tool,
                                             const server::Session& session) const noexcept {
  AxisArray x = session.tool(tool).position();
  if (scene_->seats[i].kind == SeatKind::kSlave)
    for (std::size_t a = 0; a < scene_->dof; ++a)
      x[a] = session.tool(tool).port().slave_goal(a, session.seat(i).end().state().k[a]);
  return x;
}

/// Returns hand minus tool where one seat moves the tool. Otherwise returns 0, and checks that need the offset are
/// skipped.
AxisArray InvariantChecker::offset_of(std::size_t i, const server::Session& session) const noexcept {
  AxisArray offset{};
  const bool hears_of_hands = scene_->channel.law == LawKind::kReplica && scene_->seats[i].kind == SeatKind::kMaster;
  if (hears_of_hands || (scene_->seats[i].kind != SeatKind::kSlave && scene_->tools.size() != 1)) return offset;
  const std::size_t tool = scene_->seats[i].kind == SeatKind::kSlave ? scene_->seats[i].tool : 0;
  const AxisArray x = coupled_position(i, tool, session);
  for (std::size_t a = 0; a < scene_->dof; ++a) offset[a] = session.seat(i).tx.port.x[a] - x[a];
  return offset;
}

/// Checks the server's ends of a seat: one per tool for hands of law `replica`, else one in all.
void InvariantChecker::check_server_ends(std::size_t i, const server::Session& session, const client::Seat* seat,
                                         bool slave) {
  const server::SeatEndpoint& port = session.seat(i);
  const bool predicts = scene_->channel.law == LawKind::kReplica && !slave;
  for (std::size_t k = 0; k < port.ends(); ++k) {
    EndState& before = seats_[i].server[k];
    const std::size_t tool = slave ? scene_->seats[i].tool : k;
    EndSample look{port.last_sample(tool), coupled_position(i, tool, session), before.x, offset_of(i, session),
                   seat != nullptr};
    if (predicts) look.gains_speed = kFollowerSpeedGain;
    for (std::size_t a = 0; a < scene_->dof; ++a) look.rx.x[a] -= look.offset[a];  // as the tool receives it
    check_end(i, port.end(tool), before, seat ? seat->setup().axis_scale : AxisArray{1, 1, 1, 1, 1, 1, 1}, look);
  }
}

/// Checks the client's ends of a seat. A master's reference moves against the virtual mass of the tick before, a
/// slave's reference against this tick's reading.
void InvariantChecker::check_client_ends(std::size_t i, const client::Seat& seat, const server::Session& session,
                                         bool slave) {
  SeatState& s = seats_[i];
  for (std::size_t k = 0; k < seat.tools().size(); ++k) {
    AxisArray x = seat.sent(k).x;
    if (const control::VirtualTool* const copy = seat.coupling().tool_copy(k))
      for (std::size_t a = 0; a < scene_->dof; ++a) x[a] = copy->x(a);
    check_end(i, seat.tools().end(k), s.client[k], seat.setup().axis_scale,
              {seat.tools().received(k).port, x, slave ? x : s.client[k].x, offset_of(i, session),
               s.was_active && seat.gate().active(),
               scene_->channel.law == LawKind::kReplica && !slave ? kFollowGainsSpeed : 0});
  }
}

void InvariantChecker::check_end(std::size_t i, const control::ChannelEnd& end, EndState& before,
                                 const AxisArray& scale, const EndSample& look) {
  const control::EndState& state = end.state();
  const control::Guarantees promises = end.guarantees();
  const auto& [rx, x, hung, offset, steady, gains_speed] = look;
  EndState now{.known = true,
               .ref = state.ref,
               .x = x,
               .k = state.k,
               .in = {},
               .received = {},
               .starved = {},
               .home = before.home};
  const double dt = 1 / scene_->tick_hz;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    const control::EnergyLedger& ledger = end.ledger(a);
    now.in[a] = ledger.in_nj();
    now.received[a] = ledger.received_nj();
    if (!ledger.holds()) note("ledger", i, !promises.ledger);
    if (!before.known || !steady) continue;
    const bool anew = ledger.in_nj() == 0 && ledger.received_nj() == 0;  // a client took the seat: a new account
    if (!anew && (now.in[a] < before.in[a] || now.received[a] < before.received[a]))
      note("energy_monotone", i, !promises.ledger);
    const double was = std::abs(before.ref[a] - hung[a]), is = std::abs(now.ref[a] - hung[a]);
    const double step = (std::abs(rx.v[a]) + gains_speed + scene_->channel.v_app / std::sqrt(scale[a])) * dt;
    const bool rested = now.ref[a] == x[a] || now.ref[a] == before.x[a];  // engaged again, without elongation
    if (is > was && !rested && std::abs(now.ref[a] - before.ref[a]) > step * (1 + 1e-9) + 1e-12)
      note("approach", i, !promises.bounded_step);
  }
  if (ordinary_ && alpha_[0][moving_seat_] >= kLeads && steady && before.known)
    check_starvation(i, end, now, before, scale, look);
  before = now;
}

/// Checks for starvation: a reference stays in place although received data, hand and motor would let it move. Only an
/// empty account may cause that. The check uses positions, not the refusals that the ledger reports.
///
/// An account that really is empty is excused until hand and tool have come together in the recovery phase. Its account
/// must then hold at least half its initial energy. An outage, or a tool that fell without a participant, parted them
/// and emptied the accounts; that was no ordinary motion. The energy that brings them together comes from the hand, and
/// a hand may supply none. Examples are a resting hand, and a hand that strokes within the stretch of its spring and
/// takes back its energy. A channel that lifted the tool nevertheless would deliver energy that it never received.
void InvariantChecker::check_starvation(std::size_t i, const control::ChannelEnd& end, EndState& now,
                                        const EndState& before, const AxisArray& scale, const EndSample& look) {
  const double dt = 1 / scene_->tick_hz;
  const PortSample& rx = look.rx;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    const double root = std::sqrt(scale[a]);
    // The target lies between the received position, extrapolated by its age, and the position at which the received
    // force would hold.
    const double forced = now.x[a] + rx.f[a] / now.k[a];
    const double missing =
        std::max({std::min(rx.x[a], forced) - now.ref[a], now.ref[a] - std::max(rx.x[a], forced), 0.0});
    const double aside = kAside / root + scene_->channel.lead_max * std::abs(rx.v[a]);
    const bool there = missing <= aside;
    const bool met = std::abs(rx.x[a] - now.ref[a]) <= aside;
    // With a weak motor the motion of one tick matters: `pulled` covers the coupled position before and after it.
    const double pulled = std::max(std::abs(now.ref[a] - now.x[a]), std::abs(now.ref[a] - look.coupled[a]));
    const bool clamped = pulled > kLeash * share(i) * scene_->gate.force_max * root / now.k[a];
    const bool walks = std::abs(now.ref[a] - before.ref[a]) > 0.5 * scene_->channel.v_app / root * dt;
    const control::EnergyLedger& ledger = end.ledger(a);
    const std::uint64_t used = ledger.out_nj() + ledger.forfeited_nj();  // by the ledger's sums, not by its verdict
    const bool empty = ledger.bound_nj() <= used + kEmptyNj;
    const bool recovered =
        static_cast<double>(ledger.bound_nj()) >= static_cast<double>(used) + 1e9 * kRecovered * scene_->channel.e0;
    const bool together = std::abs(look.offset[a]) <= kTogether / root;
    now.home[a] = together && (before.home[a] || (met && recovered));
    now.starved[a] = there || clamped || walks ? 0 : before.starved[a] + 1;
    if ((now.home[a] || !empty) && now.starved[a] * dt > kStarvedMax) note("starved", i);
  }
}

}  // namespace tandem::netsim
