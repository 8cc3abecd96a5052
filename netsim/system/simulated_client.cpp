#include "netsim/system/simulated_client.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "client/seat/device_facts.h"

namespace tandem::netsim {

namespace {

/// Retry interval of a join. A seat whose owner died is free after two seconds of silence; until then the server
/// rejects the join.
constexpr Duration kRetryInterval = std::chrono::milliseconds(200);

bool tampers(Fault::Kind kind) noexcept {
  return kind == Fault::Kind::kReplay || kind == Fault::Kind::kJunk || kind == Fault::Kind::kLiar ||
         kind == Fault::Kind::kHostile;
}

/// Start of a client's own clock, so that it never becomes negative.
constexpr Duration kOwnEpoch = std::chrono::days(2);

/// Heat that the fault kHot reports, as a share of the motors' limit.
constexpr double kTooHot = 1.1;
/// Readings that no device has: positions, velocities. The squares of some are finite, those of others are not.
constexpr double kAbsurd[] = {1e5, -1e9, 1e160, -1e300};

}  // namespace

SimulatedClient::SimulatedClient(Setup setup)
    : scene_(setup.scene),
      seat_index_(setup.seat),
      tick_(from_seconds(1.0 / setup.scene->tick_hz)),
      key_(RandomKey{setup.seed}.derive(1000 + setup.seat)),
      faults_(std::move(setup.faults)),
      device_(std::move(setup.device)) {
  if (setup.endpoint) {
    clock_.emplace(*setup.endpoint);
    if (setup.endpoint->wake.kind != WakeSpec::Kind::kExact)
      wake_.emplace(setup.endpoint->wake, tick_, Time{}, key_.derive(3));
  }
  if (std::ranges::any_of(faults_, [](const Fault& f) { return tampers(f.kind); }))
    attacker_ = std::make_unique<Attacker>(key_.derive(1), *scene_, seat_index_);
}

bool SimulatedClient::has_fault(Fault::Kind kind, Time now) const noexcept {
  return std::ranges::any_of(faults_, [&](const Fault& f) {
    return f.kind == kind && now >= Time{} + f.at && now < Time{} + f.at + f.length;
  });
}

bool SimulatedClient::ever_has_fault(Fault::Kind kind) const noexcept {
  return std::ranges::any_of(faults_, [&](const Fault& f) { return f.kind == kind; });
}

Time SimulatedClient::own_time(Time now) const noexcept { return clock_ ? clock_->at(now) + kOwnEpoch : now; }

Time SimulatedClient::wake_time(Time now) const noexcept {
  return wake_ ? std::clamp(wake_->next(), now - tick_, now) : now;
}

void SimulatedClient::advance_device(Duration length) noexcept {
  const hal::Vec3 before = device_->ground_truth().x;
  device_->advance(command_, length);
  motor_work_ += device_->state().f_out.dot(device_->ground_truth().x - before);
}

std::string SimulatedClient::step(Time now, server::Session* session, Network& network, std::span<std::byte> buffer) {
  new_datagrams_ = 0;
  ran_in_tick_ = false;
  motor_work_ = 0;
  const std::optional<Time> wakes = wake_ ? wake_->within(now - tick_, now) : now;
  const Time woke = wakes.value_or(now);
  if (woke > now - tick_) advance_device(woke - (now - tick_));
  std::string trouble = run_program(woke, wakes.has_value(), session, network, buffer);
  if (woke < now) advance_device(now - woke);
  return trouble;
}

std::string SimulatedClient::run_program(Time now, bool awake, server::Session* session, Network& network,
                                         std::span<std::byte> buffer) {
  if (has_fault(Fault::Kind::kRestart, now)) {
    if (!down_) {
      down_ = true;
      trips_before_ = gate_trips();
      seat_.reset();
      device_->set_session_time(std::nullopt);
    }
    while (network.poll(now, static_cast<std::uint32_t>(seat_index_), Direction::kDown, buffer)) {
    }  // as if sent to a closed port
    return {};
  }
  if (std::exchange(down_, false)) ++starts_;
  if (awake && !has_fault(Fault::Kind::kPause, now)) {
    receive(now, network, buffer);
    if (!seat_ && session != nullptr) {
      if (std::string trouble = join(now, *session); !trouble.empty()) return trouble;
    }
    if (seat_ && session != nullptr && session->epoch() != epoch_) rejoin(now, *session);
    if (seat_) run_seat(now, network, buffer);
  } else if (seat_) {
    device_->set_session_time(hand_time(own_time(now)));  // the user continues, the program does not
  }
  return {};
}

void SimulatedClient::receive(Time now, Network& network, std::span<std::byte> buffer) {
  while (const auto d = network.poll(now, static_cast<std::uint32_t>(seat_index_), Direction::kDown, buffer)) {
    const auto bytes = buffer.first(std::min(d->size, buffer.size()));
    if (first_seen_.is_first(d->index)) ++new_datagrams_;
    if (attacker_) attacker_->remember(Direction::kDown, bytes);
    deliver(now, bytes);
  }
  if (attacker_ == nullptr) return;
  if (has_fault(Fault::Kind::kReplay, now)) deliver(now, attacker_->replayed(Direction::kDown));
  if (has_fault(Fault::Kind::kJunk, now)) deliver(now, attacker_->random_bytes(seat_ ? seat_->link().own_cid() : 0));
}

void SimulatedClient::deliver(Time now, std::span<const std::byte> bytes) noexcept {
  if (seat_) seat_->on_datagram(own_time(now), bytes);
}

std::string SimulatedClient::join(Time now, server::Session& session) {
  if (now < retry_at_) return {};
  const auto joined = simulate_join(session, now, seat_index_, device_->caps(), key_.derive(4), join_attempts_++);
  if (joined) {
    seat_ = std::make_unique<client::Seat>(joined->setup, device_->caps(), joined->channel_params);
    server_cid_ = joined->channel_params.peer_cid;
    if (attacker_) attacker_->set_connection(server_cid_, joined->channel_params.secrets);
    epoch_ = session.epoch();
    ++joins_;
    stopped_ = stop_all_requested_ = false;
    return {};
  }
  const std::string& name = scene_->seats[seat_index_].name;
  switch (joined.error()) {
    case server::JoinResult::kSeatTaken:
      if (starts_ == 1) return "seat " + name + ": this seat is taken already";
      retry_at_ = now + kRetryInterval;
      return {};
    case server::JoinResult::kSessionOver:
      return {};  // not an error: the client needs no seat any more
    case server::JoinResult::kNoSuchSeat:
    case server::JoinResult::kDeviceUnfit:
    case server::JoinResult::kAccepted:
      break;
  }
  return "seat " + name + ": " + session.seat_catalogue().device_incompatibility(client::device_facts(device_->caps()));
}

/// Returns a delay of up to half a second, which spreads the joins of many programs (design notes, security 4). No seat
/// may be engaged meanwhile.
Duration SimulatedClient::rejoin_backoff(std::uint64_t epoch) const noexcept {
  return std::chrono::milliseconds(key_.derive(6).bits(epoch) % 501);
}

/// Joins a restarted server: the same program and hand, new keys.
void SimulatedClient::rejoin(Time now, server::Session& session) {
  if (std::exchange(known_epoch_, session.epoch()) != session.epoch())
    retry_at_ = now + rejoin_backoff(session.epoch());
  if (now < retry_at_) return;
  const auto joined = simulate_join(session, now, seat_index_, device_->caps(), key_.derive(4), join_attempts_++);
  if (!joined) {
    retry_at_ = now + kRetryInterval;
    return;
  }
  seat_->reconnect(joined->channel_params);
  server_cid_ = joined->channel_params.peer_cid;
  if (attacker_) attacker_->set_connection(server_cid_, joined->channel_params.secrets);
  epoch_ = session.epoch();
  ++joins_;
}

/// Returns the time that the simulated hand follows; nullopt while the session clock is stopped, and the hand then
/// waits.
std::optional<double> SimulatedClient::hand_time(Time own) const noexcept {
  return seat_->clock().stopped() ? std::nullopt : seat_->clock().session_time(own);
}

/// Applies the key presses of the user that the faults require.
void SimulatedClient::apply_stop_faults(Time now) noexcept {
  if (faults_.empty()) return;
  const bool stop = has_fault(Fault::Kind::kStopHand, now);
  if (stop && !stopped_) seat_->requests().stop_locally();
  if (!stop && stopped_) seat_->requests().resume();
  stopped_ = stop;
  const bool wish = has_fault(Fault::Kind::kStopAll, now);
  if (wish && !stop_all_requested_) static_cast<void>(seat_->requests().stop_all());
  stop_all_requested_ = wish;
}

const hal::State& SimulatedClient::reading(Time now) noexcept {
  invalid_reading_ = false;
  if (faults_.empty()) return device_->state();
  const bool frozen = has_fault(Fault::Kind::kFrozen, now);
  if (!frozen || !frozen_) reading_ = device_->state();
  frozen_ = frozen;
  reading_.heat = has_fault(Fault::Kind::kHot, now) ? std::optional{kTooHot} : device_->state().heat;
  const bool nan = has_fault(Fault::Kind::kNotANumber, now);
  if (nan || has_fault(Fault::Kind::kOutOfRange, now)) {
    const auto n = static_cast<std::uint64_t>(now.time_since_epoch() / tick_);
    const std::uint64_t drawn = key_.derive(2).bits(n);
    const std::size_t joint = drawn % device_->caps().joints;
    const double wrong = nan ? std::numeric_limits<double>::quiet_NaN() : kAbsurd[(drawn >> 8) % std::size(kAbsurd)];
    switch ((drawn >> 16) % 3) {
      case 0:
        reading_.q[joint] = wrong;
        break;
      case 1:
        reading_.dq[joint] = wrong;
        break;
      default:
        reading_.x[0] = wrong;
        break;
    }
    frozen_ = false;
    invalid_reading_ = true;
  }
  return reading_;
}

void SimulatedClient::run_seat(Time now, Network& network, std::span<std::byte> buffer) {
  ran_in_tick_ = true;
  last_run_ = now;
  const Time own = own_time(now);
  apply_stop_faults(now);
  device_->set_session_time(hand_time(own));
  command_ = seat_->on_servo(own, reading(now));
  command_.expires = now + (command_.expires - own);  // the device has its own clock
  while (const auto size = seat_->poll_transmit(own, buffer)) {
    const auto bytes = buffer.first(*size);
    if (attacker_ && has_fault(Fault::Kind::kLiar, now)) attacker_->forge_energy_account(server_cid_, bytes);
    if (attacker_ && has_fault(Fault::Kind::kHostile, now)) {
      network.send(now, static_cast<std::uint32_t>(seat_index_), Direction::kUp,
                   attacker_->forge_state(server_cid_, bytes, seat_->force().stops));
      continue;
    }
    network.send(now, static_cast<std::uint32_t>(seat_index_), Direction::kUp, bytes);
  }
}

SimulatedClient::AttackDatagrams SimulatedClient::attack_datagrams(Time now) noexcept {
  AttackDatagrams out;
  if (attacker_ == nullptr) return out;
  if (has_fault(Fault::Kind::kReplay, now)) out.replayed = attacker_->replayed(Direction::kUp);
  if (has_fault(Fault::Kind::kJunk, now)) out.junk = attacker_->random_bytes(server_cid_);
  return out;
}

}  // namespace tandem::netsim
