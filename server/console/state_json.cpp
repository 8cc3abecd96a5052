#include "server/console/state_json.h"

#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/format.h"
#include "server/console/json_text.h"
#include "server/console/live_json.h"
#include "server/console/state_words.h"

namespace tandem::console {
namespace {

using nlohmann::json;

json number(double v) { return std::isfinite(v) ? json(v) : json(); }
json vector(const std::array<double, 3>& v) {
  return std::isfinite(v[0] + v[1] + v[2]) ? json{v[0], v[1], v[2]} : json();
}
/// The larger of two values; null if both are unknown.
json worst(double a, double b) { return number(std::fmax(a, b)); }

const char* law_text(LawKind law) {
  constexpr std::array kNames{"SET_POSITION", "RAW", "REPLICA", "TDPA", "WAVE", "PD"};
  static_assert(kNames.size() == kLaws);
  return kNames[static_cast<std::size_t>(law)];
}

std::string role_text(AccessRole role) {
  std::string out(to_text(role));
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

/// Surfaces that a tool touches: those of its slave's seat if that is remote.
const EnvironmentSpec& environment_of(const SceneSpec& scene, const ToolSpec& tool) {
  return tool.remote ? scene.seats[tool.seat].environment : tool.environment;
}

json walls_of(const EnvironmentSpec& environment) {
  if (!environment.wall) return json::array();
  const WallSpec& wall = *environment.wall;
  return json::array(
      {{{"axis", wall.axis}, {"at_m", wall.at}, {"stiffness_n_m", wall.k}, {"from_below", wall.from_below}}});
}
json tissues_of(const EnvironmentSpec& environment) {
  if (!environment.tissue) return json::array();
  const TissueSpec& tissue = *environment.tissue;
  return json::array(
      {{{"axis", tissue.axis}, {"at_m", tissue.at}, {"stiffness_n_m", tissue.k}, {"from_below", tissue.from_below}}});
}

std::string origin_of(const SceneSpec& scene, std::uint32_t by) {
  if (by == wire::TransferParties::kScene) return "the scene";
  return by <= scene.seats.size() ? scene.seats[by - 1].name : "a console";
}

/// An announced change. `to` is the master that gains most; null if several gain as much.
json transfer_of(const SceneSpec& scene, const wire::WatchedAuthority& authority) {
  if (authority.transfer_ticks == 0) return nullptr;
  json to = nullptr, alpha = nullptr;
  double most = 0;
  for (std::size_t k = 0; k < scene.masters(); ++k) {
    const double gain = authority.wanted[k] - authority.applied[k];
    if (!(gain > 1e-9)) continue;
    const bool more = gain > most + 1e-9, same = !more && gain > most - 1e-9;
    if (more) {
      most = gain;
      to = scene.seats[k].name;
      alpha = authority.wanted[k];
    } else if (same) {
      to = alpha = nullptr;
    }
  }
  return {{"by", origin_of(scene, authority.transfer_by)},
          {"to", to},
          {"alpha", alpha},
          {"ticks", authority.transfer_ticks}};
}

/// Name of the person at a seat, from the status; null if there is none or the ticket names none.
json person_at(const rpc::Status& status, std::size_t i, bool taken) {
  return taken && i < status.seats.size() && !status.seats[i].person.empty() ? json(status.seats[i].person) : json();
}

json live_seat(const SceneSpec& scene, const LivePicture& picture, std::size_t i) {
  const LiveValues& live = *picture.live;
  const wire::WatchedSeatState& seat = live.telemetry.seats[i];
  const wire::WatchedLink& link = live.links[i];
  const bool heard = std::isfinite(link.margin_min_j);  // the counters came with it
  json alpha = nullptr;
  if (i < scene.masters()) {
    alpha = json::array();
    for (std::size_t j = 0; j < scene.tools.size(); ++j) alpha.push_back(number(live.authorities[j].applied[i]));
  }
  return {{"taken", seat.taken},
          {"heard", seat.heard},
          {"person", person_at(picture.status, i, seat.taken)},
          {"engaged", seat.engaged},
          {"stopped", seat.stopped},
          {"gate", seat.taken ? json(page_word(seat.gate)) : json()},
          {"x", vector(seat.x)},
          {"f", vector(seat.f)},
          {"alpha", std::move(alpha)},
          {"rtt_ms", number(link.rtt_p50_ms)},
          {"loss_percent", worst(link.loss_up_percent, link.loss_down_percent)},
          {"gap_ms", worst(link.gap_up_ms, link.gap_down_ms)},
          {"age_ms", number(link.age_p99_ms)},
          {"margin_j", number(link.margin_min_j)},
          {"trips", heard ? json(link.gate_trips) : json()},
          {"late", heard ? json(link.late_ticks) : json()}};
}

json weights(const SceneSpec& scene, const std::array<double, kMastersMax>& alpha) {
  json out = json::array();
  for (std::size_t k = 0; k < scene.masters(); ++k) out.push_back(number(alpha[k]));
  return out;
}

json live_tool(const SceneSpec& scene, const LiveValues& live, std::size_t j) {
  const wire::WatchedToolState& tool = live.telemetry.tools[j];
  const wire::WatchedAuthority& authority = live.authorities[j];
  return {{"x", vector(tool.x)},
          {"v", vector(live.velocities[j])},
          {"f", vector(tool.f)},
          {"depth_m", number(tool.depth)},
          {"touching", tool.touching},
          {"braked", tool.braked},
          {"wanted", weights(scene, authority.wanted)},
          {"applied", weights(scene, authority.applied)},
          {"transfer", transfer_of(scene, authority)}};
}

void add_live(const SceneSpec& scene, const LivePicture& picture, json& state) {
  const LiveValues& live = *picture.live;
  const wire::SessionTelemetry& t = live.telemetry;
  state["tick"] = t.session_tick;
  state["t"] = number(t.session_tick / scene.tick_hz);
  // A datagram does not tell a session without the directory from one in which no seat with authority is engaged.
  const bool held = picture.status.phase == rpc::SessionPhase::kHeld &&
                    (t.state == wire::SessionState::kHeld || t.state == wire::SessionState::kWaiting);
  state["phase"] = held ? phase_text(picture.status.phase) : page_word(t.state);
  state["version"] = t.authority_version;
  state["shed"] = t.shed_level;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) state["seats"].push_back(live_seat(scene, picture, i));
  for (std::size_t j = 0; j < scene.tools.size(); ++j) state["tools"].push_back(live_tool(scene, live, j));
}

void add_status(const rpc::Status& status, json& state) {
  state["tick"] = nullptr;
  state["t"] = number(status.time_s);
  state["phase"] = phase_text(status.phase);
  state["version"] = status.authority_version;
  state["shed"] = status.shed;
  for (std::size_t i = 0; i < status.seats.size(); ++i) {
    const rpc::StatusSeat& seat = status.seats[i];
    json row{{"taken", seat.taken}, {"heard", seat.heard}, {"person", person_at(status, i, seat.taken)}};
    for (const char* key : {"engaged", "stopped", "gate", "x", "f", "alpha", "rtt_ms", "loss_percent", "gap_ms",
                            "age_ms", "margin_j", "trips", "late"})
      row[key] = nullptr;
    state["seats"].push_back(std::move(row));
  }
  for (const rpc::StatusTool& tool : status.tools) {
    json row{{"wanted", tool.alpha}};
    for (const char* key : {"x", "v", "f", "depth_m", "touching", "braked", "applied", "transfer"}) row[key] = nullptr;
    state["tools"].push_back(std::move(row));
  }
}

json stop_of(const std::optional<rpc::StatusStop>& stop) {
  if (!stop || stop->ends.empty()) return nullptr;
  constexpr std::array kKinds{"", "PAUSE", "STOP", "FAULT"};
  const auto kind = static_cast<std::size_t>(stop->kind);
  return {{"number", stop->number},
          {"kind", kind < kKinds.size() ? kKinds[kind] : "FAULT"},
          {"by", !stop->seat.empty() ? stop->seat : stop->workstation},
          {"person", stop->person.empty() ? json() : json(stop->person)},
          {"why", stop->why},
          {"yours", stop->yours}};
}

json recording_of(const std::optional<rpc::StatusRecording>& recording) {
  if (!recording) return nullptr;
  return {{"by_server", recording->by_server},
          {"by_recorders", recording->by_recorders},
          {"pseudonyms", recording->pseudonyms},
          {"dropped", recording->dropped},
          {"trouble", recording->trouble}};
}

void add_scene(const SceneSpec& scene, json& message) {
  message["tick_hz"] = scene.tick_hz;
  message["dof"] = scene.dof;
  message["law"] = law_text(scene.channel.law);
  message["duration_s"] = number(scene.duration);
  for (const SeatSpec& seat : scene.seats)
    message["seats"].push_back({{"name", seat.name},
                                {"kind", seat.kind == SeatKind::kMaster ? "MASTER" : "SLAVE"},
                                {"role", role_text(access_role(seat.role))},
                                {"required", seat.required},
                                {"device", seat.device.model == DeviceModel::kTouch ? "TOUCH" : "LINEAR"},
                                {"force_limit_n", number(scene.gate.force_max)}});
  for (const ToolSpec& tool : scene.tools) {
    const EnvironmentSpec& environment = environment_of(scene, tool);
    message["tools"].push_back({{"name", tool.name},
                                {"mass_kg", number(tool.m_s)},
                                {"walls", walls_of(environment)},
                                {"tissues", tissues_of(environment)}});
  }
}

void add_names(const rpc::Status& status, json& message) {
  for (const char* key : {"tick_hz", "dof", "law", "duration_s"}) message[key] = nullptr;
  for (const rpc::StatusSeat& seat : status.seats)
    message["seats"].push_back({{"name", seat.name},
                                {"kind", seat.master ? "MASTER" : "SLAVE"},
                                {"role", role_text(seat.role)},
                                {"required", nullptr},
                                {"device", nullptr},
                                {"force_limit_n", nullptr}});
  for (const rpc::StatusTool& tool : status.tools)
    message["tools"].push_back(
        {{"name", tool.name}, {"mass_kg", nullptr}, {"walls", json::array()}, {"tissues", json::array()}});
}

}  // namespace

std::string scene_json(const LivePicture& picture) {
  json message{{"type", "scene"},
               {"session", session_hex(picture.status.session_id)},
               {"name", picture.status.name},
               {"seats", json::array()},
               {"tools", json::array()}};
  if (picture.scene) {
    add_scene(*picture.scene, message);
  } else {
    add_names(picture.status, message);
  }
  return json_text(message);
}

std::string state_members(const LivePicture& picture) {
  json state{{"held", picture.status.held},
             {"recording", recording_of(picture.status.recording)},
             {"no_recording", picture.status.no_recording},
             {"seats", json::array()},
             {"tools", json::array()}};
  if (picture.live && picture.scene) {
    add_live(*picture.scene, picture, state);
  } else {
    add_status(picture.status, state);
  }
  const std::string text = json_text(state);
  return text.substr(1, text.size() - 2);
}

std::string state_json(const StateHead& head, const std::string& members) {
  std::string text = format("{\"type\":\"state\",\"n\":%llu,\"dropped\":%llu,\"wall_us\":%lld,\"age_ms\":",
                            static_cast<unsigned long long>(head.n), static_cast<unsigned long long>(head.dropped),
                            static_cast<long long>(head.wall_us));
  text += head.age_ms && std::isfinite(*head.age_ms) ? format("%.3f", *head.age_ms) : "null";
  text += ",\"stop\":" + json_text(stop_of(*head.stop)) + ",";
  return text + members + "}";
}

}  // namespace tandem::console
