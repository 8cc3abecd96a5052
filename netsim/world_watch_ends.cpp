#include <algorithm>
#include <cmath>
#include <utility>

#include "netsim/world_watch.h"

/// What must hold at each end of a channel: accounts, steps of its reference, and that it does not starve.
namespace tandem::netsim {

namespace {

constexpr double kStarvedMax = 0.3;                     // [s]
constexpr double kAside = 0.002, kLeash = 0.98;         // [m] of a target that is reached; share of the motor's pull
constexpr std::uint64_t kEmptyNj = 10'000;              // [nJ] less than any step of a reference costs
constexpr double kTogether = 1e-5;                      // [m] the session has no distance left to close between hand and tool
constexpr double kRecovered = 0.5;                      // share of the initial energy that an account has again
constexpr double kLeads = 0.5;                          // share of authority of who moves the tool and is not moved by it
/// A person is taken to speed up by at most 0.35 m/s^2 for the 265 ms that are ever predicted, and a tool goes to a better prediction by at most
/// 150 mm/s, where a scene's approach speed is less.
constexpr double kGainsSpeed = 0.35 * 0.265 + 0.15;
/// What leads a follower moves faster than the others by so much while they speed up.
constexpr double kFollowGainsSpeed = 0.04;
constexpr double kHandSlack = 5e-3;                     // [J] rounding of readings over a session; measured: below 2.2 mJ in 700 sessions

}  // namespace

/// Most that the gate of this hand may give [N].
double WorldWatch::motor_max(std::size_t i, const WorldStation& station) const noexcept {
  double most = scene_->gate.force_max;
  for (std::size_t a = 0; a < station.device().caps().tip_axes; ++a) most = std::min(most, station.device().caps().axis[a].peak.value_or(most));
  return share(i) * most;
}

/// What a hand was given in its whole session, by what the motor did, the readings and the sums of the account. A device forgets the effort of a
/// program that sleeps, and a sensor that lies hides the way: what the motor gave beyond effort times reading is then no law's doing.
void WorldWatch::check_hand(std::size_t i, const WorldStation& station) {
  Seat::Hand& hand = seats_[i].hand;
  const client::Seat* const seat = station.seat();
  hand.worked += station.worked_now();
  hand.lied |= station.misread_now() || station.suffers(Fault::Kind::kFrozen, station.served_at());
  ++hand.ticks;
  if (seat == nullptr || !station.served_now()) return;
  const AxisArray effort = hand.effort, q = hand.q;
  double by_readings = 0;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    hand.effort[a] = seat->effort()[a];
    hand.q[a] = seat->sample().telemetry.x[a];
    by_readings += effort[a] * (hand.q[a] - q[a]);
  }
  HandEnergy::Look look{.seat = seat, .motor_max = motor_max(i, station), .worked = hand.worked};
  if (hand.lied || hand.ticks > 1) look.unknown = std::max(0.0, hand.worked - by_readings);
  look.program_anew = std::exchange(hand.starts, station.starts()) != station.starts();
  look.account_anew = std::exchange(hand.joins, station.joins()) != station.joins();
  hand.worked = 0;
  hand.ticks = 0;
  hand.lied = false;
  const double excess = hand.energy.judge(look);
  if (excess > kHandSlack) note("hand_energy", i);
}

/// What the server's end of a seat's spring hangs on: the tool; of a slave, where it is to go.
AxisArray WorldWatch::hung_on(std::size_t i, std::size_t tool, const server::Session& session) const noexcept {
  AxisArray x = session.tool(tool).position();
  if (scene_->seats[i].kind == SeatKind::kSlave)
    for (std::size_t a = 0; a < scene_->dof; ++a) x[a] = session.tool(tool).slave_goal(a, session.seat(i).end().state().k[a]);
  return x;
}

/// Hand minus tool, where the tool is what one seat follows; else 0, and nothing is judged that needs it.
AxisArray WorldWatch::offset_of(std::size_t i, const server::Session& session) const noexcept {
  AxisArray offset{};
  const bool hears_of_hands = scene_->channel.law == LawKind::kReplica && scene_->seats[i].kind == SeatKind::kMaster;
  if (hears_of_hands || (scene_->seats[i].kind != SeatKind::kSlave && scene_->tools.size() != 1)) return offset;
  const std::size_t tool = scene_->seats[i].kind == SeatKind::kSlave ? scene_->seats[i].tool : 0;
  const AxisArray x = hung_on(i, tool, session);
  for (std::size_t a = 0; a < scene_->dof; ++a) offset[a] = session.seat(i).tx.port.x[a] - x[a];
  return offset;
}

/// One end for all tools, or one for each: of hands of law `replica`.
void WorldWatch::check_server_ends(std::size_t i, const server::Session& session, const client::Seat* seat, bool slave) {
  const server::SeatPort& port = session.seat(i);
  const bool predicts = scene_->channel.law == LawKind::kReplica && !slave;
  for (std::size_t k = 0; k < port.ends(); ++k) {
    End& before = seats_[i].server[k];
    const std::size_t tool = slave ? scene_->seats[i].tool : k;
    EndLook look{port.heard_of(tool), hung_on(i, tool, session), before.x, offset_of(i, session), seat != nullptr};
    if (predicts) look.gains_speed = kGainsSpeed;
    for (std::size_t a = 0; a < scene_->dof; ++a) look.rx.x[a] -= look.offset[a];  // as the tool sees it
    check_end(i, port.end(tool), before, seat ? seat->setup().axis_scale : AxisArray{1, 1, 1, 1, 1, 1, 1}, look);
  }
}

/// A master's reference moves against the virtual mass as the tick before left it, a slave's against this tick's reading.
void WorldWatch::check_client_ends(std::size_t i, const client::Seat& seat, const server::Session& session, bool slave) {
  Seat& s = seats_[i];
  for (std::size_t k = 0; k < seat.ties(); ++k) {
    AxisArray x = seat.told_of(k).x;
    if (const control::VirtualTool* const copy = seat.coupling().copy(k))
      for (std::size_t a = 0; a < scene_->dof; ++a) x[a] = copy->x(a);
    check_end(i, seat.channel(k), s.client[k], seat.setup().axis_scale,
              {seat.told(k).port, x, slave ? x : s.client[k].x, offset_of(i, session), s.was_active && seat.gate().active(),
               scene_->channel.law == LawKind::kReplica && !slave ? kFollowGainsSpeed : 0});
  }
}

void WorldWatch::check_end(std::size_t i, const control::ChannelEnd& end, End& before, const AxisArray& scale, const EndLook& look) {
  const control::EndState& state = end.state();
  const control::Promises promises = end.promises();
  const auto& [rx, x, hung, offset, steady, gains_speed] = look;
  End now{.known = true, .ref = state.ref, .x = x, .k = state.k, .in = {}, .received = {}, .starved = {}, .home = before.home};
  const double dt = 1 / scene_->tick_hz;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    const control::EnergyLedger& ledger = end.ledger(a);
    now.in[a] = ledger.in_nj();
    now.received[a] = ledger.received_nj();
    if (!ledger.holds()) note("ledger", i, !promises.ledger);
    if (!before.known || !steady) continue;
    const bool anew = ledger.in_nj() == 0 && ledger.received_nj() == 0;  // a client took the seat: a new account
    if (!anew && (now.in[a] < before.in[a] || now.received[a] < before.received[a])) note("energy_monotone", i, !promises.ledger);
    const double was = std::abs(before.ref[a] - hung[a]), is = std::abs(now.ref[a] - hung[a]);
    const double step = (std::abs(rx.v[a]) + gains_speed + scene_->channel.v_app / std::sqrt(scale[a])) * dt;
    const bool rested = now.ref[a] == x[a] || now.ref[a] == before.x[a];  // engaged anew, without elongation
    if (is > was && !rested && std::abs(now.ref[a] - before.ref[a]) > step * (1 + 1e-9) + 1e-12)
      note("approach", i, !promises.bounded_step);
  }
  if (ordinary_ && alpha_[0][mover_] >= kLeads && steady && before.known) check_starvation(i, end, now, before, scale, look);
  before = now;
}

/// A reference that news, hand and motor would let move, and that stays where it is: nothing but an empty account holds it. Told by
/// where it is, not by what the ledger says it refused.
///
/// Until hand and tool have come together after the calm, with an account that holds at least half its initial energy again, an account that
/// really is empty is excused. What parted them (an outage, a tool that fell while nobody held it) and emptied the accounts was no ordinary
/// motion. The energy that brings them together again comes from the hand, and a hand may give none: one that stands still, or strokes within
/// the stretch of its spring and takes back what it gave. A channel that lifted the tool nevertheless would give what it never took.
void WorldWatch::check_starvation(std::size_t i, const control::ChannelEnd& end, End& now, const End& before, const AxisArray& scale,
                                  const EndLook& look) {
  const double dt = 1 / scene_->tick_hz;
  const PortSample& rx = look.rx;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    const double root = std::sqrt(scale[a]);
    // The target lies between the received position, led by its age, and where the received force would hold.
    const double forced = now.x[a] + rx.f[a] / now.k[a];
    const double missing = std::max({std::min(rx.x[a], forced) - now.ref[a], now.ref[a] - std::max(rx.x[a], forced), 0.0});
    const double aside = kAside / root + scene_->channel.lead_max * std::abs(rx.v[a]);
    const bool there = missing <= aside;
    const bool met = std::abs(rx.x[a] - now.ref[a]) <= aside;
    // Beside a weak motor the way of one tick matters: what it hangs on, when the reference moved and now.
    const double pulled = std::max(std::abs(now.ref[a] - now.x[a]), std::abs(now.ref[a] - look.hung[a]));
    const bool leashed = pulled > kLeash * share(i) * scene_->gate.force_max * root / now.k[a];
    const bool walks = std::abs(now.ref[a] - before.ref[a]) > 0.5 * scene_->channel.v_app / root * dt;
    const control::EnergyLedger& ledger = end.ledger(a);
    const std::uint64_t used = ledger.out_nj() + ledger.forfeited_nj();  // by its sums, not by its verdict
    const bool empty = ledger.bound_nj() <= used + kEmptyNj;
    const bool recovered = static_cast<double>(ledger.bound_nj()) >= static_cast<double>(used) + 1e9 * kRecovered * scene_->channel.e0;
    const bool together = std::abs(look.offset[a]) <= kTogether / root;
    now.home[a] = together && (before.home[a] || (met && recovered));
    now.starved[a] = there || leashed || walks ? 0 : before.starved[a] + 1;
    if ((now.home[a] || !empty) && now.starved[a] * dt > kStarvedMax) note("starved", i);
  }
}

}  // namespace tandem::netsim
