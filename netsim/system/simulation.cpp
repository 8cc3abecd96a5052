#include "netsim/system/simulation.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hal/core/port_map.h"
#include "netsim/system/not_engaged_reason.h"
#include "server/session/session_record.h"

namespace tandem::netsim {

namespace {

/// @param address  number of the client's source address, at most Addresses::kMax
server::PeerAddress endpoint_of(std::size_t seat, std::uint32_t address = 0) {
  server::PeerAddress e;
  e.bytes[0] = static_cast<std::byte>(seat + 1);
  e.bytes[1] = static_cast<std::byte>(address & 0xff);
  e.bytes[2] = static_cast<std::byte>(address >> 8);
  e.size = 3;
  return e;
}

/// Derives the key of path-challenge tokens from the seed; seats use 1000 and above (simulated_client.cpp).
constexpr std::uint64_t kTokenKey = 999;

/// Address of random bytes from outside, besides the seats' own addresses.
constexpr std::size_t kUnknownPeer = 254;

/// Longest wait for a session to begin. It covers a join over the longest possible delay, 60 s one way.
constexpr Duration kStartTimeout = std::chrono::seconds(300);

std::size_t seat_of(const server::PeerAddress& e) { return std::to_integer<std::size_t>(e.bytes[0]) - 1; }
std::uint32_t address_of(const server::PeerAddress& e) {
  return std::to_integer<std::uint32_t>(e.bytes[1]) | std::to_integer<std::uint32_t>(e.bytes[2]) << 8;
}

}  // namespace

std::expected<std::unique_ptr<Simulation>, std::string> Simulation::make(const SimulationConfig& setup) {
  std::unique_ptr<Simulation> world{new Simulation(setup)};
  const SceneSpec& scene = world->setup_.scene;
  // Time{} is the network's zero. The simulation begins one tick later, so that no time stamp equals the empty one.
  world->now_ = Time{} + world->tick_;

  const auto known = [&](const std::string& seat) {
    return std::ranges::any_of(scene.seats, [&](const SeatSpec& s) { return s.name == seat; });
  };
  for (const Fault& fault : setup.faults)
    if (!fault.seat.empty() && !known(fault.seat))
      return std::unexpected("a fault of seat " + fault.seat + ", which the scene has not");
  for (const auto& [seat, endpoint] : setup.endpoints) {
    if (!known(seat)) return std::unexpected("a clock of seat " + seat + ", which the scene has not");
    for (const SpecError& p : problems(endpoint))
      return std::unexpected("seat " + seat + ": " + p.key + ": " + p.message);
  }
  world->clients_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    if (std::string trouble = world->add_client(i); !trouble.empty()) return std::unexpected(trouble);
  if (std::ranges::any_of(setup.endpoints,
                          [](const auto& e) { return e.second.wake.kind != WakeSpec::Kind::kExact; })) {
    world->order_.resize(scene.seats.size());
    std::iota(world->order_.begin(), world->order_.end(), std::size_t{0});
  }
  std::ranges::copy_if(setup.faults, std::back_inserter(world->server_faults_),
                       [](const Fault& f) { return of_server(f.kind); });
  std::ranges::copy_if(setup.faults, std::back_inserter(world->session_stop_faults_),
                       [](const Fault& f) { return f.kind == Fault::Kind::kStopAll; });

  auto slaves = world->make_local_slaves(nullptr);
  if (!slaves) return std::unexpected(slaves.error());
  const hal::SteppedDevice& first = world->clients_[0].device();
  world->scale_ = hal::PortMap(scene.port, scene.dof, first.caps().joints).scale(first.state());
  world->session_ = std::make_unique<server::Session>(scene, std::move(*slaves), world->scale_);
  world->attach_contact_sources();
  world->checkpoint_ = world->session_->checkpoint();
  return world;
}

/// @param from  positions of the slaves; null: those of the scene
std::expected<std::vector<std::unique_ptr<hal::SteppedDevice>>, std::string> Simulation::make_local_slaves(
    const server::Checkpoint* from) const {
  std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
  for (std::size_t j = 0; j < setup_.scene.tools.size(); ++j) {
    const ToolSpec& tool = setup_.scene.tools[j];
    if (tool.remote || tool.is_virtual) {
      slaves.push_back(nullptr);
      continue;
    }
    hal::sim::SimSetup sim{tool.slave, HandSpec{}, tool.environment, nullptr, now_};
    if (from != nullptr) sim.joints = from->tools[j].slave;
    auto slave = hal::sim::SimDevice::make(sim);
    if (!slave) return std::unexpected("tool " + tool.name + ": " + slave.error().message);
    slaves.push_back(std::move(*slave));
  }
  return slaves;
}

void Simulation::attach_contact_sources() {
  if (!setup_.contact_source) return;
  for (std::size_t j = 0; j < setup_.scene.tools.size(); ++j) session_->set_contact_source(j, setup_.contact_source(j));
}

void Simulation::apply_server_restart() {
  const bool dead = std::ranges::any_of(server_faults_, [&](const Fault& f) {
    return f.kind == Fault::Kind::kServerRestart && now_ >= Time{} + f.at && now_ < Time{} + f.at + f.length;
  });
  if (server_up_ && dead) server_up_ = false;
  if (!server_up_ && !dead) restart_server();
}

/// Restarts the server from its checkpoint, which is encoded and decoded as for a file. All other state is lost.
void Simulation::restart_server() {
  std::array<std::byte, server::kCheckpointMax> bytes;
  const std::size_t size = server::encode_checkpoint(checkpoint_, bytes);
  const auto read = server::decode_checkpoint(std::span{bytes}.first(size));
  if (!read || !server::incompatibility(*read, setup_.scene).empty()) {
    trouble_ = "the checkpoint cannot be read back";
    return;
  }
  auto slaves = make_local_slaves(&*read);
  if (!slaves) {
    trouble_ = "after a restart: " + slaves.error();
    return;
  }
  session_ = std::make_unique<server::Session>(setup_.scene, std::move(*slaves), scale_, *read);
  attach_contact_sources();
  server_missed_ = 0;
  server_up_ = true;
}

/// Updates the checkpoint twice a second and whenever participants, authority or the session's state change.
void Simulation::update_checkpoint(bool people_changed) {
  constexpr Duration kEvery = std::chrono::milliseconds(500);
  if (!people_changed && now_ - checkpoint_at_ < kEvery &&
      session_->authority().version() == checkpoint_.authority_version &&
      session_->stop_latch().stops() == checkpoint_.stops && session_->epoch() == checkpoint_.epoch &&
      session_->begun() == checkpoint_.begun)
    return;
  checkpoint_ = session_->checkpoint();
  checkpoint_at_ = now_;
}

std::string Simulation::add_client(std::size_t i) {
  const SeatSpec& spec = setup_.scene.seats[i];
  // A client steps its device through a tick before it reads it. The device therefore begins one tick earlier.
  hal::sim::SimSetup sim{spec.device, spec.hand, spec.environment, nullptr, now_ - tick_};
  if (const auto m = setup_.motions.find(spec.name); m != setup_.motions.end()) {
    if (spec.hand.model != HandModel::kRecorded) sim.hand = person_instead_of(spec.hand, HandModel::kRecorded);
    sim.motion = m->second;
  }
  auto device = hal::sim::SimDevice::make(sim);
  if (!device) return "seat " + spec.name + ": " + device.error().message;

  SimulatedClient::Setup station{.scene = &setup_.scene,
                                 .seat = i,
                                 .seed = setup_.seed,
                                 .device = std::move(*device),
                                 .faults = {},
                                 .endpoint = {}};
  for (const Fault& fault : setup_.faults)
    if (!of_server(fault.kind) && (fault.seat.empty() || fault.seat == spec.name)) station.faults.push_back(fault);
  if (const auto e = setup_.endpoints.find(spec.name); e != setup_.endpoints.end()) station.endpoint = e->second;
  clients_.emplace_back(std::move(station));
  if (clients_.back().ever_has_fault(Fault::Kind::kLiar)) checker_.expect("energy_monotone", spec.name);
  // No client can account for motion that the encoders do not report.
  if (clients_.back().ever_has_fault(Fault::Kind::kFrozen)) checker_.expect("loss_energy", spec.name);

  const auto own = setup_.seat_networks.find(spec.name);
  const LinkSpec& link = own == setup_.seat_networks.end() ? setup_.network : own->second;
  if (setup_.replay) {
    network_.add_replay(setup_.replay, static_cast<std::uint32_t>(i));
  } else if (std::string problem = sharing_problem(link, setup_.events); !problem.empty()) {
    return problem;
  } else {
    network_.add_link(schedule_for(link, setup_.events, spec.name), i);
  }
  return {};
}

bool Simulation::step() {
  if (session_->over() || !trouble_.empty()) return false;
  if (!server_faults_.empty()) apply_server_restart();
  if (!session_stop_faults_.empty()) apply_resume_requests();
  step_clients();
  std::uint32_t lived = 0;
  if (!server_up_) {
    for (std::size_t i = 0; i < clients_.size(); ++i)  // as if sent to a closed port
      while (network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_)) {
      }
  } else if (server_paused()) {
    ++server_missed_;
  } else {
    lived = server_missed_ + 1;
    step_server();
  }
  if (setup_.keep_record) update_record();
  checker_.check(lived, *session_, clients_);
  check_start_timeout();
  if (setup_.monitor_quality && link_monitors_.empty() && session_->state() == wire::SessionState::kRunning)
    start_link_monitors();
  now_ += tick_;
  return !session_->over() && trouble_.empty();
}

/// Starts the link statistics when the session begins. Joins are slower and wait for participants, so that their
/// datagrams are not judged.
void Simulation::start_link_monitors() {
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    link_monitors_.push_back(std::make_unique<LinkMonitor>(now_));
    network_.attach_monitor(static_cast<std::uint32_t>(i), link_monitors_.back().get());
  }
}

/// Sets the reason why a session did not begin; otherwise the simulation would never end.
void Simulation::check_start_timeout() {
  if (session_->state() != wire::SessionState::kWaiting || now_ - Time{} < kStartTimeout) return;
  trouble_ = "the session did not begin within " + std::to_string(kStartTimeout / std::chrono::seconds(1)) +
             " s of virtual time";
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const client::Seat* seat = clients_[i].seat();
    if (seat == nullptr || !seat->gate().active())
      trouble_ += "; " + not_engaged_reason(setup_.scene, i, seat, *session_, clients_[i].own_time(now_), now_);
  }
}

void Simulation::step_clients() {
  // Clients send in the order in which they wake up. On a shared link no datagram may enter before an older one.
  for (std::size_t i = 1; i < order_.size(); ++i)
    for (std::size_t j = i; j > 0 && wakes_before(order_[j], order_[j - 1]); --j) std::swap(order_[j], order_[j - 1]);
  for (std::size_t n = 0; n < clients_.size(); ++n) {
    const std::size_t i = order_.empty() ? n : order_[n];
    SimulatedClient& station = clients_[i];
    const client::Seat* const before = station.seat();
    const std::uint32_t joins = station.joins();
    const std::uint64_t taken = heap_taken();
    if (std::string trouble = station.step(now_, server_up_ ? session_.get() : nullptr, network_, buffer_);
        !trouble.empty())
      trouble_ = std::move(trouble);
    // A program that starts, joins or dies does not run a tick here.
    if (before != nullptr && before == station.seat() && joins == station.joins() && heap_taken() != taken)
      checker_.note_heap_violation(i);
  }
}

bool Simulation::wakes_before(std::size_t a, std::size_t b) const noexcept {
  return std::pair{clients_[a].wake_time(now_), a} < std::pair{clients_[b].wake_time(now_), b};
}

bool Simulation::server_paused() const noexcept {
  return now_ < busy_until_ ||
         std::ranges::any_of(
             server_faults_,
             [&](const Fault& f) {
               return f.kind == Fault::Kind::kServerLate && now_ >= Time{} + f.at && now_ < Time{} + f.at + f.length;
             });
}

void Simulation::step_server() {
  const std::uint64_t taken = heap_taken();
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    while (const auto d = network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_)) {
      const auto bytes = std::span{buffer_}.first(std::min(d->size, buffer_.size()));
      checker_.on_server_datagram(i, d->index);
      clients_[i].remember_for_replay(bytes);
      session_->on_datagram(now_, endpoint_of(i, d->address), bytes);
    }
  }
  inject_attacks();
  session_->set_load_state(load_shedder_.step(now_, server_missed_ * tick_, tick_used_));
  session_->on_tick(now_, server_missed_);
  if (session_->path_tokens().low())
    fill_path_tokens(*session_, RandomKey{setup_.seed}.derive(kTokenKey), token_draws_ += server::PathTokens::kMax);
  server_missed_ = 0;
  std::size_t sent = 0;
  while (const auto out = session_->poll_transmit(now_, buffer_)) {
    ++sent;
    const std::size_t to = seat_of(out->to);
    if (to >= clients_.size()) {
      checker_.on_reply_to_unknown_peer(session_->clock().time());
      continue;
    }
    network_.send_to(now_, static_cast<std::uint32_t>(to), address_of(out->to), std::span{buffer_}.first(out->size));
  }
  if (heap_taken() != taken) checker_.note_heap_violation();
  if (setup_.tick_cost) {
    tick_used_ = setup_.tick_cost(now_, sent);
    busy_until_ = now_ + tick_used_;
  }
  bool people_changed = false;
  while (const auto event = session_->audit().poll()) {
    people_changed |= event->what == server::AuditEvent::What::kJoin || event->what == server::AuditEvent::What::kLeave;
    checker_.on_audit_event(*event);
    if (on_audit) on_audit(*event);
  }
  update_checkpoint(people_changed);
}

/// Ends stops of the session after their length, by the requests of all instructors.
void Simulation::apply_resume_requests() {
  for (const Fault& f : session_stop_faults_)
    if (now_ >= Time{} + f.at + f.length && now_ - tick_ < Time{} + f.at + f.length)
      for (std::size_t i = 0; i < clients_.size(); ++i)
        if (clients_[i].seat() != nullptr && setup_.scene.seats[i].role == Role::kInstructor)
          clients_[i].seat()->request_resume();
}

void Simulation::inject_attacks() {
  if (setup_.faults.empty()) return;
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const auto forged = clients_[i].attack_datagrams(now_);
    for (const std::size_t from : {i, kUnknownPeer}) {
      if (!forged.replayed.empty()) session_->on_datagram(now_, endpoint_of(from), forged.replayed);
      if (!forged.junk.empty()) session_->on_datagram(now_, endpoint_of(from), forged.junk);
    }
  }
}

void Simulation::update_record() {
  record_ = session_->record();
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const client::Seat* seat = clients_[i].seat();
    if (seat == nullptr) continue;
    server::record_seat(seat->sample(), record_.seats[i]);
    if (clients_[i].ran_in_tick()) record_.seats[i].sample_tick = record_.tick;  // else of the program's last tick
  }
  for (std::size_t j = 0; j < setup_.scene.tools.size(); ++j) {
    const ToolSpec& tool = setup_.scene.tools[j];
    if (!tool.remote) continue;
    const client::Seat* seat = clients_[tool.seat].seat();
    if (seat != nullptr) server::record_slave(seat->sample().telemetry, record_.tools[j]);
    record_.tools[j].sample_tick = record_.tick;
  }
}

}  // namespace tandem::netsim
