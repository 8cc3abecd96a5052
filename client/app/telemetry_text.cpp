#include "client/app/telemetry_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "client/app/recording_text.h"
#include "common/base/format.h"

namespace tandem::client {
namespace {

using Json = nlohmann::ordered_json;

const char* to_text(wire::SessionState state) {
  constexpr std::array kNames{"waiting", "running", "held", "paused", "stopped", "ending", "overloaded"};
  return kNames[static_cast<std::size_t>(state)];
}

double magnitude(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }
Json vector(const std::array<double, 3>& v) { return std::isfinite(v[0]) ? Json{v[0], v[1], v[2]} : Json(nullptr); }

std::string origin(const SceneSpec& scene, std::uint32_t by) {
  if (by == wire::TransferParties::kScene) return "the scene";
  return by <= scene.seats.size() ? scene.seats[by - 1].name : "a console";
}

std::string seat_text(const SceneSpec& scene, const SessionWatch& watch, std::size_t i) {
  const wire::WatchedSeatState& seat = watch.newest()->seats[i];
  std::string text = scene.seats[i].name;
  if (!seat.taken) return text + " free";
  if (!seat.heard) return text + " NOT HEARD";
  text += std::string(" ") + (seat.stopped ? "stopped by its user" : wire::to_text(seat.gate));
  if (i >= scene.masters()) return text;
  const double alpha = watch.authority_over(0).applied[i];
  if (scene.tools.size() == 1 && std::isfinite(alpha)) text += format(" %.0f %%", 100 * alpha);
  if (std::isfinite(seat.f[0])) text += format(" %.2f N", magnitude(seat.f));
  return text;
}

std::string tool_text(const SceneSpec& scene, const SessionWatch& watch, std::size_t j) {
  const wire::WatchedToolState& tool = watch.newest()->tools[j];
  std::string text = scene.tools[j].name;
  if (std::isfinite(tool.x[0]))
    text += format(" at %.1f %.1f %.1f mm", 1e3 * tool.x[0], 1e3 * tool.x[1], 1e3 * tool.x[2]);
  if (tool.touching) text += format(", touches with %.2f N", magnitude(tool.f));
  if (tool.braked) text += ", braked";
  const wire::WatchedAuthority& authority = watch.authority_over(j);
  if (authority.transfer_ticks > 0) text += ", transfer announced by " + origin(scene, authority.transfer_by);
  return text;
}

Json weights(const SceneSpec& scene, const std::array<double, kMastersMax>& alpha) {
  Json out = Json::object();
  for (std::size_t k = 0; k < scene.masters(); ++k) out[scene.seats[k].name] = number(alpha[k]);
  return out;
}

Json seat_json(const SceneSpec& scene, const SessionWatch& watch, std::size_t i) {
  const wire::WatchedSeatState& seat = watch.newest()->seats[i];
  const wire::WatchedLink& link = watch.link_of(i);
  const bool told = std::isfinite(link.margin_min_j);
  return {{"name", scene.seats[i].name},
          {"taken", seat.taken},
          {"heard", seat.heard},
          {"engaged", seat.engaged},
          {"stopped", seat.stopped},
          {"gate", wire::to_text(seat.gate)},
          {"x_m", vector(seat.x)},
          {"f_n", vector(seat.f)},
          {"rtt_ms", number(link.rtt_p50_ms)},
          {"loss_up_percent", number(link.loss_up_percent)},
          {"gap_up_ms", number(link.gap_up_ms)},
          {"loss_down_percent", number(link.loss_down_percent)},
          {"gap_down_ms", number(link.gap_down_ms)},
          {"age_p99_ms", number(link.age_p99_ms)},
          {"margin_j", number(link.margin_min_j)},
          {"trips", told ? Json(link.gate_trips) : Json(nullptr)},
          {"late_ticks", told ? Json(link.late_ticks) : Json(nullptr)}};
}

Json tool_json(const SceneSpec& scene, const SessionWatch& watch, std::size_t j) {
  const wire::WatchedToolState& tool = watch.newest()->tools[j];
  const wire::WatchedAuthority& authority = watch.authority_over(j);
  Json transfer = nullptr;
  if (authority.transfer_ticks > 0)
    transfer = {{"by", origin(scene, authority.transfer_by)}, {"ticks", authority.transfer_ticks}};
  return {{"name", scene.tools[j].name},
          {"touching", tool.touching},
          {"braked", tool.braked},
          {"x_m", vector(tool.x)},
          {"f_n", vector(tool.f)},
          {"depth_m", number(tool.depth)},
          {"wanted", weights(scene, authority.wanted)},
          {"applied", weights(scene, authority.applied)},
          {"transfer", std::move(transfer)}};
}

}  // namespace

std::string telemetry_text(const SceneSpec& scene, const SessionWatch& watch,
                           const std::optional<rpc::StatusRecording>& recording) {
  if (!watch.newest()) return {};
  const wire::SessionTelemetry& t = *watch.newest();
  std::string text = format("%.1f s %s", t.session_tick / scene.tick_hz, to_text(t.state));
  if (recording) text += ", " + recording_text(*recording);
  if (t.shed_level > 0) text += format(", sheds load (level %u)", t.shed_level);
  for (std::size_t i = 0; i < scene.seats.size(); ++i) text += " | " + seat_text(scene, watch, i);
  for (std::size_t j = 0; j < scene.tools.size(); ++j) text += " | " + tool_text(scene, watch, j);
  return text;
}

std::string telemetry_json(const SceneSpec& scene, const SessionWatch& watch,
                           const std::optional<rpc::StatusRecording>& recording) {
  if (!watch.newest()) return {};
  const wire::SessionTelemetry& t = *watch.newest();
  Json out = {{"tick", t.session_tick},
              {"t_s", t.session_tick / scene.tick_hz},
              {"state", to_text(t.state)},
              {"shed", t.shed_level},
              {"authority_version", t.authority_version},
              {"stops", t.stops},
              {"seats", Json::array()},
              {"tools", Json::array()}};
  for (std::size_t i = 0; i < scene.seats.size(); ++i) out["seats"].push_back(seat_json(scene, watch, i));
  for (std::size_t j = 0; j < scene.tools.size(); ++j) out["tools"].push_back(tool_json(scene, watch, j));
  out["recording"] = Json::parse(recording_json(recording), nullptr, false);
  return out.dump();
}

}  // namespace tandem::client
