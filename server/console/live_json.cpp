#include "server/console/live_json.h"

#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/hex.h"
#include "server/policy/roles.h"

namespace tandem::console {
namespace {

using nlohmann::json;

std::string dump(const json& message) { return message.dump(-1, ' ', false, json::error_handler_t::replace); }

const char* phase_text(rpc::SessionPhase phase) {
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
    case rpc::SessionPhase::kEnding:
      return "OVER";
  }
  return "OVER";
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

json may_of(AccessRole role) {
  const std::pair<const char*, rpc::Kind> rights[] = {
      {"stop", rpc::Kind::kStopSession},         {"pause", rpc::Kind::kPauseSession},
      {"resume", rpc::Kind::kResumeSession},     {"authority", rpc::Kind::kSetAuthority},
      {"remove", rpc::Kind::kRemoveParticipant}, {"drain", rpc::Kind::kDrain}};
  json may = json::array();
  for (const auto& [name, kind] : rights)
    if (server::allowed(role, kind)) may.push_back(name);
  return may;
}

json stop_of(const std::optional<rpc::StatusStop>& stop) {
  if (!stop || stop->ends.empty()) return nullptr;
  constexpr const char* kKinds[] = {"", "PAUSE", "STOP", "FAULT"};
  return {{"number", stop->number},
          {"kind", kKinds[static_cast<std::size_t>(stop->kind)]},
          {"by", !stop->seat.empty() ? stop->seat : stop->workstation},
          {"why", stop->why},
          {"yours", stop->yours}};
}

}  // namespace

std::string session_hex(const rpc::Id& session) { return to_hex(session); }

std::string hello_json(const rpc::Status& status, AccessRole role, std::string_view release) {
  return dump({{"type", "hello"},
               {"protocol", 1},
               {"release", release},
               {"person", "console"},
               {"role", upper(to_text(role))},
               {"may", may_of(role)},
               {"sessions", json::array({{{"id", session_hex(status.session_id)},
                                          {"name", status.name},
                                          {"state", phase_text(status.phase)}}})}});
}

std::string scene_json(const rpc::Status& status) {
  json seats = json::array(), tools = json::array();
  for (const rpc::StatusSeat& seat : status.seats)
    seats.push_back({{"name", seat.name},
                     {"kind", seat.master ? "MASTER" : "SLAVE"},
                     {"role", upper(to_text(seat.role))},
                     {"required", nullptr},
                     {"device", nullptr},
                     {"force_limit_n", nullptr}});
  for (const rpc::StatusTool& tool : status.tools)
    tools.push_back({{"name", tool.name}, {"mass_kg", nullptr}, {"walls", json::array()}, {"tissues", json::array()}});
  return dump({{"type", "scene"},
               {"session", session_hex(status.session_id)},
               {"name", status.name},
               {"tick_hz", nullptr},
               {"dof", nullptr},
               {"law", nullptr},
               {"seats", seats},
               {"tools", tools}});
}

std::string state_json(const rpc::Status& status, std::uint64_t n, std::uint64_t dropped, std::int64_t wall_us) {
  json seats = json::array(), tools = json::array();
  for (const rpc::StatusSeat& seat : status.seats) {
    json row{{"taken", seat.taken}, {"heard", seat.heard}};
    for (const char* key : {"person", "engaged", "gate", "x", "f", "alpha", "rtt_ms", "loss_percent", "gap_ms",
                            "age_ms", "margin_j", "trips", "late"})
      row[key] = nullptr;
    seats.push_back(std::move(row));
  }
  for (const rpc::StatusTool& tool : status.tools) {
    json row{{"wanted", tool.alpha}};
    for (const char* key : {"x", "v", "f", "depth_m", "touching", "applied", "transfer"}) row[key] = nullptr;
    tools.push_back(std::move(row));
  }
  return dump({{"type", "state"},
               {"n", n},
               {"dropped", dropped},
               {"wall_us", wall_us},
               {"t", status.time_s},
               {"phase", phase_text(status.phase)},
               {"stop", stop_of(status.stop)},
               {"version", status.authority_version},
               {"shed", status.shed},
               {"held", status.held},
               {"seats", seats},
               {"tools", tools}});
}

std::string event_json(const rpc::Id& session, const rpc::StatusEvent& event) {
  return dump({{"type", "event"},
               {"session", session_hex(session)},
               {"number", event.number},
               {"t", nullptr},
               {"text", event.text}});
}

std::string reply_json(std::optional<std::uint64_t> id, bool ok, std::string_view text) {
  return dump({{"type", "reply"}, {"id", id ? json(*id) : json()}, {"ok", ok}, {"text", text}});
}

std::string notice_json(std::string_view level, std::string_view text) {
  return dump({{"type", "notice"}, {"level", level}, {"text", text}});
}

}  // namespace tandem::console
