#include "server/app/monitor/session_status.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "server/session/stop_text.h"

namespace tandem::server {
namespace {

const char* gate_text(wire::GateState gate) {
  constexpr const char* kTexts[] = {
      "joining", "force off", "force rising", "force on", "force fades", "LATCHED (key b there)", "DEVICE FAULT"};
  return gate <= wire::GateState::kFault ? kTexts[static_cast<std::size_t>(gate)] : "?";
}

/// @param brief  omits the values of the link
std::string seat_text(const SeatStatus& seat, const std::string& name, bool brief) {
  if (!seat.taken) return name + " gone";
  if (!seat.alive) return name + " silent";
  std::string text = name + ": " + (seat.stopped ? "stopped own hand" : gate_text(seat.gate));
  if (brief || seat.gate == wire::GateState::kOff) return text;
  text += format(", rtt %.1f ms", seat.link.rtt_p50_ms);
  if (seat.link.up.loss_percent + seat.link.down.loss_percent > 0)
    text += format(", loss %.1f/%.1f %%", seat.link.up.loss_percent, seat.link.down.loss_percent);
  text += format(", margin %.0f mJ", seat.margin_j * 1e3);
  if (seat.gate_trips > 0) text += format(", trips %u", seat.gate_trips);
  if (seat.late_ticks > 0) text += format(", late %u", seat.late_ticks);
  return text;
}

/// Participants with authority, the leading one first: `trainer leads 75 %, trainee 25 %`.
std::string leaders(const SessionStatus& status, const SceneSpec& scene) {
  std::string text;
  std::vector<std::size_t> with;
  for (std::size_t i = 0; i < scene.masters(); ++i)
    if (status.seats[i].taken && status.seats[i].alpha > 0) with.push_back(i);
  std::ranges::stable_sort(with,
                           [&](std::size_t a, std::size_t b) { return status.seats[a].alpha > status.seats[b].alpha; });
  for (const std::size_t i : with)
    text += (text.empty() ? "" : ", ") + scene.seats[i].name +
            format(text.empty() ? " leads %.0f %%" : " %.0f %%", 100 * status.seats[i].alpha);
  return text;
}

/// Why this seat is not ready; empty if it is.
std::string not_ready_text(const SeatStatus& seat, const SeatSpec& spec) {
  if (!seat.taken) return seat.ever_taken ? spec.name + " left" : "no client joined as " + spec.name;
  if (!seat.alive) return spec.name + " is silent: its link is lost";
  if (seat.stopped) return "stopped by " + spec.name + ": key r there resumes";
  if (seat.gate == wire::GateState::kLatched) return spec.name + "'s force is latched off: key b there switches it on";
  if (seat.gate == wire::GateState::kFault) return spec.name + "'s device has a fault";
  return seat.ready ? "" : spec.name + " is not ready";
}

}  // namespace

std::uint32_t connected_seats_mask(const SessionStatus& status) noexcept {
  std::uint32_t seats = 0;
  for (std::size_t i = 0; i < status.seats.size(); ++i)
    seats |= status.seats[i].taken && status.seats[i].alive ? 1U << i : 0U;
  return seats;
}

std::string waiting_for(const SessionStatus& status, const SceneSpec& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatStatus& seat = status.seats[i];
    if (!scene.seats[i].required || seat.ready) continue;
    text += (text.empty() ? "" : ", ") + scene.seats[i].name;
    text += !seat.taken ? (seat.ever_taken ? " (left)" : " (not joined)") : seat.alive ? " (not ready)" : " (silent)";
  }
  return text;
}

std::string held_reason_text(const SessionStatus& status, const SceneSpec& scene) {
  if (!status.may_act)
    return "the directory of the service does not answer, so another server may own the session; all hands engage "
           "again "
           "when it answers";
  std::string text;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    if (status.seats[i].authority_max <= 0) continue;
    if (const std::string why = not_ready_text(status.seats[i], scene.seats[i]); !why.empty())
      text += (text.empty() ? "" : "; ") + why;
  }
  return text.empty() ? "no seat with authority is engaged" : text;
}

std::vector<io::ScreenItem> status_items(const SessionStatus& status, const SceneSpec& scene,
                                         const std::string& session, std::size_t row, const std::string& reach) {
  const std::string name = session.empty() ? "" : session + ": ";
  const std::string time =
      scene.endless() ? format("%.1f s", status.time) : format("%.1f of %.10g s", status.time, scene.duration);
  std::string state = name + time + " ";
  std::string brief;
  const auto ends = [&](const char* what) {
    const std::string who =
        state + what + "; ends it: " +
        with_options(may_end_text(status.stop, scene, connected_seats_mask(status)), "tandem-client control", reach);
    // Beside other sessions' lines there is no room for commands.
    brief = session.empty() ? strip_commands(who) : state + what;
    state = who;
  };
  switch (status.state) {
    case wire::SessionState::kWaiting: {
      const std::string whom = waiting_for(status, scene);
      state = name + (whom.empty() ? "engaging" : "waiting for " + whom);
      break;
    }
    case wire::SessionState::kRunning:
      state += "running";
      break;
    case wire::SessionState::kHeld:
      brief = state + "BRAKED";
      state += "BRAKED: " + held_reason_text(status, scene);
      break;
    case wire::SessionState::kPaused:
      ends("PAUSED");
      break;
    case wire::SessionState::kStopped:
      ends("STOPPED");
      break;
    case wire::SessionState::kEnding:
      state += "ending";
      break;
    case wire::SessionState::kOverloaded:
      brief = state + "OVERLOADED";
      state += "OVERLOADED: this machine is too busy to keep time; resumes automatically";
      break;
  }
  std::vector<io::ScreenItem> items{{state, brief, row}};
  if (status.state == wire::SessionState::kRunning) items.push_back({leaders(status, scene), "", row});
  if (status.machine.load_state.level > ShedLevel::kNone)
    items.push_back({format("load shedding: %s", to_text(status.machine.load_state.level)), "", row});
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    if (status.seats[i].ever_taken)
      items.push_back({seat_text(status.seats[i], scene.seats[i].name, false),
                       seat_text(status.seats[i], scene.seats[i].name, true), row + 1});
  items.push_back({format("late ticks %llu", static_cast<unsigned long long>(status.machine.late_ticks)), "", row + 1});
  return items;
}

std::vector<io::ScreenItem> screen_items(std::span<const SessionScreenEntry> sessions, const std::string& drain,
                                         std::size_t rows, const std::string& list) {
  std::vector<io::ScreenItem> items{{drain, "", 0}};
  const std::size_t each = sessions.size() <= 1 || sessions.size() * 2 <= rows ? 2 : 1;
  const bool all = sessions.size() * each <= rows;
  std::size_t row = 0, shown = 0;
  for (const SessionScreenEntry& s : sessions) {
    if (!all && row + 1 >= rows) break;
    std::vector<io::ScreenItem> more =
        status_items(s.status, *s.scene, sessions.size() == 1 ? "" : s.name, row, s.reach);
    if (!s.recording.empty()) more.insert(more.begin() + 1, {s.recording, "", row});
    for (io::ScreenItem& item : more) {
      if (each == 1) item.row = row;
      item.stays = sessions.size() > 1;  // keeps each session's text in its own line
    }
    std::ranges::move(more, std::back_inserter(items));
    row += each;
    ++shown;
  }
  if (!all)
    items.push_back({format("and %zu sessions more: `%s` lists them", sessions.size() - shown, list.c_str()), "", row});
  return items;
}

}  // namespace tandem::server
