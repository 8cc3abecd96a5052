#include "client/app/seat_screen.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "client/app/authority_transfer_text.h"
#include "client/app/console_commands.h"
#include "client/app/recording_text.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::client {
namespace {

constexpr std::size_t kBar = 10;         // [characters] width of a force bar
constexpr double kSilenceMax = 0.5;      // [s] silence up to which the server counts as present
constexpr std::size_t kReasonMax = 160;  // [bytes] longest shown reason of a stop by another participant

using Words = std::optional<rpc::Status>;

bool is_slave(const SeatSetup& setup) { return setup.seat.kind == SeatKind::kSlave; }

/// True if key 1 ends HELD: this seat may change authority, a seat with authority over its tool has left, and no slave
/// is missing.
bool takes_what_was_left(const SeatSetup& setup, const rpc::Status& words) {
  const std::size_t tool = static_cast<std::size_t>(setup.seat.tool);
  if (!setup.moves_authority() || is_slave(setup) || tool >= words.tools.size()) return false;
  const auto& alpha = words.tools[tool].alpha;
  bool left = false;
  std::size_t k = 0;
  for (const rpc::StatusSeat& seat : words.seats) {
    if (!seat.master && !(seat.taken && seat.heard)) return false;
    if (seat.master && k < alpha.size()) left = (alpha[k++] > 0 && !seat.taken) || left;
  }
  return left;
}

/// Returns the origin of the stop, e.g. ` by trainer` or the workstation of a console; empty if not known.
std::string maker(const ClientStatus& s, const Words& words) {
  if (!words || !words->stop || words->stop->number < s.stops) return {};  // the status is older than this stop
  const rpc::StatusStop& stop = *words->stop;
  if (stop.kind == rpc::StopKind::kFault) return " by the session itself, as its numbers could not be trusted";
  const std::string person = stop.person.empty() ? "" : stop.person + " at ";
  if (!stop.seat.empty()) return " by " + person + sanitize(stop.seat);
  return stop.workstation.empty() ? std::string() : " by " + person + sanitize(stop.workstation) + " (console)";
}

/// Returns why no tool moves, as far as this client knows without the server.
std::string own_reason(const ClientStatus& s) {
  if (s.local_stop) return "you stopped your hand: r resumes";
  if (s.gate == wire::GateState::kLatched) return "your force is latched off: press b";
  if (s.gate == wire::GateState::kFault) return "your device has a fault: press b";
  return {};
}

/// True while the last words of the server may be out of date: it is silent, or has closed the connection.
bool away(const ClientStatus& s) { return s.reconnecting || s.closed || (s.heard && s.silence_s > kSilenceMax); }

io::ScreenItem state_item(const ClientStatus& s, const SeatSetup& setup, const Words& words) {
  const std::string name = setup.seat.name + " ";
  if (s.reconnecting && s.closed)
    return {name + "the server ended or gave the session away: reconnecting", name + "reconnecting"};
  if (s.reconnecting)
    return {name + format("SERVER SILENT for %.0f s: reconnecting", s.silence_s), name + "SERVER SILENT: reconnecting"};
  if (s.closed) return {name + "closed", ""};
  if (!s.heard) return {name + "waiting for the server", ""};
  if (s.silence_s > kSilenceMax)
    return {name + format("SERVER SILENT for %.0f s", s.silence_s), name + "SERVER SILENT"};
  const std::string time = format("%.1f s", std::max(0.0, s.session_time));
  switch (s.session) {
    case wire::SessionState::kWaiting:
      return {name + (s.missing == 0 ? std::string("engaging")
                                     : format("waits for %u seat%s", s.missing, s.missing == 1 ? "" : "s")),
              ""};
    case wire::SessionState::kRunning:
      return s.local_stop ? io::ScreenItem{name + time + " YOUR HAND IS STOPPED: r resumes",
                                           name + "YOUR HAND IS STOPPED: r resumes"}
                          : io::ScreenItem{name + time, ""};
    case wire::SessionState::kHeld: {
      const std::string own = own_reason(s),
                        why = !own.empty() || !words
                                  ? own
                                  : sanitize(words->held, kReasonMax) +
                                        (takes_what_was_left(setup, *words) ? "; 1 takes the tool" : "");
      return {name + time + " BRAKED" + (why.empty() ? "" : ": " + why),
              name + "BRAKED" + (why.empty() ? "" : ": " + why)};
    }
    case wire::SessionState::kPaused:
    case wire::SessionState::kStopped: {
      const bool paused = s.session == wire::SessionState::kPaused;
      const std::string what = paused ? "PAUSED" : "STOPPED", out = way_out(setup, paused);
      return {name + time + " " + what + maker(s, words) + ": " + out, name + what + maker(s, words) + ": " + out};
    }
    case wire::SessionState::kEnding:
      return {name + "ending", ""};
    case wire::SessionState::kOverloaded:
      return {name + time + " OVERLOADED: the server is too busy, it resumes automatically",
              name + "OVERLOADED: the server is too busy"};
  }
  return {name, ""};
}

/// Returns the leader of this seat's tool and the own authority. FORCE contains the present own authority; the status
/// contains only the requested authority, which gives the proportions among the other seats.
std::string leader_text(const ClientStatus& s, const SeatSetup& setup, const Words& words) {
  using enum wire::SessionState;
  if (away(s)) return "authority unknown";
  if (s.session == kStopped || s.session == kPaused || s.session == kHeld || s.session == kOverloaded)
    return "no leader";
  const std::size_t tool = static_cast<std::size_t>(setup.seat.tool);
  std::string leader;
  double most = 0, others = 0;  // requested authority
  if (words && tool < words->tools.size()) {
    std::size_t k = 0;
    for (const rpc::StatusSeat& seat : words->seats) {
      if (!seat.master || k >= words->tools[tool].alpha.size()) continue;
      const double alpha = words->tools[tool].alpha[k++];
      if (seat.name == setup.seat.name) continue;
      others += alpha;
      if (alpha <= most) continue;
      most = alpha;
      leader = seat.name;
    }
  }
  const std::string own = format("%.0f %%", 100 * s.alpha);
  const bool other_leads = !leader.empty() && most / others * (1 - s.alpha) > s.alpha;
  if (is_slave(setup)) return leader.empty() ? std::string() : sanitize(leader) + " leads";
  if (other_leads) return sanitize(leader) + " leads" + (s.alpha > 0 ? ", you " + own : "");
  if (s.alpha <= 0) return "you do not lead";
  return s.alpha < 0.5 && leader.empty() ? "you " + own + ", not leading" : "you lead " + own;
}

/// Returns the position set by keys, e.g. `keys: 15 mm right`; empty if keys do not move this device.
std::string keys_text(const ClientStatus& s) {
  if (!s.keys_m) return {};
  constexpr std::array<std::array<const char*, 2>, 3> kWays{{{"left", "right"}, {"near", "away"}, {"down", "up"}}};
  std::string text;
  for (std::size_t a = 0; a < kWays.size(); ++a) {
    const double mm = 1e3 * (*s.keys_m)[a];
    if (std::abs(mm) >= 0.5)
      text += (text.empty() ? "" : ", ") + format("%.0f mm %s", std::abs(mm), kWays[a][mm > 0 ? 1 : 0]);
  }
  return "keys: " + (text.empty() ? "at the start" : text);
}

/// Returns the other participants of the session, those with a working link first, then the silent ones.
std::string partners(const SeatSetup& setup, const Words& words) {
  if (!words) return {};
  std::string there, silent;
  for (const rpc::StatusSeat& seat : words->seats) {
    if (!seat.taken || seat.name == setup.seat.name) continue;
    std::string& list = seat.heard ? there : silent;
    list += (list.empty() ? "" : ", ") + sanitize(seat.name);
  }
  std::string text = there.empty() ? "no partner here" : "with " + there;
  return silent.empty() ? text : text + "; SILENT: " + silent;
}

}  // namespace

std::string way_out(const SeatSetup& setup, bool paused) {
  if (!is_slave(setup) && setup.seat.role == Role::kInstructor) return "r resumes";
  if (setup.may_end_pauses) return paused ? "r ends your own pause; an operator resumes" : "an operator resumes";
  return "an instructor or operator resumes";
}

std::string gate_text(const ClientStatus& s) {
  switch (s.gate) {
    case wire::GateState::kOff:
      return s.session_time < 0 ? "no force before the session runs" : "force off";
    case wire::GateState::kZero:
      return "force off";
    case wire::GateState::kRampIn:
      return "force rising";
    case wire::GateState::kActive:
      return "force on";
    case wire::GateState::kReleasing:
      return "force fades";
    case wire::GateState::kLatched:
      return "FORCE LATCHED OFF: press b";
    case wire::GateState::kFault:
      return "DEVICE FAULT: press b";
  }
  return "?";
}

std::string force_bar(double force_n, double force_max_n) {
  const double share = force_max_n > 0 && std::isfinite(force_n) ? std::clamp(force_n / force_max_n, 0.0, 1.0) : 0;
  const auto full = static_cast<std::size_t>(std::lround(share * kBar));
  return "[" + std::string(full, '#') + std::string(kBar - full, '.') + "]" + format(" %.1f N", force_n);
}

std::vector<io::ScreenItem> seat_screen(const ClientStatus& s, const SeatSetup& setup, const Words& words) {
  const bool latched = s.gate == wire::GateState::kLatched || s.gate == wire::GateState::kFault;
  std::vector<io::ScreenItem> items;
  const auto add = [&](std::string text, std::size_t row, std::string brief = "") {
    items.push_back({std::move(text), std::move(brief), row});
  };
  items.push_back(state_item(s, setup, words));
  if (words && words->drain && words->drain->left_s > 0) add(format("DRAINING: %u s left", words->drain->left_s), 0);
  if (words && words->recording) add(recording_text(*words->recording), 0, recording_brief(*words->recording));
  if (const std::string why = motors_text(s); !why.empty()) {
    add(why, 0, s.motors.latched ? "MOTORS TOO HOT: press b" : "MOTORS TOO HOT");
  } else if (latched) {
    add(gate_text(s), 0);
  }
  if (const std::string transfer = authority_transfer_text(s, setup, words); !transfer.empty())
    add(transfer, 0, authority_transfer_brief(s));
  add(leader_text(s, setup, words), 0);
  add("force " + force_bar(s.force_n, setup.gate.force_max * share_of_force(setup.seat.role)), 0,
      format("force %.1f N", s.force_n));
  std::string tool = s.distance_m ? format("tool %.0f mm away", *s.distance_m * 1e3) : "";
  if (s.touching) tool += tool.empty() ? "tool touching" : ", touching";
  add(tool, 1);
  if (s.offset_from_leader_m) add(format("%.1f mm beside the leader's hand", *s.offset_from_leader_m * 1e3), 1);
  add(keys_text(s), 1);
  add(partners(setup, words), 1);
  if (!latched) add(gate_text(s), 1);
  add(format("rtt %.1f ms, loss %.1f %%", s.link.rtt_ms, s.link.down_loss_percent), 1);
  if (s.gate_trips > 0) add(format("trips %u", s.gate_trips), 1);
  if (s.reconnects > 0) add(format("reconnected %u", s.reconnects), 1);
  add(format("late ticks %u", s.late_ticks), 1);
  add(format("margin %.0f mJ", s.energy.margin_min_j * 1e3), 1);
  add(format("tip %.0f %.0f %.0f mm", s.x[0] * 1e3, s.x[1] * 1e3, s.x[2] * 1e3), 1);
  return items;
}

}  // namespace tandem::client
