#include "netsim/system/invariant_checker.h"

#include <algorithm>
#include <functional>

#include "netsim/system/role_checker.h"
#include "server/session/session_invariant_checker.h"

namespace tandem::netsim {
namespace {

constexpr double kFarTouch = 1, kFarLinear = 50;  // [m] out of reach on such a device; a rail has no end
constexpr double kLeads = 0.5;  // share of authority of a seat that moves the tool and is not moved by it

}  // namespace

InvariantChecker::InvariantChecker(const SceneSpec& scene)
    : scene_(&scene), seats_(scene.seats.size()), authority_(scene), transfers_(scene), restart_barrier_(scene) {}

/// Ordinary motion requires that no two hands pull against each other and no hand is pushed. Both empty the energy
/// accounts, as intended. Scenes with a lower heat credit, gated flow sources or a seat on several tools are excluded
/// for the same reason.
bool InvariantChecker::begin_recovery_phase() noexcept {
  const auto passive = [](const SeatSpec& s) {
    return s.kind == SeatKind::kSlave || s.hand.model == HandModel::kRelaxed || s.hand.model == HandModel::kNone;
  };
  const auto pushed = [](const SeatSpec& s) { return !s.hand.deviations.empty(); };
  const bool ordinary = scene_->channel.law == LawKind::kSetPosition && scene_->channel.mfs == MfsMode::kOpen &&
                        scene_->channel.coupling == HandCouplingKind::kEsc &&
                        scene_->channel.eta >= ChannelSpec{}.eta && scene_->tools.size() == 1 &&
                        std::ranges::none_of(scene_->seats, pushed) &&
                        std::ranges::count_if(scene_->seats, std::not_fn(passive)) == 1;
  if (ordinary)
    moving_seat_ = static_cast<std::size_t>(std::ranges::find_if_not(scene_->seats, passive) - scene_->seats.begin());
  return ordinary;
}

void InvariantChecker::check(std::uint32_t lived, const server::Session& session,
                             const std::vector<SimulatedClient>& clients) {
  t_ = session.clock().time();
  server::SessionInvariantChecker{}.check(session, violations_);
  restart_barrier_.check(session, violations_);
  authority_.check(lived, session, scale_, violations_);
  if (lived > 0) transfers_.check(lived, session, violations_);
  const bool ordinary_motion = moving_seat_ && session.tool(0).authority.alpha(*moving_seat_) >= kLeads;
  for (std::size_t i = 0; i < clients.size(); ++i) {
    if (const client::Seat* core = clients[i].seat()) scale_ = core->setup().axis_scale;
    check_seat(lived, {*scene_, i, clients[i], session, violations_, seats_[i].was_active, ordinary_motion});
  }
}

void InvariantChecker::check_seat(std::uint32_t lived, ObservedSeat seat) {
  SeatCheckers& own = seats_[seat.index];
  const SimulatedClient& client = seat.client;
  const hal::sim::GroundTruth& truth = client.device().ground_truth();
  const double far = seat.spec().device.model == DeviceModel::kTouch ? kFarTouch : kFarLinear;
  if (!truth.x.allFinite() || truth.x.norm() > far) seat.violated("diverged");
  own.silence.check_energy(seat);
  if (seat.master_of_law_replica()) own.hand.check(seat);
  if (own.starts != client.program().starts()) {  // a new program knows nothing of the previous one
    own.starts = client.program().starts();
    own.was_active = seat.was_active = false;
    own.effort = {};
    own.silence = {};
    own.guards = {};
    own.ends.reset_client();
  }
  if (own.joins != client.program().joins()) {  // a new connection: its counters start at 0, the hand continues
    own.joins = client.program().joins();
    own.delivery.on_new_connection();
    own.ends.skip_client();
  }
  check_role(seat);
  const bool one_tool = seat.slave() || scene_->tools.size() == 1 || scene_->channel.law == LawKind::kReplica;
  if (lived == 1 && one_tool) {
    own.ends.check_server(seat);
  } else {
    own.ends.skip_server();
  }
  own.delivery.check(seat);
  if (client.seat() == nullptr) return;
  if (!client.ran_in_tick()) return own.ends.skip_client();
  own.effort.check(seat);
  own.silence.check(seat);
  own.guards.check(seat);
  own.ends.check_client(seat);
  own.was_active = seat.core().gate().active();
}

void InvariantChecker::on_audit_event(const server::AuditEvent& event) {
  restart_barrier_.on_audit_event(event, t_, violations_);
  transfers_.on_audit_event(event);
  check_role(event, *scene_, t_, violations_);
}

}  // namespace tandem::netsim
