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
  SeatNumbers s{.tracking_m = number(j, "tracking_rms_m"),
                .lag_removed_m = number(j, "tracking_rms_lag_removed_m"),
                .transport_lag_m = number(j, "transport_lag_rms_m"),
                .force_error_n = number(j, "force_error_rms_n"),
                .force_error_commanded_n = number(j, "force_error_commanded_rms_n")};
  if (const auto joints = j.find("joint_rms_rad"); joints != j.end() && joints->is_array())
    for (std::size_t k = 0; k < std::min<std::size_t>(3, joints->size()); ++k)
      if ((*joints)[k].is_number()) s.joint_rad[k] = (*joints)[k].get<double>();
  return s;
}

/// Returns the number `key` of the object `part` in `j`.
double number_in(const Json& j, const char* part, const char* key) {
  const auto at = j.find(part);
  return at != j.end() ? number(*at, key) : kUnknown;
}

LinkNumbers link_numbers(const Json& seat) {
  const auto link = seat.find("link");
  if (link == seat.end()) return {};
  return {.rtt_p50_ms = number(*link, "rtt_p50_ms"),
          .rtt_p99_ms = number(*link, "rtt_p99_ms"),
          .loss_up_percent = number_in(*link, "up", "loss_percent"),
          .loss_down_percent = number_in(*link, "down", "loss_percent"),
          .gap_up_ms = number_in(*link, "up", "longest_gap_ms"),
          .gap_down_ms = number_in(*link, "down", "longest_gap_ms")};
}

/// Reads the numbers of a seat into those of the trainer or of the trainee in `out`; other seats have none.
template <typename Numbers>
void take_seat(const Json& seat, Numbers& out) {
  const std::string name = seat.value("name", "");
  if (name == "trainer") out.trainer = seat_numbers(seat);
  if (name == "trainee") out.trainee = seat_numbers(seat);
}

PhaseNumbers phase_numbers(const Json& j) {
  PhaseNumbers p{.name = j.value("name", ""), .from_s = number(j, "from_s"), .trainer = {}, .trainee = {}};
  for (const Json& seat : j.at("seats")) take_seat(seat, p);
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
  out.late_ticks = number_in(j, "machine", "late_ticks");
  for (const Json& seat : j.at("seats")) {
    take_seat(seat, out);
    if (seat.value("name", "") == "trainer") out.trainer_link = link_numbers(seat);
    if (seat.value("name", "") == "trainee") out.trainee_link = link_numbers(seat);
    out.effort_peak_n = larger(out.effort_peak_n, number(seat, "effort_peak_n"));
    out.speed_peak_m_s = larger(out.speed_peak_m_s, number(seat, "speed_peak_m_s"));
    out.gate_trips = sum(out.gate_trips, number(seat, "gate_trips"));
    out.late_ticks = sum(out.late_ticks, number(seat, "late_ticks"));
  }
  for (const Json& tool : j.at("tools")) out.contact_force_n = number(tool, "contact_force_rms_n");
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
  const double own = number(j, "late_ticks"), of_machine = number_in(j, "machine", "late_ticks");
  return std::isfinite(own) ? own : std::isfinite(of_machine) ? of_machine : 0;
}

}  // namespace tandem::netsim::demo
