#include "netsim/feel/probe_scene.h"

#include <algorithm>
#include <stdexcept>

#include "netsim/system/simulation.h"
#include "netsim/system/simulation_report.h"

namespace tandem::netsim {
namespace {

/// Returns the name of a hand's seat: leader, follower, follower-2, follower-3, ...
std::string name_of_hand(std::size_t hand) {
  if (hand == 0) return "leader";
  return hand == 1 ? "follower" : "follower-" + std::to_string(hand);
}

SimDeviceSpec placed(SimDeviceSpec device, const ProbeRun& run) {
  device.start = {run.start_x, 0, 0};
  if (run.frictionless) device.friction = 0;
  return device;
}

/// Clients that do not tick with the server wake up late by up to this, as real timers do.
constexpr Duration kLateMax = std::chrono::microseconds(20);

void set_phases(ClientPhases phases, SimulationConfig& config) {
  if (phases == ClientPhases::kServers) return;
  const RandomKey key = RandomKey{config.seed}.derive(0x7068'6173'65);
  const Duration tick = from_seconds(1.0 / config.scene.tick_hz);
  const Duration rested = (2 * tick - tick / 6 - config.network.up.floor % tick) % tick;
  for (std::size_t i = 0; i < config.scene.seats.size(); ++i) {
    const Duration drawn = from_seconds(key.uniform(i) / config.scene.tick_hz);
    config.endpoints[config.scene.seats[i].name].wake = {.kind = WakeSpec::Kind::kUniform,
                                                         .late_max = kLateMax,
                                                         .phase = phases == ClientPhases::kRested ? rested : drawn,
                                                         .shifts = phases == ClientPhases::kShifted};
  }
}

hal::Vec3 vector_of(const server::Triple& v) { return {v[0], v[1], v[2]}; }

void add_row(FeelTrace& trace, const Simulation& simulation) {
  const server::TickRecord& record = simulation.record();
  trace.t.push_back(record.tick / trace.tick_hz);
  for (std::size_t i = 0; i < trace.hands.size(); ++i) {
    const server::SeatRecord& seat = record.seats[i];
    FeelTrace::Hand& hand = trace.hands[i];
    hand.x.push_back(vector_of(seat.x));
    hand.f.push_back(vector_of(seat.f_out));
    hand.f_cmd.push_back(vector_of(seat.f_cmd));
    hand.engaged.push_back(seat.engaged ? 1 : 0);
    hand.alpha.push_back(seat.alpha);
    hand.work.push_back(simulation.client(i).motor_work());
    hand.trips.push_back(simulation.client(i).program().gate_trips());
    const SimulatedClient& client = simulation.client(i);
    hand.loop.push_back(client.seat() == nullptr
                            ? kNaN
                            : seconds(client.seat()->link().timing().loop_age(client.own_time(client.last_run()))));
    if (!simulation.scene().send.is_on() || simulation.seat(i) == nullptr) continue;
    const transport::SecureChannel* const down = simulation.session().seat(i).link();
    hand.sent_up.push_back(simulation.seat(i)->link().stats().sent);
    hand.sent_down.push_back(down != nullptr ? down->stats().sent : 0);
  }
  const server::ToolRecord& tool = record.tools[0];
  trace.tool.push_back(vector_of(tool.x));
  trace.f_env.push_back(vector_of(tool.f_env));
  trace.held.push_back(tool.held ? 1 : 0);
}

}  // namespace

EnvironmentSpec wall_of(double k) {
  return {.wall = WallSpec{.axis = 0, .at = 0, .k = k, .b = 5, .from_below = true}, .tissue = {}};
}

SimulationConfig simulation_config_of(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed) {
  SimulationConfig out{.scene = setup.scene, .network = run.perfect_network ? LinkSpec{} : setup.network, .seed = seed};
  SceneSpec& scene = out.scene;
  const SceneSpec& given = setup.scene;
  scene.name = "probe of " + given.name;
  scene.duration = run.length;
  scene.seats.clear();
  scene.tools.clear();
  scene.timeline.clear();
  scene.phases.clear();
  scene.follow = {};
  const std::size_t masters = given.masters();
  for (std::size_t i = 0; i < run.hands.size(); ++i) {
    SeatSpec seat = given.seats[std::min(i, masters - 1)];
    seat.name = name_of_hand(i);
    seat.role = i == 0 ? Role::kInstructor : Role::kTrainee;
    seat.required = true;
    seat.device = placed(seat.device, run);
    seat.hand = run.hands[i].hand;
    if (run.hands[i].motion) out.motions[seat.name] = run.hands[i].motion;
    scene.seats.push_back(std::move(seat));
    scene.follow[i][0] = 1;
  }
  ToolSpec tool = given.tools[0];
  if (tool.remote) {
    SeatSpec slave = given.seats[tool.seat];
    slave.tool = 0;
    slave.required = true;
    slave.device = placed(slave.device, run);
    slave.environment = run.environment;
    tool.seat = scene.seats.size();
    scene.seats.push_back(std::move(slave));
  } else {
    tool.slave = placed(tool.slave, run);
    tool.environment = run.environment;
  }
  scene.tools.push_back(std::move(tool));
  AuthorityRow row;
  row.alpha[0] = run.share;
  const double others = std::max(1.0, static_cast<double>(run.hands.size()) - 1);
  for (std::size_t i = 1; i < std::max<std::size_t>(2, run.hands.size()); ++i) row.alpha[i] = (1 - run.share) / others;
  scene.authority = {row};
  if (run.hand_over_at > 0) {
    AuthorityRow other;
    other.alpha[1] = 1;
    scene.timeline = {{run.hand_over_at, other}};
  }
  set_phases(setup.phases, out);
  return out;
}

FeelTrace run_probe(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed) {
  const SimulationConfig simulation_config = simulation_config_of(setup, run, seed);
  FeelTrace trace;
  trace.tick_hz = simulation_config.scene.tick_hz;
  auto made = Simulation::make(simulation_config);
  if (!made) {
    trace.trouble = made.error();
    return trace;
  }
  Simulation& simulation = **made;
  trace.hands.resize(run.hands.size());
  for (std::size_t i = 0; i < trace.hands.size(); ++i) {
    const SeatSpec& seat = simulation_config.scene.seats[i];
    trace.hands[i].force_max =
        std::min(seat.device.force_peak, simulation_config.scene.gate.force_max * share_of_force(seat.role));
  }
  std::vector<ProbePush> pushes = run.pushes;
  while (simulation.step()) {
    if (!simulation.record().running) continue;
    add_row(trace, simulation);
    std::erase_if(pushes, [&](const ProbePush& push) {
      if (trace.t.back() < push.at) return false;
      simulation.device(push.hand).push(push.force, push.length);
      return true;
    });
  }
  trace.trouble = simulation.trouble();
  for (const server::Violation& violation : simulation.violations().list())
    if (!violation.expected && std::ranges::find(trace.broken, violation.invariant) == trace.broken.end())
      trace.broken.push_back(violation.invariant);
  if (trace.rows() == 0 && trace.trouble.empty()) trace.trouble = "the session never ran";
  trace.one_way_s = std::max(0.0, 0.5 * (link_reports(simulation)[0].rtt_p50_ms * 1e-3 - 1 / trace.tick_hz));
  return trace;
}

}  // namespace tandem::netsim
