#include "netsim/system/simulated_client.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tandem::netsim {
namespace {

constexpr std::array kNeedsAttacker{Fault::Kind::kReplay, Fault::Kind::kJunk, Fault::Kind::kLiar,
                                    Fault::Kind::kHostile};

/// Start of a client's own clock, so that it never becomes negative.
constexpr Duration kOwnEpoch = std::chrono::days(2);

/// Derives the randomness of a seat; 999 and below belong to the server (simulated_server.cpp).
RandomKey key_of(const SimulatedClient::Setup& setup) noexcept {
  return RandomKey{setup.seed}.derive(1000 + setup.seat);
}

}  // namespace

SimulatedClient::SimulatedClient(Setup setup)
    : link_(static_cast<std::uint32_t>(setup.seat)),
      tick_(from_seconds(1.0 / setup.scene->tick_hz)),
      never_starts_(setup.never_starts),
      faults_(std::move(setup.faults)),
      device_(std::move(setup.device)),
      sensors_(key_of(setup).derive(2), tick_),
      program_(*setup.scene, setup.seat, key_of(setup)) {
  if (setup.endpoint) {
    clock_.emplace(*setup.endpoint);
    if (setup.endpoint->wake.kind != WakeSpec::Kind::kExact)
      wake_.emplace(setup.endpoint->wake, tick_, Time{}, key_of(setup).derive(3));
    if (setup.endpoint->wake.shifts) phase_.emplace(tick_);
  }
  if (std::ranges::any_of(kNeedsAttacker, [&](Fault::Kind kind) { return faults_.contains(kind); }))
    attacker_ = std::make_unique<Attacker>(key_of(setup).derive(1), *setup.scene, setup.seat);
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
  std::string trouble;
  Time at = now - tick_;
  double before_run = 0;
  // A program that shifts its wake-ups towards an earlier tick wakes up twice in one.
  do {
    const std::optional<Time> wakes = wake_ ? wake_->within(at, now) : now;
    const Time woke = wakes.value_or(now);
    if (woke > at) advance_device(woke - at);
    at = woke;
    trouble = run_program(woke, wakes.has_value(), session, network, buffer);
    before_run = motor_work_;
  } while (phase_ && trouble.empty() && wake_->next() <= now);
  if (at < now) advance_device(now - at);
  motor_work_after_run_ = ran_in_tick_ ? motor_work_ - before_run : 0;
  return trouble;
}

std::string SimulatedClient::run_program(Time now, bool awake, server::Session* session, Network& network,
                                         std::span<std::byte> buffer) {
  if (never_starts_ || faults_.active(Fault::Kind::kRestart, now)) {
    if (program_.die()) device_->set_session_time(std::nullopt);
    while (network.poll(now, link_, Direction::kDown, buffer)) {
    }  // as if sent to a closed port
    return {};
  }
  program_.start();
  if (awake && !faults_.active(Fault::Kind::kPause, now)) {
    receive(now, network, buffer);
    if (session != nullptr) {
      const std::uint32_t joins = program_.joins();
      if (std::string trouble = program_.connect(now, *session, device_->caps(), attacker_.get()); !trouble.empty())
        return trouble;
      if (phase_ && program_.joins() != joins) phase_->restart();
    }
    if (seat() != nullptr) run_seat(now, network, buffer);
  } else if (seat() != nullptr) {
    device_->set_session_time(hand_time(own_time(now)));  // the user continues, the program does not
  }
  return {};
}

void SimulatedClient::receive(Time now, Network& network, std::span<std::byte> buffer) {
  while (const auto d = network.poll(now, link_, Direction::kDown, buffer)) {
    const auto bytes = buffer.first(std::min(d->size, buffer.size()));
    if (first_seen_.is_first(d->index)) ++new_datagrams_;
    if (attacker_) attacker_->remember(Direction::kDown, bytes);
    deliver(d->at, bytes);
  }
  if (attacker_ == nullptr) return;
  if (faults_.active(Fault::Kind::kReplay, now)) deliver(now, attacker_->replayed(Direction::kDown));
  if (faults_.active(Fault::Kind::kJunk, now))
    deliver(now, attacker_->random_bytes(seat() != nullptr ? seat()->link().own_cid() : 0));
}

void SimulatedClient::deliver(Time at, std::span<const std::byte> bytes) noexcept {
  if (seat() != nullptr) seat()->on_datagram(own_time(at), bytes);
}

/// Returns the time that the simulated hand follows; nullopt while the session clock is stopped, and the hand then
/// waits.
std::optional<double> SimulatedClient::hand_time(Time own) const noexcept {
  return seat()->clock().stopped() ? std::nullopt : seat()->clock().session_time(own);
}

void SimulatedClient::run_seat(Time now, Network& network, std::span<std::byte> buffer) {
  ran_in_tick_ = true;
  last_run_ = now;
  const Time own = own_time(now);
  client::Seat& core = *seat();
  if (phase_) phase_->observe(core.link().timing(), own);
  if (!faults_.empty()) program_.apply_stop_faults(now, faults_);
  device_->set_session_time(hand_time(own));
  command_ = core.on_servo(own, sensors_.read(now, faults_, device_->state(), device_->caps().joints));
  command_.expires = now + (command_.expires - own);  // the device has its own clock
  while (const auto size = core.poll_transmit(own, buffer)) {
    std::span<const std::byte> bytes = buffer.first(*size);
    const std::uint32_t cid = program_.server_cid();
    if (attacker_ && faults_.active(Fault::Kind::kLiar, now)) attacker_->forge_energy_account(cid, buffer.first(*size));
    if (attacker_ && faults_.active(Fault::Kind::kHostile, now))
      bytes = attacker_->forge_state(cid, buffer.first(*size), core.force().stops);
    network.send(now, link_, Direction::kUp, bytes);
  }
  if (phase_) wake_->shift(phase_->next_shift());
}

SimulatedClient::AttackDatagrams SimulatedClient::attack_datagrams(Time now) noexcept {
  AttackDatagrams out;
  if (attacker_ == nullptr) return out;
  if (faults_.active(Fault::Kind::kReplay, now)) out.replayed = attacker_->replayed(Direction::kUp);
  if (faults_.active(Fault::Kind::kJunk, now)) out.junk = attacker_->random_bytes(program_.server_cid());
  return out;
}

}  // namespace tandem::netsim
