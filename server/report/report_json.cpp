#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/report/report.h"

namespace tandem::server {

namespace {

using Json = nlohmann::ordered_json;

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

const char* text(SeatKind kind) { return kind == SeatKind::kMaster ? "MASTER" : "SLAVE"; }

const char* text(Role role) {
  switch (role) {
    case Role::kInstructor:
      return "INSTRUCTOR";
    case Role::kTrainee:
      return "TRAINEE";
    case Role::kEvaluator:
      return "EVALUATOR";
    case Role::kObserver:
      return "OBSERVER";
  }
  return "";
}

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double v : values) list.push_back(number(v));
  return list;
}

Json metrics(const SeatMetrics& m) {
  return {{"judged_s", number(m.judged_s)},
          {"tracking_rms_m", number(m.tracking_rms_m)},
          {"tracking_rms_lag_removed_m", number(m.tracking_rms_lag_removed_m)},
          {"transport_lag_rms_m", number(m.transport_lag_rms_m)},
          {"joint_rms_rad", numbers(m.joint_rms_rad)},
          {"force_error_rms_n", number(m.force_error_rms_n)},
          {"force_error_commanded_rms_n", number(m.force_error_commanded_rms_n)},
          {"force_error_percent", number(m.force_error_percent)},
          {"effort_peak_n", number(m.effort_peak_n)},
          {"speed_peak_m_s", number(m.speed_peak_m_s)},
          {"leader_offset_rms_m", number(m.leader_offset_rms_m)}};
}

Json direction(const DirectionReport& d) {
  return {{"loss_percent", number(d.loss_percent)},
          {"longest_gap_ms", number(d.longest_gap_ms)},
          {"age_p99_ms", number(d.age_p99_ms)}};
}

double joule(const EnergyArray& nj) {
  double sum = 0;
  for (const auto e : nj) sum += static_cast<double>(e) * 1e-9;
  return sum;
}

Json seat(const SeatReport& s) {
  Json j{{"name", s.name}, {"kind", text(s.kind)}, {"role", text(s.role)}, {"alpha_mean", number(s.alpha_mean)}};
  j.update(metrics(s.metrics));
  j.update({{"gate_trips", s.gate_trips},
            {"gate", s.gate},
            {"energy",
             {{"in_j", joule(s.last.e_in)},
              {"out_j", joule(s.last.e_out)},
              {"dissipated_j", number(s.last.dissipated_j)},
              {"refused_j", number(s.last.refused_j)},
              {"margin_min_j", number(s.last.margin_min_j)},
              {"mfs_j", number(s.mfs_j)},
              {"delivered_j", number(s.last.delivered_j)}}},
            {"link",
             {{"rtt_p50_ms", number(s.link.rtt_p50_ms)},
              {"rtt_p99_ms", number(s.link.rtt_p99_ms)},
              {"up", direction(s.link.up)},
              {"down", direction(s.link.down)}}}});
  return j;
}

/// Metrics of all seats in one part of the session.
Json seats_of(const PhaseReport& part, const RunReport& r) {
  Json seats = Json::array();
  for (std::size_t i = 0; i < part.seats.size(); ++i) {
    Json s{{"name", r.seats[i].name}};
    s.update(metrics(part.seats[i]));
    seats.push_back(std::move(s));
  }
  return seats;
}

}  // namespace

std::string to_json(const RunReport& r, int indent) {
  Json violations = Json::array(), seats = Json::array(), tools = Json::array(), phases = Json::array();
  for (const Violation& v : r.violations)
    violations.push_back(
        {{"invariant", v.invariant}, {"seat", v.seat}, {"at_s", v.at_s}, {"expected", v.expected}, {"count", v.count}});
  for (const SeatReport& s : r.seats) seats.push_back(seat(s));
  for (const ToolReport& t : r.tools)
    tools.push_back({{"name", t.name},
                     {"contact_force_rms_n", number(t.contact_force_rms_n)},
                     {"penetration_max_m", number(t.penetration_max_m)},
                     {"held_s", number(t.held_s)}});
  for (const PhaseReport& p : r.phases)
    phases.push_back({{"name", p.name}, {"from_s", p.from_s}, {"to_s", p.to_s}, {"seats", seats_of(p, r)}});
  Json j{{"scenario", r.scenario},
         {"seed", r.seed},
         {"duration_s", number(r.duration_s)},
         {"stopped_s", number(r.stopped_s)},
         {"judged_s", number(r.judged_s)},
         {"moved", r.moved},
         {"verdict", r.verdict()},
         {"violations", std::move(violations)},
         {"trace_hash", r.trace_hash},
         {"cpu_s", number(r.cpu_s)},
         {"seats", std::move(seats)},
         {"tools", std::move(tools)},
         {"phases", std::move(phases)},
         {"outside_phases", r.outside ? Json{{"seats", seats_of(*r.outside, r)}} : Json(nullptr)}};
  if (r.unleased_s > 0) j["unleased_s"] = number(r.unleased_s);
  if (!r.feel.empty()) {
    j["feel"] = Json::object();
    for (const auto& [key, value] : r.feel) j["feel"][key] = number(value);
  }
  return j.dump(indent) + "\n";
}

}  // namespace tandem::server
