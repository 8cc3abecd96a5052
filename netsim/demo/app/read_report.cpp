#include "netsim/demo/app/read_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace tandem::netsim::demo {
namespace {

using Json = nlohmann::json;

double number(const Json& j, const char* key) {
  const auto at = j.find(key);
  return at != j.end() && at->is_number() ? at->get<double>() : kUnknown;
}

/// Combines two numbers; if one is unknown, returns the other.
template <typename Combine>
double both(double a, double b, Combine combine) {
  if (std::isnan(a)) return b;
  return std::isnan(b) ? a : combine(a, b);
}
double larger(double a, double b) {
  return both(a, b, [](double x, double y) { return std::max(x, y); });
}
double sum(double a, double b) {
  return both(a, b, [](double x, double y) { return x + y; });
}

SeatNumbers seat_numbers(const Json& j) {
  SeatNumbers s;
  s.tracking_m = number(j, "tracking_rms_m");
  s.lag_removed_m = number(j, "tracking_rms_lag_removed_m");
  s.transport_lag_m = number(j, "transport_lag_rms_m");
  s.force_error_n = number(j, "force_error_rms_n");
  s.force_error_commanded_n = number(j, "force_error_commanded_rms_n");
  if (const auto joints = j.find("joint_rms_rad"); joints != j.end() && joints->is_array())
    for (std::size_t k = 0; k < std::min<std::size_t>(3, joints->size()); ++k)
      if ((*joints)[k].is_number()) s.joint_rad[k] = (*joints)[k].get<double>();
  return s;
}

LinkNumbers link_numbers(const Json& seat) {
  LinkNumbers l;
  const auto link = seat.find("link");
  if (link == seat.end()) return l;
  l.rtt_p50_ms = number(*link, "rtt_p50_ms");
  l.rtt_p99_ms = number(*link, "rtt_p99_ms");
  if (const auto up = link->find("up"); up != link->end())
    l.loss_up_percent = number(*up, "loss_percent"), l.gap_up_ms = number(*up, "longest_gap_ms");
  if (const auto down = link->find("down"); down != link->end())
    l.loss_down_percent = number(*down, "loss_percent"), l.gap_down_ms = number(*down, "longest_gap_ms");
  return l;
}

void take_seat(const Json& seat, ReportNumbers& out) {
  const std::string name = seat.value("name", "");
  if (name == "trainer") out.trainer = seat_numbers(seat), out.trainer_link = link_numbers(seat);
  if (name == "trainee") out.trainee = seat_numbers(seat), out.trainee_link = link_numbers(seat);
  out.effort_peak_n = larger(out.effort_peak_n, number(seat, "effort_peak_n"));
  out.speed_peak_m_s = larger(out.speed_peak_m_s, number(seat, "speed_peak_m_s"));
  out.gate_trips = sum(out.gate_trips, number(seat, "gate_trips"));
  out.late_ticks = sum(out.late_ticks, number(seat, "late_ticks"));
}

PhaseNumbers phase_numbers(const Json& j) {
  PhaseNumbers p;
  p.name = j.value("name", "");
  p.from_s = number(j, "from_s");
  p.to_s = number(j, "to_s");
  for (const Json& seat : j.at("seats")) {
    if (seat.value("name", "") == "trainer") p.trainer = seat_numbers(seat);
    if (seat.value("name", "") == "trainee") p.trainee = seat_numbers(seat);
  }
  return p;
}

ReportNumbers take(const Json& j) {
  ReportNumbers out;
  out.passed = j.at("verdict").get<std::string>() == "pass";
  out.duration_s = number(j, "duration_s");
  out.cpu_s = number(j, "cpu_s");
  out.trace_hash = j.value("trace_hash", "");
  for (const Json& v : j.at("violations"))
    out.violations.push_back({v.at("invariant"), v.value("seat", ""), number(v, "at_s"), v.at("expected")});
  if (const auto machine = j.find("machine"); machine != j.end()) out.late_ticks = number(*machine, "late_ticks");
  for (const Json& seat : j.at("seats")) take_seat(seat, out);
  for (const Json& tool : j.at("tools")) {
    out.contact_force_n = number(tool, "contact_force_rms_n");
    out.penetration_m = number(tool, "penetration_max_m");
  }
  for (const Json& phase : j.at("phases")) out.phases.push_back(phase_numbers(phase));
  return out;
}

}  // namespace

std::expected<ReportNumbers, std::string> read_report(const std::string& json) {
  try {
    return take(Json::parse(json));
  } catch (const Json::exception& error) {
    return std::unexpected(std::string("the report is not what was expected: ") + error.what());
  }
}

double read_late_ticks(const std::string& json) {
  const Json j = Json::parse(json, nullptr, false);
  if (!j.is_object()) return 0;
  const double own = number(j, "late_ticks");
  const auto machine = j.find("machine");
  const double of_machine = machine != j.end() ? number(*machine, "late_ticks") : kUnknown;
  return std::isfinite(own) ? own : std::isfinite(of_machine) ? of_machine : 0;
}

}  // namespace tandem::netsim::demo
