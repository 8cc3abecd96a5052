#include "netsim/system/simulation.h"

#include <algorithm>
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

/// Address of random bytes from outside, besides the seats' own addresses.
constexpr std::size_t kUnknownPeer = 254;

/// Longest wait for a session to begin. It covers a join over the longest possible delay, 60 s one way.
constexpr Duration kStartTimeout = std::chrono::seconds(300);

std::size_t seat_of(const server::PeerAddress& e) { return std::to_integer<std::size_t>(e.bytes[0]) - 1; }
std::uint32_t address_of(const server::PeerAddress& e) {
  return std::to_integer<std::uint32_t>(e.bytes[1]) | std::to_integer<std::uint32_t>(e.bytes[2]) << 8;
}

/// Returns the first fault or endpoint of a seat that the scene does not have, or an invalid endpoint; empty: none.
std::string config_error(const SimulationConfig& setup) {
  const auto known = [&](const std::string& seat) {
    return std::ranges::find(setup.scene.seats, seat, &SeatSpec::name) != setup.scene.seats.end();
  };
  for (const Fault& fault : setup.faults)
    if (!fault.seat.empty() && !known(fault.seat)) return "a fault of seat " + fault.seat + ", which the scene has not";
  for (const std::string& seat : setup.free_seats) {
    if (!known(seat)) return "a free seat " + seat + ", which the scene has not";
    if (std::ranges::find(setup.scene.seats, seat, &SeatSpec::name)->required)
      return "seat " + seat + " cannot stay free: the session does not begin without it (required)";
  }
  for (const auto& [seat, endpoint] : setup.endpoints) {
    if (!known(seat)) return "a clock of seat " + seat + ", which the scene has not";
    for (const SpecError& p : problems(endpoint)) return "seat " + seat + ": " + p.key + ": " + p.message;
  }
  return {};
}

/// Returns why a session did not begin in time, by seat.
std::string start_timeout_text(const SceneSpec& scene, const server::Session& session,
                               const std::vector<SimulatedClient>& clients, Time now) {
  std::string text = "the session did not begin within " + std::to_string(kStartTimeout / std::chrono::seconds(1)) +
                     " s of virtual time";
  for (std::size_t i = 0; i < clients.size(); ++i) {
    const client::Seat* seat = clients[i].seat();
    if (seat == nullptr || !seat->gate().active())
      text += "; " + not_engaged_reason(scene, i, seat, session, clients[i].own_time(now), now);
  }
  return text;
}

/// Sets the record of the session with the values of every seat in this tick, without the delay of the network.
void update_record(const SceneSpec& scene, const server::Session& session, const std::vector<SimulatedClient>& clients,
                   server::TickRecord& record) {
  record = session.record();
  for (std::size_t i = 0; i < clients.size(); ++i) {
    const client::Seat* seat = clients[i].seat();
    if (seat == nullptr) continue;
    server::record_seat(seat->sample(), seat->sample().telemetry, scene.port, seat->setup().seat.motion_scale,
                        record.seats[i]);
    if (clients[i].ran_in_tick()) record.seats[i].sample_tick = record.tick;  // else of the program's last tick
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    const ToolSpec& tool = scene.tools[j];
    if (!tool.remote) continue;
    const client::Seat* seat = clients[tool.seat].seat();
    if (seat != nullptr) server::record_slave(seat->sample().telemetry, record.tools[j]);
    record.tools[j].sample_tick = record.tick;
  }
}

}  // namespace

std::expected<std::unique_ptr<Simulation>, std::string> Simulation::make(const SimulationConfig& setup) {
  std::unique_ptr<Simulation> made{new Simulation(setup)};
  Simulation& simulation = *made;
  const SceneSpec& scene = simulation.setup_.scene;
  if (std::string error = config_error(setup); !error.empty()) return std::unexpected(std::move(error));
  simulation.clients_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    if (std::string trouble = simulation.add_client(i); !trouble.empty()) return std::unexpected(trouble);
  const hal::SteppedDevice& first = simulation.clients_[0].device();
  const AxisArray scale = hal::PortMap(scene.port, scene.dof, first.caps().joints).scale(first.state());
  if (std::string error = simulation.server_.start(simulation.now_, scale); !error.empty())
    return std::unexpected(std::move(error));
  return made;
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

  SimulatedClient::Setup client{.scene = &setup_.scene,
                                .seat = i,
                                .seed = setup_.seed,
                                .device = std::move(*device),
                                .faults = {},
                                .endpoint = {},
                                .never_starts = setup_.free_seats.contains(spec.name)};
  for (const Fault& fault : setup_.faults)
    if (!of_server(fault.kind) && (fault.seat.empty() || fault.seat == spec.name)) client.faults.push_back(fault);
  if (const auto e = setup_.endpoints.find(spec.name); e != setup_.endpoints.end()) client.endpoint = e->second;
  const FaultSchedule& faults = clients_.emplace_back(std::move(client)).faults();
  if (faults.contains(Fault::Kind::kLiar)) checker_.expect("energy_monotone", spec.name);
  // No client can account for motion that the encoders do not report.
  if (faults.contains(Fault::Kind::kFrozen)) checker_.expect("loss_energy", spec.name);

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
  if (session().over() || !trouble_.empty()) return false;
  if (std::string error = server_.apply_restarts(now_); !error.empty()) trouble_ = std::move(error);
  request_resumes();
  step_clients();
  std::uint32_t lived = 0;
  if (!server_.up()) {
    for (std::size_t i = 0; i < clients_.size(); ++i)  // as if sent to a closed port
      while (network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_)) {
      }
  } else {
    lived = server_.due_ticks(now_);
    if (lived > 0) step_server();
  }
  if (setup_.keep_record) update_record(setup_.scene, session(), clients_, record_);
  checker_.check(lived, session(), clients_);
  // Without a limit, a simulation whose session does not begin would never end.
  if (session().state() == wire::SessionState::kWaiting && now_ - Time{} >= kStartTimeout)
    trouble_ = start_timeout_text(setup_.scene, session(), clients_, now_);
  if (setup_.monitor_quality && !link_monitors_.started() && session().state() == wire::SessionState::kRunning)
    link_monitors_.start(now_, network_);
  now_ += tick_;
  return !session().over() && trouble_.empty();
}

void Simulation::step_clients() {
  for (const std::size_t i : order_.sort([this](std::size_t client) { return clients_[client].wake_time(now_); })) {
    SimulatedClient& client = clients_[i];
    const client::Seat* const before = client.seat();
    const std::uint32_t joins = client.program().joins();
    const std::uint64_t taken = setup_.heap_taken();
    if (std::string trouble = client.step(now_, server_.up() ? &server_.session() : nullptr, network_, buffer_);
        !trouble.empty())
      trouble_ = std::move(trouble);
    // A program that starts, joins or dies does not run a tick here.
    if (before != nullptr && before == client.seat() && joins == client.program().joins() &&
        setup_.heap_taken() != taken)
      checker_.note_heap_violation(i);
  }
}

void Simulation::step_server() {
  const std::uint64_t taken = setup_.heap_taken();
  receive_at_server();
  inject_attacks();
  server_.run(now_);
  const std::size_t sent = send_from_server();
  if (setup_.heap_taken() != taken) checker_.note_heap_violation();
  server_.finish(now_, sent);
  bool participants_changed = false;
  while (const auto event = server_.session().audit().poll()) {
    participants_changed |=
        event->what == server::AuditEvent::What::kJoin || event->what == server::AuditEvent::What::kLeave;
    checker_.on_audit_event(*event);
    if (on_audit) on_audit(*event);
  }
  server_.update_checkpoint(now_, participants_changed);
}

void Simulation::receive_at_server() {
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    while (const auto d = network_.poll(now_, static_cast<std::uint32_t>(i), Direction::kUp, buffer_)) {
      const auto bytes = std::span{buffer_}.first(std::min(d->size, buffer_.size()));
      checker_.on_server_datagram(i, d->index);
      clients_[i].remember_for_replay(bytes);
      server_.session().on_datagram(d->at, endpoint_of(i, d->address), bytes);
    }
  }
}

/// Returns the number of datagrams that the server sent.
std::size_t Simulation::send_from_server() {
  std::size_t sent = 0;
  while (const auto out = server_.session().poll_transmit(now_, buffer_)) {
    ++sent;
    const std::size_t to = seat_of(out->to);
    if (to >= clients_.size()) {
      checker_.on_reply_to_unknown_peer(session().clock().time());
      continue;
    }
    network_.send_to(now_, static_cast<std::uint32_t>(to), address_of(out->to), std::span{buffer_}.first(out->size));
  }
  return sent;
}

/// Ends stops of the session after their length, by the requests of all instructors.
void Simulation::request_resumes() {
  if (!faults_.ended(Fault::Kind::kStopAll, now_ - tick_, now_)) return;
  for (std::size_t i = 0; i < clients_.size(); ++i)
    if (clients_[i].seat() != nullptr && setup_.scene.seats[i].role == Role::kInstructor)
      clients_[i].seat()->requests().resume();
}

void Simulation::inject_attacks() {
  if (faults_.empty()) return;
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const auto forged = clients_[i].attack_datagrams(now_);
    for (const std::size_t from : {i, kUnknownPeer}) {
      if (!forged.replayed.empty()) server_.session().on_datagram(now_, endpoint_of(from), forged.replayed);
      if (!forged.junk.empty()) server_.session().on_datagram(now_, endpoint_of(from), forged.junk);
    }
  }
}

}  // namespace tandem::netsim
