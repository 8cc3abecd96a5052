#include "server/console/live_json.h"

#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/auth/ticket.h"
#include "common/base/hex.h"
#include "server/console/json_text.h"
#include "server/console/recording_request.h"
#include "server/policy/roles.h"

namespace tandem::console {
namespace {

using nlohmann::json;

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

json may_of(AccessRole role, const PageOffers& offers) {
  const std::pair<const char*, rpc::Kind> rights[] = {{"stop", rpc::Kind::kStopSession},
                                                      {"pause", rpc::Kind::kPauseSession},
                                                      {"resume", rpc::Kind::kResumeSession},
                                                      {"authority", rpc::Kind::kSetAuthority},
                                                      {"remove", rpc::Kind::kRemoveParticipant},
                                                      {"drain", rpc::Kind::kDrain},
                                                      {"score", rpc::Kind::kNote},
                                                      {"create", rpc::Kind::kCreateSession},
                                                      {"record", rpc::Kind::kRecordSession}};
  json may = json::array();
  for (const auto& [name, kind] : rights)
    if (server::allowed_without_seat(role, kind)) may.push_back(name);
  if (offers.seats) may.push_back("seat");
  if (offers.invite) may.push_back("invite");
  if (offers.recordings && may_review(role)) may.push_back("recordings");
  return may;
}

/// Seats by the name of their scene.
json seats_of(const rpc::SceneList* list) {
  json seats = json::object();
  if (list == nullptr) return seats;
  for (const rpc::SceneSeat& seat : list->seats)
    seats[list->scenes.at(seat.scene)].push_back({{"name", seat.name}, {"role", upper(to_text(seat.role))}});
  return seats;
}

/// Durations by the name of the scene [s], of scenes that end by themselves.
json durations_of(const rpc::SceneList* list) {
  json durations = json::object();
  for (std::size_t i = 0; list != nullptr && i < list->durations_s.size(); ++i)
    if (list->durations_s[i] > 0) durations[list->scenes[i]] = list->durations_s[i];
  return durations;
}

}  // namespace

std::string session_hex(const rpc::Id& session) { return to_hex(session); }

const char* phase_text(rpc::SessionPhase phase) noexcept {
  switch (phase) {
    case rpc::SessionPhase::kWaiting:
      return "WAITING";
    case rpc::SessionPhase::kRunning:
      return "RUNNING";
    case rpc::SessionPhase::kPaused:
      return "PAUSED";
    case rpc::SessionPhase::kStopped:
    case rpc::SessionPhase::kOverloaded:  // all hands are released, as in a stop
      return "STOPPED";
    case rpc::SessionPhase::kHeld:
      return "HELD";
    case rpc::SessionPhase::kEnding:
      return "OVER";
  }
  return "OVER";
}

std::string hello_json(std::string_view person, AccessRole role, std::string_view release,
                       std::span<const rpc::ListedSession> sessions, const PageOffers& offers) {
  json rows = json::array();
  for (const rpc::ListedSession& session : sessions)
    rows.push_back({{"id", session_hex(session.id)}, {"name", session.name}, {"state", phase_text(session.phase)}});
  return json_text({{"type", "hello"},
                    {"protocol", 1},
                    {"release", release},
                    {"person", person},
                    {"proved", offers.proved},
                    {"scenes", offers.scenes != nullptr ? json(offers.scenes->scenes) : json::array()},
                    {"scene_seats", seats_of(offers.scenes)},
                    {"scene_durations_s", durations_of(offers.scenes)},
                    {"workstation", offers.workstation.empty() ? json() : json(offers.workstation)},
                    {"role", upper(to_text(role))},
                    {"may", may_of(role, offers)},
                    {"play", offers.play.empty() ? json() : json(offers.play)},
                    {"sessions", std::move(rows)}});
}

std::string event_json(const rpc::Id& session, const rpc::StatusEvent& event) {
  return json_text({{"type", "event"},
                    {"session", session_hex(session)},
                    {"number", event.number},
                    {"t", nullptr},
                    {"text", event.text}});
}

std::string reply_json(std::optional<std::uint64_t> id, bool ok, std::string_view text) {
  return json_text({{"type", "reply"}, {"id", id ? json(*id) : json()}, {"ok", ok}, {"text", text}});
}

std::string tickets_json(const rpc::SessionCreated& created, std::string_view server, const auth::KeyFingerprint& own) {
  json rows = json::array();
  for (const rpc::SeatTicket& ticket : created.tickets) {
    rows.push_back({{"person", ticket.person.empty() ? ticket.workstation : ticket.person},
                    {"workstation", ticket.workstation},
                    {"role", upper(to_text(ticket.role))},
                    {"seat", ticket.seat},
                    {"here", auth::claimed_workstation(ticket.ticket) == own},
                    {"ticket", auth::ticket_text(ticket.ticket)}});
  }
  return json_text({{"type", "tickets"},
                    {"session", session_hex(created.session.id)},
                    {"name", created.session.name},
                    {"server", server},
                    {"tickets", std::move(rows)}});
}

std::string notice_json(std::string_view level, std::string_view text, std::string_view server) {
  json notice{{"type", "notice"}, {"level", level}, {"text", text}};
  if (!server.empty()) notice["server"] = server;
  return json_text(notice);
}

}  // namespace tandem::console
