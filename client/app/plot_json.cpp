#include "client/app/plot_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace tandem::client {
namespace {

using PlotObject = nlohmann::ordered_json;

void put_known(PlotObject& to, const char* name, double value) {
  if (std::isfinite(value)) to[name] = value;
}

void put_vector(PlotObject& to, const char* name, const std::array<double, 3>& v, bool with_norm) {
  if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2])) return;
  PlotObject& out = to[name] = {{"x", v[0]}, {"y", v[1]}, {"z", v[2]}};
  if (with_norm) out["norm"] = std::hypot(v[0], v[1], v[2]);
}

PlotObject seat_plot(const SessionWatch& watch, std::size_t i) {
  const wire::WatchedSeatState& seat = watch.newest()->seats[i];
  const wire::WatchedLink& link = watch.link_of(i);
  PlotObject out = {{"taken", seat.taken},
                    {"heard", seat.heard},
                    {"engaged", seat.engaged},
                    {"stopped", seat.stopped},
                    {"gate", static_cast<int>(seat.gate)}};
  put_vector(out, "measured_cp", seat.x, false);
  put_vector(out, "measured_cf", seat.f, true);
  put_known(out, "rtt_ms", link.rtt_p50_ms);
  put_known(out, "loss_up_percent", link.loss_up_percent);
  put_known(out, "loss_down_percent", link.loss_down_percent);
  put_known(out, "gap_up_ms", link.gap_up_ms);
  put_known(out, "gap_down_ms", link.gap_down_ms);
  put_known(out, "age_p99_ms", link.age_p99_ms);
  put_known(out, "margin_j", link.margin_min_j);
  if (std::isfinite(link.margin_min_j)) {  // the client has reported
    out["gate_trips"] = link.gate_trips;
    out["late_ticks"] = link.late_ticks;
  }
  return out;
}

PlotObject tool_plot(const SceneSpec& scene, const SessionWatch& watch, std::size_t j) {
  const wire::WatchedToolState& tool = watch.newest()->tools[j];
  PlotObject out = {{"touching", tool.touching}, {"braked", tool.braked}};
  put_vector(out, "measured_cp", tool.x, false);
  put_vector(out, "environment_cf", tool.f, true);
  put_known(out, "penetration", tool.depth);
  PlotObject alpha = PlotObject::object();
  for (std::size_t i = 0; i < scene.masters(); ++i)
    put_known(alpha, scene.seats[i].name.c_str(), watch.authority_over(j).applied[i]);
  if (!alpha.empty()) out["alpha"] = std::move(alpha);
  return out;
}

}  // namespace

std::string plot_json(const SceneSpec& scene, const SessionWatch& watch, double timestamp_s) {
  if (!watch.newest()) return {};
  const wire::SessionTelemetry& t = *watch.newest();
  PlotObject out = {{"timestamp", timestamp_s},
                    {"session",
                     {{"t", t.session_tick / scene.tick_hz},
                      {"tick", t.session_tick},
                      {"running", t.state == wire::SessionState::kRunning},
                      {"stops", t.stops},
                      {"shed_level", t.shed_level}}},
                    {"seats", PlotObject::object()},
                    {"tools", PlotObject::object()}};
  for (std::size_t i = 0; i < scene.seats.size(); ++i) out["seats"][scene.seats[i].name] = seat_plot(watch, i);
  for (std::size_t j = 0; j < scene.tools.size(); ++j) out["tools"][scene.tools[j].name] = tool_plot(scene, watch, j);
  return out.dump();
}

}  // namespace tandem::client
