#include "netsim/world.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hal/port_map.h"
#include "netsim/world_waiting.h"
#include "server/session_record.h"

namespace tandem::netsim {

namespace {

/// @param address  which of the client's source addresses it is, at most Addresses::kMax
server::Endpoint endpoint_of(std::size_t seat, std::uint32_t address = 0) {
  server::Endpoint e;
  e.bytes[0] = static_cast<std::byte>(seat + 1);
  e.bytes[1] = static_cast<std::byte>(address & 0xff);
  e.bytes[2] = static_cast<std::byte>(address >> 8);
  e.size = 3;
  return e;
}

/// Of the seed, for the tokens of path challenges; seats have 1000 and more (world_station.cpp).
constexpr std::uint64_t kTokenKey = 999;

/// Where junk comes from besides the seats' own addresses.
constexpr std::size_t kStranger = 254;

/// Longest wait for a session to begin; covers joining over the longest delay there is, 60 s one way.
constexpr Duration kPatience = std::chrono::seconds(300);

std::size_t seat_of(const server::Endpoint& e) { return std::to_integer<std::size_t>(e.bytes[0]) - 1; }
std::uint32_t address_of(const server::Endpoint& e) {
  return std::to_integer<std::uint32_t>(e.bytes[1]) | std::to_integer<std::uint32_t>(e.bytes[2]) << 8;
}

}  // namespace

std::expected<std::unique_ptr<World>, std::string> World::make(const WorldSetup& setup) {
  std::unique_ptr<World> world{new World(setup)};
  const SceneSpec& scene = world->setup_.scene;
  // Time{} is the network's zero; the world begins one tick later so that no stamp is the empty one.
  world->now_ = Time{} + world->tick_;

  const auto known = [&](const std::string& seat) {
    return std::ranges::any_of(scene.seats, [&](const SeatSpec& s) { return s.name == seat; });
  };
  for (const Fault& fault : setup.faults)
    if (!fault.seat.empty() && !known(fault.seat)) return std::unexpected("a fault of seat " + fault.seat + ", which the scene has not");
  for (const auto& [seat, endpoint] : setup.endpoints) {
    if (!known(seat)) return std::unexpected("a clock of seat " + seat + ", which the scene has not");
    for (const SpecProblem& p : problems(endpoint)) return std::unexpected("seat " + seat + ": " + p.key + ": " + p.message);
  }
  world->stations_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    if (std::string trouble = world->add_station(i); !trouble.empty()) return std::unexpected(trouble);
  if (std::ranges::any_of(setup.endpoints, [](const auto& e) { return e.second.wake.kind != WakeSpec::Kind::kExact; })) {
    world->order_.resize(scene.seats.size());
    std::iota(world->order_.begin(), world->order_.end(), std::size_t{0});
  }
  std::ranges::copy_if(setup.faults, std::back_inserter(world->server_faults_),
                       [](const Fault& f) { return of_server(f.kind); });
  std::ranges::copy_if(setup.faults, std::back_inserter(world->stops_), [](const Fault& f) { return f.kind == Fault::Kind::kStopAll; });

  auto slaves = world->make_slaves(nullptr);
  if (!slaves) return std::unexpected(slaves.error());
  const hal::SteppedDevice& first = world->stations_[0].device();
  world->scale_ = hal::PortMap(scene.port, scene.dof, first.caps().joints).scale(first.state());
  world->session_ = std::make_unique<server::Session>(scene, std::move(*slaves), world->scale_);
  world->plug_contact_sources();
  world->checkpoint_ = world->session_->checkpoint();
  return world;
}

/// @param from  where they stand; null: where the scene says
std::expected<std::vector<std::unique_ptr<hal::SteppedDevice>>, std::string> World::make_slaves(const server::Checkpoint* from) const {
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

void World::plug_contact_sources() {
  if (!setup_.contact_source) return;
  for (std::size_t j = 0; j < setup_.scene.tools.size(); ++j) session_->set_contact_source(j, setup_.contact_source(j));
}

void World::keep_server() {
  const bool dead = std::ranges::any_of(server_faults_, [&](const Fault& f) {
    return f.kind == Fault::Kind::kServerRestart && now_ >= Time{} + f.at && now_ < Time{} + f.at + f.length;
  });
  if (up_ && dead) up_ = false;
  if (!up_ && !dead) restart_server();
}

/// Everything but the checkpoint is gone; that went through bytes, as it does through a file.
void World::restart_server() {
  std::array<std::byte, server::kCheckpointMax> bytes;
  const std::size_t size = server::encode_checkpoint(checkpoint_, bytes);
  const auto read = server::decode_checkpoint(std::span{bytes}.first(size));
  if (!read || !server::unfit(*read, setup_.scene).empty()) {
    trouble_ = "the checkpoint cannot be read back";
    return;
  }
  auto slaves = make_slaves(&*read);
  if (!slaves) {
    trouble_ = "after a restart: " + slaves.error();
    return;
  }
  session_ = std::make_unique<server::Session>(setup_.scene, std::move(*slaves), scale_, *read);
  plug_contact_sources();
  server_missed_ = 0;
  up_ = true;
}

/// Twice a second, and whenever somebody came, went, or changed who leads or who may move at all, or the session began.
void World::keep_checkpoint(bool people_changed) {
  constexpr Duration kEvery = std::chrono::milliseconds(500);
  if (!people_changed && now_ - checkpoint_at_ < kEvery && session_->authority_version() == checkpoint_.authority_version &&
      session_->stops() == checkpoint_.stops && session_->epoch() == checkpoint_.epoch && session_->begun() == checkpoint_.begun)
    return;
  checkpoint_ = session_->checkpoint();
  checkpoint_at_ = now_;
}

std::string World::add_station(std::size_t i) {
  const SeatSpec& spec = setup_.scene.seats[i];
  // A station steps its device through a tick before it reads it: the device begins one tick earlier.
  hal::sim::SimSetup sim{spec.device, spec.hand, spec.environment, nullptr, now_ - tick_};
  if (const auto m = setup_.motions.find(spec.name); m != setup_.motions.end()) {
    if (spec.hand.model != HandModel::kRecorded) sim.hand = person_instead_of(spec.hand, HandModel::kRecorded);
    sim.motion = m->second;
  }
  auto device = hal::sim::SimDevice::make(sim);
  if (!device) return "seat " + spec.name + ": " + device.error().message;

  WorldStation::Setup station{.scene = &setup_.scene, .seat = i, .seed = setup_.seed, .device = std::move(*device),
                              .faults = {}, .endpoint = {}};
  for (const Fault& fault : setup_.faults)
    if (!of_server(fault.kind) && (fault.seat.empty() || fault.seat == spec.name)) station.faults.push_back(fault);
  if (const auto e = setup_.endpoints.find(spec.name); e != setup_.endpoints.end()) station.endpoint = e->second;
  stations_.emplace_back(std::move(station));
  if (stations_.back().ever_suffers(Fault::Kind::kLiar)) watch_.excuse("energy_monotone", spec.name);
  // Nobody can account for motion that the encoders do not tell.
  if (stations_.back().ever_suffers(Fault::Kind::kFrozen)) watch_.excuse("loss_energy", spec.name);

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

bool World::step() {
  if (session_->over() || !trouble_.empty()) return false;
  if (!server_faults_.empty()) keep_server();
  if (!stops_.empty()) people_resume();
  serve_clients();
  std::uint32_t lived = 0;
  if (!up_) {
    for (std::size_t i = 0; i < stations_.size(); ++i)  // to a closed port
      while (network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_)) {}
  } else if (server_stands_still()) {
    ++server_missed_;
  } else {
    lived = server_missed_ + 1;
    serve_server();
  }
  if (setup_.keep_record) take_record();
  watch_.check(lived, *session_, stations_);
  give_up_waiting();
  if (setup_.watch_quality && qualities_.empty() && session_->state() == wire::SessionState::kRunning) watch_links();
  now_ += tick_;
  return !session_->over() && trouble_.empty();
}

/// Joining is slower and waits for people: what it meets is not judged.
void World::watch_links() {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    qualities_.push_back(std::make_unique<LinkWatch>(now_));
    network_.watch(static_cast<std::uint32_t>(i), qualities_.back().get());
  }
}

/// A session that cannot begin would wait for ever; people get the reason instead.
void World::give_up_waiting() {
  if (session_->state() != wire::SessionState::kWaiting || now_ - Time{} < kPatience) return;
  trouble_ = "the session did not begin within " + std::to_string(kPatience / std::chrono::seconds(1)) + " s of virtual time";
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const client::Seat* seat = stations_[i].seat();
    if (seat == nullptr || !seat->gate().active()) trouble_ += "; " + why_not_engaged(setup_.scene, i, seat, *session_, stations_[i].own_time(now_), now_);
  }
}

void World::serve_clients() {
  // Who wakes up first sends first: on a link that is shared nobody's datagram may enter before an older one.
  for (std::size_t i = 1; i < order_.size(); ++i)
    for (std::size_t j = i; j > 0 && works_before(order_[j], order_[j - 1]); --j) std::swap(order_[j], order_[j - 1]);
  for (std::size_t n = 0; n < stations_.size(); ++n) {
    const std::size_t i = order_.empty() ? n : order_[n];
    WorldStation& station = stations_[i];
    const client::Seat* const before = station.seat();
    const std::uint32_t joins = station.joins();
    const std::uint64_t taken = heap_taken();
    if (std::string trouble = station.step(now_, up_ ? session_.get() : nullptr, network_, buffer_); !trouble.empty()) trouble_ = std::move(trouble);
    // A program that starts, joins or dies is no tick yet, or no more.
    if (before != nullptr && before == station.seat() && joins == station.joins() && heap_taken() != taken) watch_.took_heap(i);
  }
}

bool World::works_before(std::size_t a, std::size_t b) const noexcept {
  return std::pair{stations_[a].wakes_at(now_), a} < std::pair{stations_[b].wakes_at(now_), b};
}

bool World::server_stands_still() const noexcept {
  return now_ < busy_until_ || std::ranges::any_of(server_faults_, [&](const Fault& f) { return f.kind == Fault::Kind::kServerLate && now_ >= Time{} + f.at && now_ < Time{} + f.at + f.length; });
}

void World::serve_server() {
  const std::uint64_t taken = heap_taken();
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    while (const auto d = network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_)) {
      const auto bytes = std::span{buffer_}.first(std::min(d->size, buffer_.size()));
      watch_.server_heard(i, d->index);
      stations_[i].overheard(bytes);
      session_->on_datagram(now_, endpoint_of(i, d->address), bytes);
    }
  }
  attack_server();
  session_->relieve(ladder_.step(now_, server_missed_ * tick_, tick_used_));
  session_->on_tick(now_, server_missed_);
  if (session_->path_tokens().low()) fill_path_tokens(*session_, RandomKey{setup_.seed}.derive(kTokenKey), token_draws_ += server::PathTokens::kMax);
  server_missed_ = 0;
  std::size_t sent = 0;
  while (const auto out = session_->poll_transmit(now_, buffer_)) {
    ++sent;
    const std::size_t to = seat_of(out->to);
    if (to >= stations_.size()) {
      watch_.server_answered_a_stranger(session_->time());
      continue;
    }
    network_.send_to(now_, static_cast<std::uint32_t>(to), address_of(out->to), std::span{buffer_}.first(out->size));
  }
  if (heap_taken() != taken) watch_.took_heap();
  if (setup_.tick_cost) {
    tick_used_ = setup_.tick_cost(now_, sent);
    busy_until_ = now_ + tick_used_;
  }
  bool people_changed = false;
  while (const auto event = session_->poll_audit()) {
    people_changed |= event->what == server::AuditEvent::What::kJoin || event->what == server::AuditEvent::What::kLeave;
    watch_.noted(*event);
    if (on_audit) on_audit(*event);
  }
  keep_checkpoint(people_changed);
}

/// The session's stop of one person is ended by all instructors.
void World::people_resume() {
  for (const Fault& f : stops_)
    if (now_ >= Time{} + f.at + f.length && now_ - tick_ < Time{} + f.at + f.length)
      for (std::size_t i = 0; i < stations_.size(); ++i)
        if (stations_[i].seat() != nullptr && setup_.scene.seats[i].role == Role::kInstructor) stations_[i].seat()->press_resume();
}

void World::attack_server() {
  if (setup_.faults.empty()) return;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const auto forged = stations_[i].forged(now_);
    for (const std::size_t from : {i, kStranger}) {
      if (!forged.replayed.empty()) session_->on_datagram(now_, endpoint_of(from), forged.replayed);
      if (!forged.junk.empty()) session_->on_datagram(now_, endpoint_of(from), forged.junk);
    }
  }
}

void World::take_record() {
  record_ = session_->record();
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const client::Seat* seat = stations_[i].seat();
    if (seat == nullptr) continue;
    server::put_seat(seat->sample(), record_.seats[i]);
    if (stations_[i].served_now()) record_.seats[i].sample_tick = record_.tick;  // else as old as its program left it
  }
  for (std::size_t j = 0; j < setup_.scene.tools.size(); ++j) {
    const ToolSpec& tool = setup_.scene.tools[j];
    if (!tool.remote) continue;
    const client::Seat* seat = stations_[tool.seat].seat();
    if (seat != nullptr) server::put_slave(seat->sample().telemetry, record_.tools[j]);
    record_.tools[j].sample_tick = record_.tick;
  }
}

}  // namespace tandem::netsim
