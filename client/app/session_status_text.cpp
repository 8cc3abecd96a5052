#include "client/app/session_status_text.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "client/app/recording_text.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::client {
namespace {

/// Returns the sanitised text as a JSON string.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : sanitize(text)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string name_or_null(const std::string& name) { return name.empty() ? "null" : "\"" + name + "\""; }

std::string maker_of(const rpc::StatusStop& stop) {
  const std::string& who = stop.seat.empty() ? stop.workstation : stop.seat;
  if (stop.kind == rpc::StopKind::kFault) return "the session itself";
  std::string text = "an unknown author";
  if (!who.empty())
    text = (stop.person.empty() ? "" : stop.person + " at ") + sanitize(who) + " (" + std::string(to_text(stop.role)) +
           (stop.seat.empty() ? " at a console)" : ")");
  return text + (stop.why.empty() ? "" : ": " + sanitize(stop.why));
}

/// `1 stop`, `2 stops`
std::string counted(std::uint32_t number, const char* thing) {
  return format("%u %s%s", number, thing, number == 1 ? "" : "s");
}

}  // namespace

std::string weights_text(const rpc::Status& status, std::span<const double> alpha) {
  std::string text;
  std::size_t k = 0;
  for (const rpc::StatusSeat& s : status.seats)
    if (s.master && k < alpha.size()) text += (text.empty() ? "" : ", ") + s.name + format(" %.3g", alpha[k++]);
  return text.empty() ? "none" : text;
}

bool is_stopped(const rpc::Status& s) noexcept {
  return s.phase == rpc::SessionPhase::kStopped || s.phase == rpc::SessionPhase::kPaused;
}

std::string stop_text(const rpc::Status& s) {
  std::string text = s.phase == rpc::SessionPhase::kPaused ? "PAUSED" : "STOPPED";
  if (!s.stop) return text;
  const rpc::StatusStop& stop = *s.stop;
  text += " by " + maker_of(stop);
  if (stop.kind == rpc::StopKind::kFault) text += ": its numbers could not be trusted";
  if (stop.ends.empty()) return text;
  return text + ". It can be ended by: " + sanitize(stop.ends) + (stop.yours ? ". You may end it" : "");
}

std::string drain_text(const rpc::StatusDrain& d) {
  return format("DRAINING: %u s left, %u session%s, %u %s", d.left_s, d.sessions, d.sessions == 1 ? "" : "s",
                d.participants, d.participants == 1 ? "participant on a seat" : "participants on their seats");
}

std::string status_changes_text(const rpc::Status& before, const rpc::Status& now) {
  std::string text;
  const std::uint32_t seen = before.events.empty() ? 0 : before.events.back().number;
  bool reported = false;
  if (!before.name.empty())  // events before the first status are not reported
    for (const rpc::StatusEvent& n : now.events)
      if (n.number > seen) {
        text += sanitize(n.text) + "\n";
        reported = true;
      }
  if (is_stopped(now) && (now.stops != before.stops || !is_stopped(before))) text += stop_text(now) + "\n";
  if (const std::string change = recording_change_text(before.recording, now.recording); !change.empty())
    text += change + "\n";
  const bool ends = now.phase == rpc::SessionPhase::kEnding;
  if (is_stopped(before) && !is_stopped(now) && !reported && !ends)
    text += format("stop %u is over: the session is %s\n", now.stops, rpc::to_text(now.phase));
  const bool held = now.phase == rpc::SessionPhase::kHeld, was_held = before.phase == rpc::SessionPhase::kHeld;
  if (held && !was_held) text += "HELD: " + (now.held.empty() ? "all hands are released" : sanitize(now.held)) + "\n";
  if (was_held && !held && !ends) text += format("the session is held no longer: it is %s\n", rpc::to_text(now.phase));
  // A server that ends at once, as after Ctrl-C, reports a drain with 0 s left.
  if (!now.drain || (now.drain->left_s == 0 && !before.drain)) return text;
  const bool first = !before.drain, last = now.drain->left_s <= 5,
             ten = !first && before.drain->left_s / 10 != now.drain->left_s / 10;
  if ((first && !reported) || ((last || ten) && before.drain != now.drain)) text += drain_text(*now.drain) + "\n";
  return text;
}

std::string status_text(const rpc::Status& s) {
  std::string text = format("%s: %s, %.1f s", s.name.c_str(), rpc::to_text(s.phase), s.time_s);
  if (is_stopped(s)) text += format("; `resume %u` ends it", s.stops);
  if (s.counts)
    text += "; " + counted(s.counts->stops, "stop") + ", " + counted(s.counts->restarts, "restart") + " and " +
            counted(s.counts->moves, "move") + " so far";
  else if (!is_stopped(s))
    text += format("; %u stops, restarts and moves so far", s.stops);
  text += format("; authority version %u%s", s.authority_version, s.draining ? "; the server is DRAINING" : "");
  if (s.phase == rpc::SessionPhase::kOverloaded)
    text += "; OVERLOADED: the server is too busy to keep time, all hands are released and engaged again automatically";
  text += s.shed > 0 ? format("; busy, shed level %u of %u\n", s.shed, rpc::kShedMax) : "\n";
  if (is_stopped(s)) text += "  " + stop_text(s) + "\n";
  if (s.stop && !is_stopped(s))
    text += format("  last stop: %.0f s ago, by %s\n", s.stop->ago_s, maker_of(*s.stop).c_str());
  if (!s.held.empty()) text += "  BRAKED: " + sanitize(s.held) + "\n";
  if (!s.not_stored.empty())
    text += "  NOT STORED: " + sanitize(s.not_stored) + "; a kill of the server undoes a stop\n";
  if (s.drain) text += "  " + drain_text(*s.drain) + "\n";
  if (s.recording) text += "  " + recording_text(*s.recording) + "\n";
  for (const rpc::StatusSeat& seat : s.seats)
    text += format("  seat %-16s %-10s %s%s\n", seat.name.c_str(), std::string(to_text(seat.role)).c_str(),
                   !seat.taken  ? "free"
                   : seat.heard ? "here"
                                : "SILENT",
                   seat.person.empty() ? "" : (", " + seat.person).c_str());
  for (const rpc::StatusTool& tool : s.tools)
    text += format("  tool %-16s %s\n", tool.name.c_str(), weights_text(s, tool.alpha).c_str());
  return text;
}

std::string status_json(const rpc::Status& s) {
  // Names contain only A-Z a-z 0-9 _ -, so they need no escaping.
  std::string text = "{\"session\": \"" + s.name + "\", \"id\": \"";
  for (const std::byte b : s.session_id) text += format("%02x", std::to_integer<unsigned>(b));
  text += format(
      "\", \"phase\": \"%s\", \"time_s\": %.3f, \"stops\": %u, \"authority_version\": %u, \"draining\": %s, \"shed\": "
      "%u, \"seats\": [",
      rpc::to_text(s.phase), s.time_s, s.stops, s.authority_version, s.draining ? "true" : "false", s.shed);
  std::vector<std::string> masters;
  for (std::size_t i = 0; i < s.seats.size(); ++i) {
    const rpc::StatusSeat& seat = s.seats[i];
    if (seat.master) masters.push_back(seat.name);
    text += format("%s{\"name\": \"%s\", \"role\": \"%s\", \"taken\": %s, \"heard\": %s, \"person\": %s}",
                   i == 0 ? "" : ", ", seat.name.c_str(), std::string(to_text(seat.role)).c_str(),
                   seat.taken ? "true" : "false", seat.heard ? "true" : "false", name_or_null(seat.person).c_str());
  }
  text += "], \"tools\": [";
  for (std::size_t j = 0; j < s.tools.size(); ++j) {
    text += format("%s{\"name\": \"%s\", \"alpha\": {", j == 0 ? "" : ", ", s.tools[j].name.c_str());
    for (std::size_t k = 0; k < s.tools[j].alpha.size() && k < masters.size(); ++k)
      text += format("%s\"%s\": %.9g", k == 0 ? "" : ", ", masters[k].c_str(), s.tools[j].alpha[k]);
    text += "}}";
  }
  text += "], \"stop\": ";
  if (s.stop) {
    constexpr const char* kKinds[] = {"", "pause", "stop", "fault"};
    text += format(
        "{\"number\": %u, \"kind\": \"%s\", \"seat\": \"%s\", \"workstation\": \"%s\", \"role\": \"%s\", \"why\": ",
        s.stop->number, kKinds[static_cast<int>(s.stop->kind)], s.stop->seat.c_str(), s.stop->workstation.c_str(),
        std::string(to_text(s.stop->role)).c_str());
    text += in_quotes(s.stop->why) + format(", \"ago_s\": %.3f, \"ends\": ", s.stop->ago_s) + in_quotes(s.stop->ends) +
            (s.stop->yours ? ", \"yours\": true" : ", \"yours\": false") +
            ", \"person\": " + name_or_null(s.stop->person) + "}";
  } else {
    text += "null";
  }
  text += ", \"drain\": ";
  text += s.drain ? format("{\"left_s\": %u, \"sessions\": %u, \"people\": %u}", s.drain->left_s, s.drain->sessions,
                           s.drain->participants)
                  : "null";
  text += ", \"held\": " + (s.held.empty() ? "null" : in_quotes(s.held)) + ", \"counts\": ";
  text += s.counts ? format("{\"stops\": %u, \"restarts\": %u, \"moves\": %u}", s.counts->stops, s.counts->restarts,
                            s.counts->moves)
                   : "null";
  text += ", \"not_stored\": " + (s.not_stored.empty() ? "null" : in_quotes(s.not_stored));
  return text + ", \"recording\": " + recording_json(s.recording) + "}\n";
}

}  // namespace tandem::client
