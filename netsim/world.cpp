#include "netsim/world.h"

#include <cmath>

#include "hal/port_map.h"
#include "server/session_monitor.h"
#include "server/session_record.h"

namespace tandem::netsim {

namespace {

server::Endpoint endpoint_of(std::size_t seat) {
  server::Endpoint e;
  e.bytes[0] = static_cast<std::byte>(seat + 1);
  e.size = 1;
  return e;
}

/// Longest wait for a session to begin; covers joining over the longest delay there is, 60 s one way.
constexpr Duration kPatience = std::chrono::seconds(300);

std::size_t seat_of(const server::Endpoint& e) { return std::to_integer<std::size_t>(e.bytes[0]) - 1; }

}  // namespace

std::expected<std::unique_ptr<World>, std::string> World::make(const WorldSetup& setup) {
  std::unique_ptr<World> world{new World(setup)};
  const SceneSpec& scene = world->setup_.scene;
  world->tick_ = from_seconds(1.0 / scene.tick_hz);
  const Duration tick = world->tick_;
  // Time{} is the network's zero; the world begins one tick later so that no stamp is the empty one.
  world->now_ = Time{} + tick;

  world->hands_.resize(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatSpec& spec = scene.seats[i];
    hal::sim::SimSetup sim{spec.device, spec.hand, spec.environment, nullptr, world->now_};
    if (const auto m = setup.motions.find(spec.name); m != setup.motions.end()) {
      sim.hand.model = HandModel::kRecorded;
      sim.motion = m->second;
    }
    auto device = hal::sim::SimDevice::make(sim);
    if (!device) return std::unexpected("seat " + spec.name + ": " + device.error().message);
    world->hands_[i].device = std::move(*device);
    world->network_.add_link(setup.network);
  }

  std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
  for (const ToolSpec& tool : scene.tools) {
    if (tool.remote) {
      slaves.push_back(nullptr);
      continue;
    }
    auto slave = hal::sim::SimDevice::make({tool.slave, HandSpec{}, tool.environment, nullptr, world->now_});
    if (!slave) return std::unexpected("tool " + tool.name + ": " + slave.error().message);
    slaves.push_back(std::move(*slave));
  }

  const hal::SteppedDevice& first = *world->hands_[0].device;
  const AxisArray scale = hal::PortMap(scene.port, scene.dof, first.caps().joints).scale(first.state());
  world->session_ = std::make_unique<server::Session>(scene, std::move(slaves), scale, setup.seed);
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const RandomKey key = RandomKey{setup.seed}.derive(1000 + i);
    world->hands_[i].joining = std::make_unique<client::Joining>(
        client::Joining::Params{scene.seats[i].name, world->hands_[i].device->caps(), key.bits(0) >> 16,
                                static_cast<std::uint32_t>(key.bits(1) | 1), kPatience});
  }
  return world;
}

bool World::step() {
  if (session_->over() || !trouble_.empty()) return false;
  serve_clients();
  serve_server();
  take_record();
  watch();
  give_up_waiting();
  now_ += tick_;
  return !session_->over() && trouble_.empty();
}

/// A session that cannot begin would wait for ever; people get the reason instead.
void World::give_up_waiting() {
  if (session_->state() != wire::SessionState::kWaiting || now_ - Time{} < kPatience) return;
  trouble_ = "the session did not begin within " + std::to_string(kPatience / std::chrono::seconds(1)) + " s of virtual time;";
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const client::Seat* seat = hands_[i].seat.get();
    if (seat != nullptr && seat->gate().active()) continue;
    trouble_ += " " + setup_.scene.seats[i].name + (seat == nullptr ? " never got its seat;" : " could not be engaged;");
  }
  trouble_ += " a hand is engaged only over a loop younger than gate.loop_age_max_ms = " +
              std::to_string(static_cast<int>(1e3 * setup_.scene.gate.loop_age_max + 0.5)) + " (both ways) that is heard within " +
              std::to_string(static_cast<int>(1e3 * setup_.scene.gate.silence_limit + 0.5)) + " ms";
}

void World::join(std::size_t i) {
  Workstation& w = hands_[i];
  switch (w.joining->outcome(now_)) {
    case client::Joining::Outcome::kAccepted:
      w.seat = std::make_unique<client::Seat>(w.joining->setup(), w.device->caps(), w.joining->link());
      w.joining.reset();
      return;
    case client::Joining::Outcome::kRefused:
      trouble_ = "seat " + setup_.scene.seats[i].name + ": " + w.joining->reason();
      return;
    case client::Joining::Outcome::kNoAnswer:
      trouble_ = "seat " + setup_.scene.seats[i].name + ": the server did not answer";
      return;
    case client::Joining::Outcome::kAsking:
      break;
  }
  if (const auto size = w.joining->poll_transmit(now_, buffer_))
    network_.send(now_, static_cast<std::uint32_t>(i), Direction::kUp, std::span{buffer_}.first(*size));
}

void World::serve_clients() {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Workstation& w = hands_[i];
    const auto link = static_cast<std::uint32_t>(i);
    w.device->advance(w.command, tick_);
    while (const auto d = network_.poll(now_, link, Direction::kDown, buffer_)) {
      const auto bytes = std::span{buffer_}.first(d->size);
      if (w.seat) {
        w.seat->on_datagram(now_, bytes);
      } else if (w.joining) {
        w.joining->on_datagram(now_, bytes);
      }
    }
    if (!w.seat) {
      if (w.joining) join(i);
      if (!w.seat) continue;
    }
    w.device->set_session_time(w.seat->session_time(now_));
    w.command = w.seat->on_servo(now_, w.device->state());
    while (const auto size = w.seat->poll_transmit(now_, buffer_))
      network_.send(now_, link, Direction::kUp, std::span{buffer_}.first(*size));
  }
}

void World::serve_server() {
  for (std::size_t i = 0; i < hands_.size(); ++i)
    while (const auto d = network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_))
      session_->on_datagram(now_, endpoint_of(i), std::span{buffer_}.first(d->size));
  session_->on_tick(now_, 0);
  while (const auto out = session_->poll_transmit(now_, buffer_))
    network_.send(now_, static_cast<std::uint32_t>(seat_of(out->to)), Direction::kDown,
                  std::span{buffer_}.first(out->size));
}

void World::take_record() {
  record_ = session_->record();
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const client::Seat* seat = hands_[i].seat.get();
    if (seat == nullptr) continue;
    server::put_seat(seat->sample(), record_.seats[i]);
    record_.seats[i].sample_tick = record_.tick;
  }
  for (std::size_t j = 0; j < setup_.scene.tools.size(); ++j) {
    const ToolSpec& tool = setup_.scene.tools[j];
    if (!tool.remote) continue;
    if (hands_[tool.seat].seat) server::put_slave(hands_[tool.seat].seat->sample().telemetry, record_.tools[j]);
    record_.tools[j].sample_tick = record_.tick;
  }
}

void World::watch() {
  const double t = session_->time();
  server::SessionMonitor{}.check(*session_, violations_);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Workstation& w = hands_[i];
    if (!w.seat) continue;
    const std::string& name = setup_.scene.seats[i].name;
    const client::Seat& seat = *w.seat;
    const SceneSpec& scene = setup_.scene;
    double norm2 = 0;
    bool finite = true;
    for (std::size_t a = 0; a < scene.dof; ++a) {
      norm2 += seat.effort()[a] * seat.effort()[a] / seat.setup().axis_scale[a];
      finite = finite && std::isfinite(seat.effort()[a]);
      if (!seat.channel().ledger(a).holds()) violations_.note("ledger", name, t, !seat.channel().promises().ledger);
    }
    if (!finite) violations_.note("effort_finite", name, t, false);
    if (std::sqrt(norm2) > scene.gate.force_max * (1 + 1e-9)) violations_.note("effort_limited", name, t, false);
    const double silence = seconds(seat.link().freshness().silence(now_));
    if (seat.gate().active() && seat.link().freshness().heard() &&
        silence > scene.gate.silence_limit + 0.5 / scene.tick_hz)
      violations_.note("silence_ramps", name, t, false);
    if (seat.gate().given_after_loss_max() > seat.gate().tank_size() + 1e-3)
      violations_.note("loss_energy", name, t, false);
    const hal::sim::Truth& truth = w.device->truth();
    if (!truth.x.allFinite() || truth.x.norm() > 10) violations_.note("diverged", name, t, false);
  }
}

}  // namespace tandem::netsim
