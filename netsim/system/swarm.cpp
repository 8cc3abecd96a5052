#include "netsim/system/swarm.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "common/base/format.h"
#include "common/base/milliseconds.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/system/random_draws.h"
#include "netsim/system/scene_generator.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {

namespace {

enum Purpose : std::uint64_t { kScene = 1, kTimes, kLinks, kFaults, kClocks };

RandomKey key_of(std::uint64_t seed, Purpose purpose) { return RandomKey{seed}.derive(0x5a).derive(purpose); }

/// Draws one direction; every impairment has its own probability.
PathSpec draw_path(RandomDraws& d) {
  PathSpec path;
  path.floor = from_milliseconds(d.chance(0.3) ? 0 : d.log_between(0.05, 200));
  if (d.chance(0.5)) {
    path.body.kind = BodySpec::Kind::kUniform;
    path.body.high = from_milliseconds(d.log_between(0.1, 60));
    if (d.chance(0.5)) path.body.tau = from_milliseconds(d.log_between(1, 300));
  }
  if (d.chance(0.3)) path.loss.probability = d.log_between(0.001, 0.6);
  if (d.chance(0.3)) {
    const Duration good = from_milliseconds(d.log_between(50, 5000)), bad = from_milliseconds(d.log_between(1, 300));
    path.loss.periods = BadPeriodsSpec{good, bad, 0, d.between(0.3, 1)};
  }
  if (d.chance(0.3)) {
    path.stall.rate_per_s = d.between(0.05, 2);
    path.stall.length_min = from_milliseconds(d.log_between(2, 100));
    path.stall.cap = path.stall.length_min + from_milliseconds(d.log_between(1, 600));
  }
  if (d.chance(0.25)) {
    path.rate.bits_per_s = static_cast<std::uint64_t>(d.log_between(2e6, 1e8));
    path.rate.queue_wait = from_milliseconds(d.log_between(5, 500));
  }
  if (d.chance(0.2)) path.reorder.probability = d.log_between(0.001, 0.3);
  if (d.chance(0.2)) path.order = ArrivalOrder::kFree;
  if (d.chance(0.3)) path.duplicate = {d.log_between(0.001, 0.5), from_milliseconds(d.log_between(0.01, 50))};
  if (d.chance(0.1)) path.corruption.probability = d.log_between(0.001, 0.1);
  return path;
}

LinkSpec draw_link(RandomDraws& d, std::string& words) {
  if (d.chance(0.4)) {
    const auto shipped = complete_profiles();
    const EmbeddedFile& chosen = shipped[d.below(shipped.size())];
    const auto profile = shipped_profile(chosen.name);
    if (profile && !profile->capacity_file) {  // such a profile needs a recording
      words = chosen.name;
      return profile->link;
    }
  }
  words = "own";
  return {draw_path(d), draw_path(d)};
}

NetworkEvent change(Duration at, const LinkSpec& link, const std::string& client = {}) {
  return {.at = at, .clients = client.empty() ? std::vector<std::string>{} : std::vector{client}, .link = link};
}

/// Draws a time in the fault phase.
Duration draw_moment(RandomDraws& d, const SwarmCase& out) {
  return from_milliseconds(d.between(0, 1e3 * seconds(out.recovery_start)));
}

void draw_network(SwarmCase& out) {
  RandomDraws d(key_of(out.seed, kLinks));
  LinkSpec clean;
  clean.up.floor = clean.down.floor = from_milliseconds(d.chance(0.3) ? 0 : d.log_between(0.05, 60));
  std::string words;
  const LinkSpec bad = draw_link(d, words);
  const Duration begin = d.chance(0.4) ? Duration{} : from_milliseconds(d.between(100, 2000));
  out.setup.network = begin == Duration{} ? bad : clean;
  if (begin > Duration{} && begin < out.recovery_start) out.setup.events.push_back(change(begin, bad));
  for (const SeatSpec& seat : out.setup.scene.seats) {
    if (d.chance(0.2)) {
      std::string own;
      const Duration at = draw_moment(d, out);
      if (at > begin && at < out.recovery_start) out.setup.events.push_back(change(at, draw_link(d, own), seat.name));
    }
    for (std::size_t n = d.chance(0.4) ? 1 + d.below(4) : 0; n > 0; --n) {
      NetworkEvent event{.at = draw_moment(d, out), .clients = {seat.name}};
      if (d.chance(0.3)) event.direction = d.chance(0.5) ? Direction::kUp : Direction::kDown;
      event.outage =
          OutageSpec{.length = std::min(from_milliseconds(d.log_between(1, 3000)), out.recovery_start - event.at),
                     .mode = d.chance(0.5) ? OutageSpec::Mode::kDrop : OutageSpec::Mode::kHold};
      if (event.outage->length > Duration{}) out.setup.events.push_back(event);
    }
  }
  out.setup.events.push_back(change(out.recovery_start, clean));
  std::ranges::stable_sort(out.setup.events, {}, &NetworkEvent::at);
  out.description += ", " + words;
}

/// Adds the part of a fault that lies in the fault phase.
/// @return false: no part does
bool add_fault(SwarmCase& out, Fault fault) {
  fault.length = std::min(fault.length, out.recovery_start - fault.at);
  if (fault.length <= Duration{}) return false;
  out.description += ", " + std::string(name(fault.kind));
  out.setup.faults.push_back(std::move(fault));
  return true;
}

void draw_faults(SwarmCase& out) {
  RandomDraws d(key_of(out.seed, kFaults));
  struct Choice {
    Fault::Kind kind;
    double shortest_ms, longest_ms;
  };
  constexpr std::array kChoices{Choice{Fault::Kind::kPause, 2, 1500},     Choice{Fault::Kind::kRestart, 50, 4000},
                                Choice{Fault::Kind::kNotANumber, 1, 30},  Choice{Fault::Kind::kOutOfRange, 1, 30},
                                Choice{Fault::Kind::kFrozen, 5, 1000},    Choice{Fault::Kind::kReplay, 100, 5000},
                                Choice{Fault::Kind::kJunk, 100, 3000},    Choice{Fault::Kind::kLiar, 100, 10000},
                                Choice{Fault::Kind::kServerLate, 2, 800}, Choice{Fault::Kind::kServerRestart, 20, 4000},
                                Choice{Fault::Kind::kStopHand, 20, 5000}, Choice{Fault::Kind::kStopAll, 20, 5000},
                                Choice{Fault::Kind::kHostile, 5, 3000}};
  for (std::size_t n = d.below(5); n > 0; --n) {
    const Choice& c = kChoices[d.below(kChoices.size())];
    Fault fault{c.kind, {}, draw_moment(d, out), from_milliseconds(d.log_between(c.shortest_ms, c.longest_ms))};
    if (!of_server(fault.kind) && !d.chance(0.1))
      fault.seat = out.setup.scene.seats[d.below(out.setup.scene.seats.size())].name;
    if (!add_fault(out, fault)) continue;
    // The attacker meets a stop of the instructor, which the attacker may not end.
    if (c.kind == Fault::Kind::kHostile && d.chance(0.5))
      add_fault(out, {Fault::Kind::kStopAll, out.setup.scene.seats[0].name, fault.at, fault.length});
  }
  // Drawn last, so that older faults of a seed do not change when this kind is added.
  for (std::size_t n = d.chance(0.15) ? 1 + d.below(4) : 0; n > 0; --n) {
    const Fault hot{Fault::Kind::kHot, out.setup.scene.seats[d.below(out.setup.scene.seats.size())].name,
                    draw_moment(d, out), from_milliseconds(d.log_between(2, 2000))};
    add_fault(out, hot);
  }
}

void draw_clocks(SwarmCase& out) {
  RandomDraws d(key_of(out.seed, kClocks));
  for (const SeatSpec& seat : out.setup.scene.seats) {
    if (!d.chance(0.3)) continue;
    EndpointSpec endpoint{.offset = from_milliseconds(d.between(-8e7, 8e7)), .drift_ppm = d.between(-200, 200)};
    if (d.chance(0.2)) endpoint.steps = {{draw_moment(d, out), from_milliseconds(d.log_between(1, 1e6))}};
    if (d.chance(0.3))
      endpoint.wake = {WakeSpec::Kind::kUniform, from_milliseconds(d.log_between(0.1, 5))};
    else if (d.chance(0.3))
      endpoint.wake.kind = WakeSpec::Kind::kMeasured;
    out.setup.endpoints[seat.name] = endpoint;
  }
}

std::uint64_t mixed(std::uint64_t into, double value) noexcept {
  return mix64(into ^ std::bit_cast<std::uint64_t>(value));
}

/// Lets a simulated user reset every latched device, at intervals. If the client reports a stuck sensor, the user also
/// pushes the handle, because only a new reading ends that state. A hand at the end of its arm's travel, or in a pose
/// where the motors have no lever, counts as a frozen sensor.
void press_buttons(Simulation& simulation) {
  for (std::size_t i = 0; i < simulation.scene().seats.size(); ++i) {
    client::Seat* const seat = simulation.seat(i);
    if (seat == nullptr) continue;
    const auto phase = seat->gate().phase();
    if (phase == control::GatePhase::kLatched || phase == control::GatePhase::kFault ||
        seat->guards().overspeed().latched() || seat->guards().overtemperature().latched())
      seat->requests().reset_gate();
    const wire::SessionState session = seat->force().session;
    if (seat->guards().stuck_sensor().stuck()) {
      constexpr double kPush = 2, kPushLength = 0.05;  // [N], [s]
      const hal::Vec3 from_home = simulation.device(i).ground_truth().x;
      simulation.device(i).push(kPush * from_home.unaryExpr([](double x) { return x > 0 ? -1.0 : 1.0; }), kPushLength);
    }
    if (seat->requests().locally_stopped() || session == wire::SessionState::kPaused ||
        session == wire::SessionState::kStopped)
      seat->requests().resume();
  }
}

/// Returns whether the seat is active. An observer's hand is never engaged; an observer with a client counts as active.
bool active(const Simulation& simulation, std::size_t i) {
  const client::Seat* const seat = simulation.seat(i);
  if (seat == nullptr) return false;
  const SeatSpec& spec = simulation.scene().seats[i];
  return (spec.kind == SeatKind::kMaster && spec.role == Role::kObserver) ||
         seat->gate().phase() == control::GatePhase::kActive;
}

const char* gate_words(control::GatePhase phase) {
  if (phase == control::GatePhase::kReleasing) return "releasing";
  if (phase == control::GatePhase::kLatched) return "LATCHED";
  return wire::to_text(static_cast<wire::GateState>(phase));
}

bool everybody_active(const Simulation& simulation) {
  if (simulation.session().state() != wire::SessionState::kRunning) return false;
  for (std::size_t i = 0; i < simulation.scene().seats.size(); ++i)
    if (!active(simulation, i)) return false;
  return true;
}

std::string inactive_seats_text(const Simulation& simulation) {
  std::string text = format("recovery phase: not every seat was active again after %g s:", kRecoveryLimit);
  for (std::size_t i = 0; i < simulation.scene().seats.size(); ++i) {
    if (active(simulation, i)) continue;
    const client::Seat* const seat = simulation.seat(i);
    text += " " + simulation.scene().seats[i].name + " " +
            (seat == nullptr ? "has no seat" : gate_words(seat->gate().phase())) + ";";
  }
  if (simulation.session().state() != wire::SessionState::kRunning) text += " the session does not run";
  return text;
}

}  // namespace

SwarmCase generate_swarm_case(std::uint64_t seed, double safety_max, LawKind law) {
  SwarmCase out;
  out.seed = seed;
  RandomDraws d(key_of(seed, kTimes));
  out.recovery_start = from_milliseconds(1e3 * d.between(1, std::max(2.0, safety_max)));
  out.scene_text =
      generate_scene_text(key_of(seed, kScene), std::ceil(seconds(out.recovery_start)) + 2 * kRecoveryLimit, law);
  auto scene = parse_scene(out.scene_text, format("swarm-%llu.textproto", static_cast<unsigned long long>(seed)));
  if (!scene) throw std::logic_error("swarm: seed " + std::to_string(seed) + ": " + to_text(scene.error()));
  out.description =
      format("%zu masters, %zu tools, %.1f s", scene->masters(), scene->tools.size(), seconds(out.recovery_start));
  out.setup.scene = std::move(*scene);
  out.setup.seed = seed;
  out.setup.keep_record = false;
  draw_network(out);
  draw_faults(out);
  draw_clocks(out);
  return out;
}

SwarmResult run_swarm_case(const SwarmCase& which, const std::function<void(Simulation&)>& each_tick) {
  SwarmResult result;
  auto made = Simulation::make(which.setup);
  if (!made) {
    result.trouble = made.error();
    return result;
  }
  Simulation& simulation = **made;
  const Time calm = Time{} + which.recovery_start;
  Time end = calm + from_seconds(kRecoveryLimit);
  Time buttons = calm, delivered = calm;
  bool recovered = false;
  // A datagram of the fault phase is still under way. A link that keeps order delivers nothing newer before it.
  bool held_back = true;
  while (simulation.now() < end) {
    if (simulation.now() >= buttons) {
      press_buttons(simulation);
      buttons += from_milliseconds(500);
    }
    const bool goes_on = simulation.step();
    for (std::size_t i = 0; i < simulation.scene().seats.size(); ++i) {
      if (simulation.seat(i) != nullptr)
        result.fingerprint = mixed(result.fingerprint, simulation.seat(i)->effort()[0]);
      result.fingerprint = mixed(result.fingerprint, simulation.device(i).ground_truth().x[0]);
    }
    if (each_tick) each_tick(simulation);
    if (!goes_on) break;
    if (held_back && simulation.now() > calm) {
      const auto oldest = simulation.network().oldest_in_flight();
      held_back = oldest && *oldest < calm;
      delivered = simulation.now();
      end = delivered + from_seconds(kRecoveryLimit);
    }
    if (!recovered && simulation.now() > calm && everybody_active(simulation)) {
      recovered = true;
      result.recovered_s = seconds(simulation.now() - delivered);
      if (!simulation.begin_recovery_phase()) break;
      end = simulation.now() + from_seconds(kOrdinaryMotionDuration);
    }
  }
  result.lived_s = seconds(simulation.now() - Time{});
  result.trouble = simulation.trouble();
  if (result.trouble.empty() && !recovered) result.trouble = inactive_seats_text(simulation);
  for (const server::Violation& violation : simulation.violations().list())
    if (!violation.expected) result.violations.push_back(violation);
  for (std::size_t i = 0; i < simulation.scene().seats.size(); ++i)
    result.gate_trips += simulation.client(i).program().gate_trips();
  result.links = simulation.link_qualities();
  return result;
}

}  // namespace tandem::netsim
