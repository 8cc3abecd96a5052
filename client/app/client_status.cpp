#include "client/app/client_status.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/app/device_statistics.h"
#include "common/base/format.h"

namespace tandem::client {
namespace {

nlohmann::ordered_json number(double v) {
  return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
}

}  // namespace

const char* to_text(ExitReason end) noexcept {
  switch (end) {
    case ExitReason::kDone:
      return "done";
    case ExitReason::kServerStopped:
      return "server_stopped";
    case ExitReason::kLeft:
      return "left";
    case ExitReason::kServerLost:
      return "server_lost";
    case ExitReason::kDeviceLost:
      return "device_lost";
    case ExitReason::kSeatGone:
      return "seat_gone";
  }
  return "";
}

const char* to_text(SeatVerdict verdict) noexcept {
  switch (verdict) {
    case SeatVerdict::kPass:
      return "pass";
    case SeatVerdict::kFail:
      return "fail";
    case SeatVerdict::kNotJudged:
      return "not_judged";
  }
  return "";
}

SeatVerdict verdict_of(const ClientReport& report) noexcept {
  if (report.end == ExitReason::kServerLost || report.end == ExitReason::kDeviceLost ||
      report.end == ExitReason::kSeatGone)
    return SeatVerdict::kFail;
  return report.last.session_time >= 0 ? SeatVerdict::kPass : SeatVerdict::kNotJudged;
}

const char* to_text(Role role) noexcept {
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

std::string motors_text(const ClientStatus& s) {
  if (s.motors.hot)
    return s.motors.latched ? "MOTORS TOO HOT for the third time: take your hand off; once they are cool, press b"
                            : "MOTORS TOO HOT: take your hand off until they are cool";
  return s.motors.latched ? "motors were too hot three times: press b" : "";
}

std::string to_json(const ClientReport& r, const SeatSetup& setup) {
  const ClientStatus& s = r.last;
  nlohmann::ordered_json j;
  j["seat"] = setup.seat.name;
  j["kind"] = setup.seat.kind == SeatKind::kMaster ? "MASTER" : "SLAVE";
  j["role"] = to_text(setup.seat.role);
  j["server"] = r.server;
  j["device"] = r.device_note;
  j["verdict"] = to_text(verdict_of(r));
  j["ended_by"] = to_text(r.end);
  j["seconds"] = number(r.seconds);
  j["rejoins"] = s.reconnects;
  j["away_longest_s"] = number(r.outage_longest_s);
  j["session_s"] = number(std::max(0.0, s.session_time));
  j["alpha"] = number(s.alpha);
  j["beside_leader_m"] = s.offset_from_leader_m ? number(*s.offset_from_leader_m) : nlohmann::ordered_json(nullptr);
  j["effort_peak_n"] = number(s.force_peak_n);
  j["gate"] = {{"trips", s.gate_trips}, {"given_after_loss_max_j", number(s.energy.given_after_loss_max_j)}};
  j["motors"] = {{"too_hot", s.motors.hot_trips},
                 {"heat_max", s.motors.heat_max ? number(*s.motors.heat_max) : nlohmann::ordered_json(nullptr)}};
  j["energy"] = {{"in_j", number(s.energy.in_j)},
                 {"out_j", number(s.energy.out_j)},
                 {"dissipated_j", number(s.energy.dissipated_j)},
                 {"refused_j", number(s.energy.refused_j)},
                 {"margin_min_j", number(s.energy.margin_min_j)},
                 {"delivered_j", number(s.energy.delivered_j)}};
  j["link"] = {{"rtt_p50_ms", number(s.link.rtt_p50_ms)},
               {"rtt_p99_ms", number(s.link.rtt_p99_ms)},
               {"sent", s.link.datagrams.sent},
               {"accepted", s.link.datagrams.accepted},
               {"late", s.link.datagrams.late},
               {"refused", s.link.datagrams.refused},
               {"down",
                {{"loss_percent", number(s.link.down_loss_percent)},
                 {"longest_gap_ms", number(s.link.down_longest_gap_ms)},
                 {"age_p99_ms", number(s.link.down_age_p99_ms)}}}};
  j["machine"] = {{"ticks", r.device.ticks},
                  {"late_ticks", s.late_ticks},
                  {"missed_ticks", r.device.missed},
                  {"expired_commands", r.device.expired},
                  {"period_p50_ms", number(r.device.period_p50_s * 1e3)},
                  {"period_p99_ms", number(r.device.period_p99_s * 1e3)},
                  {"period_max_ms", number(r.device.period_max_s * 1e3)},
                  {"trace_dropped", r.trace_dropped},
                  {"realtime", r.realtime}};
  j["device_statistics"] = to_json(r.device, r.histograms);
  return j.dump(2) + "\n";
}

std::string join_failure_json(const std::string& seat, const std::string& server, const std::string& device,
                              const std::string& why) {
  nlohmann::ordered_json j;
  j["seat"] = seat;
  j["server"] = server;
  j["device"] = device;
  j["verdict"] = to_text(SeatVerdict::kNotJudged);
  j["ended_by"] = "never_attached";
  j["reason"] = why;
  return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tandem::client
