#include "netsim/world_station.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "client/device_facts.h"

namespace tandem::netsim {

namespace {

/// A seat whose owner died is free after two seconds of silence; until then whoever asks is told so, and asks again.
constexpr Duration kAskAgain = std::chrono::milliseconds(200);

bool tampers(Fault::Kind kind) noexcept {
  return kind == Fault::Kind::kReplay || kind == Fault::Kind::kJunk || kind == Fault::Kind::kLiar || kind == Fault::Kind::kHostile;
}

/// Where an own clock begins, so that it never shows less than zero.
constexpr Duration kOwnEpoch = std::chrono::days(2);

/// Joint positions no device has, and far enough from infinity that their squares are finite or not, as it comes.
constexpr double kTooHot = 1.1;  // of what the motors may have
constexpr double kAbsurd[] = {1e5, -1e9, 1e160, -1e300};

}  // namespace

WorldStation::WorldStation(Setup setup)
    : scene_(setup.scene),
      number_(setup.seat),
      tick_(from_seconds(1.0 / setup.scene->tick_hz)),
      key_(RandomKey{setup.seed}.derive(1000 + setup.seat)),
      faults_(std::move(setup.faults)),
      device_(std::move(setup.device)) {
  if (setup.endpoint) {
    clock_.emplace(*setup.endpoint);
    if (setup.endpoint->wake.kind != WakeSpec::Kind::kExact) wake_.emplace(setup.endpoint->wake, tick_, Time{}, key_.derive(3));
  }
  if (std::ranges::any_of(faults_, [](const Fault& f) { return tampers(f.kind); }))
    tamper_ = std::make_unique<WorldTamper>(key_.derive(1), *scene_, number_);
}

bool WorldStation::suffers(Fault::Kind kind, Time now) const noexcept {
  return std::ranges::any_of(faults_, [&](const Fault& f) {
    return f.kind == kind && now >= Time{} + f.at && now < Time{} + f.at + f.length;
  });
}

bool WorldStation::ever_suffers(Fault::Kind kind) const noexcept {
  return std::ranges::any_of(faults_, [&](const Fault& f) { return f.kind == kind; });
}

Time WorldStation::own_time(Time now) const noexcept { return clock_ ? clock_->at(now) + kOwnEpoch : now; }

Time WorldStation::wakes_at(Time now) const noexcept { return wake_ ? std::clamp(wake_->next(), now - tick_, now) : now; }

void WorldStation::live(Duration length) noexcept {
  const hal::Vec3 before = device_->truth().x;
  device_->advance(command_, length);
  worked_now_ += device_->state().f_out.dot(device_->truth().x - before);
}

std::string WorldStation::step(Time now, server::Session* session, Network& network, std::span<std::byte> buffer) {
  heard_now_ = 0;
  served_now_ = false;
  worked_now_ = 0;
  const std::optional<Time> wakes = wake_ ? wake_->within(now - tick_, now) : now;
  const Time woke = wakes.value_or(now);
  if (woke > now - tick_) live(woke - (now - tick_));
  std::string trouble = work(woke, wakes.has_value(), session, network, buffer);
  if (woke < now) live(now - woke);
  return trouble;
}

std::string WorldStation::work(Time now, bool awake, server::Session* session, Network& network, std::span<std::byte> buffer) {
  if (suffers(Fault::Kind::kRestart, now)) {
    if (!down_) {
      down_ = true;
      trips_before_ = gate_trips();
      seat_.reset();
      device_->set_session_time(std::nullopt);
    }
    while (network.poll(now, static_cast<std::uint32_t>(number_), Direction::kDown, buffer)) {}  // to a closed port
    return {};
  }
  if (std::exchange(down_, false)) ++starts_;
  if (awake && !suffers(Fault::Kind::kPause, now)) {
    listen(now, network, buffer);
    if (!seat_ && session != nullptr) {
      if (std::string trouble = join(now, *session); !trouble.empty()) return trouble;
    }
    if (seat_ && session != nullptr && session->epoch() != epoch_) rejoin(now, *session);
    if (seat_) serve(now, network, buffer);
  } else if (seat_) {
    device_->set_session_time(hand_time(own_time(now)));  // the person goes on, the program does not
  }
  return {};
}

void WorldStation::listen(Time now, Network& network, std::span<std::byte> buffer) {
  while (const auto d = network.poll(now, static_cast<std::uint32_t>(number_), Direction::kDown, buffer)) {
    const auto bytes = buffer.first(std::min(d->size, buffer.size()));
    if (given_.first(d->index)) ++heard_now_;
    if (tamper_) tamper_->remember(Direction::kDown, bytes);
    hear(now, bytes);
  }
  if (tamper_ == nullptr) return;
  if (suffers(Fault::Kind::kReplay, now)) hear(now, tamper_->again(Direction::kDown));
  if (suffers(Fault::Kind::kJunk, now)) hear(now, tamper_->junk(seat_ ? seat_->link().own_cid() : 0));
}

void WorldStation::hear(Time now, std::span<const std::byte> bytes) noexcept {
  if (seat_) seat_->on_datagram(own_time(now), bytes);
}

std::string WorldStation::join(Time now, server::Session& session) {
  if (now < ask_again_) return {};
  const auto joined = join_virtually(session, now, number_, device_->caps(), key_.derive(4), asked_++);
  if (joined) {
    seat_ = std::make_unique<client::Seat>(joined->setup, device_->caps(), joined->link);
    server_cid_ = joined->link.peer_cid;
    if (tamper_) tamper_->joined(server_cid_, joined->link.secrets);
    epoch_ = session.epoch();
    ++joins_;
    stopped_ = wished_ = false;
    return {};
  }
  const std::string& name = scene_->seats[number_].name;
  switch (joined.error()) {
    case server::JoinResult::kSeatTaken:
      if (starts_ == 1) return "seat " + name + ": somebody sits there already";
      ask_again_ = now + kAskAgain;
      return {};
    case server::JoinResult::kSessionOver:
      return {};  // nobody waits for it any more
    case server::JoinResult::kNoSuchSeat:
    case server::JoinResult::kDeviceUnfit:
    case server::JoinResult::kAccepted:
      break;
  }
  return "seat " + name + ": " + session.reception().unfit(client::device_facts(device_->caps()));
}

/// Up to half a second, as programs do who do not want to ask all at once (design notes, security 4): nobody may be engaged meanwhile.
Duration WorldStation::wait_before_rejoin(std::uint64_t epoch) const noexcept {
  return std::chrono::milliseconds(key_.derive(6).bits(epoch) % 501);
}

/// The control connection broke and there is a server again: the same program and the same hand, new keys.
void WorldStation::rejoin(Time now, server::Session& session) {
  if (std::exchange(noticed_, session.epoch()) != session.epoch()) ask_again_ = now + wait_before_rejoin(session.epoch());
  if (now < ask_again_) return;
  const auto joined = join_virtually(session, now, number_, device_->caps(), key_.derive(4), asked_++);
  if (!joined) {
    ask_again_ = now + kAskAgain;
    return;
  }
  seat_->rejoin(joined->link);
  server_cid_ = joined->link.peer_cid;
  if (tamper_) tamper_->joined(server_cid_, joined->link.secrets);
  epoch_ = session.epoch();
  ++joins_;
}

/// What the simulated hand follows; it waits where it is while the session clock stands still.
std::optional<double> WorldStation::hand_time(Time own) const noexcept { return seat_->clock_stands() ? std::nullopt : seat_->session_time(own); }

/// What the person presses, as the faults say.
void WorldStation::act(Time now) noexcept {
  if (faults_.empty()) return;
  const bool stop = suffers(Fault::Kind::kStopHand, now);
  if (stop && !stopped_) seat_->press_stop();
  if (!stop && stopped_) seat_->press_resume();
  stopped_ = stop;
  const bool wish = suffers(Fault::Kind::kStopAll, now);
  if (wish && !wished_) static_cast<void>(seat_->press_stop_all());
  wished_ = wish;
}

const hal::State& WorldStation::reading(Time now) noexcept {
  misread_now_ = false;
  if (faults_.empty()) return device_->state();
  const bool frozen = suffers(Fault::Kind::kFrozen, now);
  if (!frozen || !frozen_) reading_ = device_->state();
  frozen_ = frozen;
  reading_.heat = suffers(Fault::Kind::kHot, now) ? std::optional{kTooHot} : device_->state().heat;
  const bool nan = suffers(Fault::Kind::kNotANumber, now);
  if (nan || suffers(Fault::Kind::kOutOfRange, now)) {
    const auto n = static_cast<std::uint64_t>(now.time_since_epoch() / tick_);
    const std::uint64_t drawn = key_.derive(2).bits(n);
    const std::size_t joint = drawn % device_->caps().joints;
    const double wrong = nan ? std::numeric_limits<double>::quiet_NaN() : kAbsurd[(drawn >> 8) % std::size(kAbsurd)];
    switch ((drawn >> 16) % 3) {
      case 0: reading_.q[joint] = wrong; break;
      case 1: reading_.dq[joint] = wrong; break;
      default: reading_.x[0] = wrong; break;
    }
    frozen_ = false;
    misread_now_ = true;
  }
  return reading_;
}

void WorldStation::serve(Time now, Network& network, std::span<std::byte> buffer) {
  served_now_ = true;
  served_at_ = now;
  const Time own = own_time(now);
  act(now);
  device_->set_session_time(hand_time(own));
  command_ = seat_->on_servo(own, reading(now));
  command_.expires = now + (command_.expires - own);  // the device has a clock of its own
  while (const auto size = seat_->poll_transmit(own, buffer)) {
    const auto bytes = buffer.first(*size);
    if (tamper_ && suffers(Fault::Kind::kLiar, now)) tamper_->lie(server_cid_, bytes);
    if (tamper_ && suffers(Fault::Kind::kHostile, now)) {
      network.send(now, static_cast<std::uint32_t>(number_), Direction::kUp, tamper_->attack(server_cid_, bytes, seat_->force().stops));
      continue;
    }
    network.send(now, static_cast<std::uint32_t>(number_), Direction::kUp, bytes);
  }
}

WorldStation::Forged WorldStation::forged(Time now) noexcept {
  Forged out;
  if (tamper_ == nullptr) return out;
  if (suffers(Fault::Kind::kReplay, now)) out.replayed = tamper_->again(Direction::kUp);
  if (suffers(Fault::Kind::kJunk, now)) out.junk = tamper_->junk(server_cid_);
  return out;
}

}  // namespace tandem::netsim
