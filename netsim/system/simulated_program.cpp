#include "netsim/system/simulated_program.h"

#include <utility>

#include "client/seat/device_facts.h"
#include "netsim/system/simulated_handshake.h"

namespace tandem::netsim {
namespace {

/// Retry interval of a join. A seat whose owner died is free after two seconds of silence; until then the server
/// rejects the join.
constexpr Duration kRetryInterval = std::chrono::milliseconds(200);

}  // namespace

void SimulatedProgram::start() noexcept {
  if (!std::exchange(running_, true)) ++starts_;
}

bool SimulatedProgram::die() noexcept {
  if (!std::exchange(running_, false)) return false;
  trips_before_ = gate_trips();
  seat_.reset();
  return true;
}

std::string SimulatedProgram::connect(Time now, server::Session& session, const hal::DeviceCaps& caps,
                                      Attacker* attacker) {
  if (seat_ && session.epoch() == epoch_) return {};
  // A delay of up to half a second spreads the joins of many programs after a restart. No seat may be engaged
  // meanwhile.
  if (seat_ && std::exchange(known_epoch_, session.epoch()) != session.epoch())
    retry_at_ = now + std::chrono::milliseconds(key_.derive(6).bits(session.epoch()) % 501);
  if (now < retry_at_) return {};
  const auto joined = simulate_join(session, now, seat_index_, caps, key_.derive(4), join_attempts_++);
  if (!joined) return join_failed(joined.error(), now, session, caps);
  if (seat_) {
    seat_->reconnect(joined->channel_params);  // the same program and hand, new keys
  } else {
    seat_ = std::make_unique<client::Seat>(joined->setup, caps, joined->channel_params);
    stopped_ = stop_all_requested_ = false;
  }
  server_cid_ = joined->channel_params.peer_cid;
  if (attacker != nullptr) attacker->set_connection(server_cid_, joined->channel_params.secrets);
  epoch_ = session.epoch();
  ++joins_;
  return {};
}

std::string SimulatedProgram::join_failed(server::JoinResult why, Time now, const server::Session& session,
                                          const hal::DeviceCaps& caps) {
  const std::string& name = scene_->seats[seat_index_].name;
  if (seat_ == nullptr && why == server::JoinResult::kSessionOver) return {};  // it needs no seat any more
  if (seat_ != nullptr || why == server::JoinResult::kSeatTaken) {
    if (seat_ == nullptr && starts_ == 1) return "seat " + name + ": this seat is taken already";
    retry_at_ = now + kRetryInterval;
    return {};
  }
  return "seat " + name + ": " + session.seat_catalogue().device_incompatibility(client::device_facts(caps));
}

void SimulatedProgram::apply_stop_faults(Time now, const FaultSchedule& faults) noexcept {
  const bool stop = faults.active(Fault::Kind::kStopHand, now);
  if (stop && !stopped_) seat_->requests().stop_locally();
  if (!stop && stopped_) seat_->requests().resume();
  stopped_ = stop;
  const bool stop_all = faults.active(Fault::Kind::kStopAll, now);
  if (stop_all && !stop_all_requested_) static_cast<void>(seat_->requests().stop_all());
  stop_all_requested_ = stop_all;
}

}  // namespace tandem::netsim
