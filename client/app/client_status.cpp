#include "client/app/client_status.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/app/device_statistics.h"
#include "common/base/format.h"

namespace tandem::client {
namespace {

using ReportJson = nlohmann::ordered_json;

ReportJson number(double v) { return std::isfinite(v) ? ReportJson(v) : ReportJson(nullptr); }
ReportJson number(const std::optional<double>& v) { return v ? number(*v) : ReportJson(nullptr); }

}  // namespace

const char* to_text(ExitReason end) noexcept {
  constexpr const char* kNames[] = {"done", "server_stopped", "left", "server_lost", "device_lost", "seat_gone"};
  return kNames[static_cast<std::size_t>(end)];
}

const char* to_text(SeatVerdict verdict) noexcept {
  constexpr const char* kNames[] = {"pass", "fail", "not_judged"};
  return kNames[static_cast<std::size_t>(verdict)];
}

SeatVerdict verdict_of(const ClientReport& report) noexcept {
  if (report.end == ExitReason::kServerLost || report.end == ExitReason::kDeviceLost ||
      report.end == ExitReason::kSeatGone)
    return SeatVerdict::kFail;
  return report.last.session_time >= 0 ? SeatVerdict::kPass : SeatVerdict::kNotJudged;
}

const char* to_text(Role role) noexcept {
  constexpr const char* kNames[] = {"INSTRUCTOR", "TRAINEE", "EVALUATOR", "OBSERVER"};
  return kNames[static_cast<std::size_t>(role)];
}

std::string motors_text(const ClientStatus& s) {
  if (s.motors.hot)
    return s.motors.latched ? "MOTORS TOO HOT for the third time: take your hand off; once they are cool, press b"
                            : "MOTORS TOO HOT: take your hand off until they are cool";
  return s.motors.latched ? "motors were too hot three times: press b" : "";
}

std::string to_json(const ClientReport& r, const SeatSetup& setup) {
  const ClientStatus& s = r.last;
  const ReportJson j = {
      {"seat", setup.seat.name},
      {"kind", setup.seat.kind == SeatKind::kMaster ? "MASTER" : "SLAVE"},
      {"role", to_text(setup.seat.role)},
      {"server", r.server},
      {"device", r.device_note},
      {"verdict", to_text(verdict_of(r))},
      {"ended_by", to_text(r.end)},
      {"seconds", number(r.seconds)},
      {"rejoins", s.reconnects},
      {"away_longest_s", number(r.outage_longest_s)},
      {"session_s", number(std::max(0.0, s.session_time))},
      {"alpha", number(s.engaged.alpha())},
      {"alpha_mean", number(s.engaged.alpha_mean())},
      {"beside_leader_m", number(s.engaged.beside_leader_m())},
      {"beside_leader_mean_m", number(s.engaged.beside_leader_mean_m())},
      {"effort_peak_n", number(s.force_peak_n)},
      {"gate", {{"trips", s.gate_trips}, {"given_after_loss_max_j", number(s.energy.given_after_loss_max_j)}}},
      {"motors", {{"too_hot", s.motors.hot_trips}, {"heat_max", number(s.motors.heat_max)}}},
      {"energy",
       {{"in_j", number(s.energy.in_j)},
        {"out_j", number(s.energy.out_j)},
        {"dissipated_j", number(s.energy.dissipated_j)},
        {"refused_j", number(s.energy.refused_j)},
        {"margin_min_j", number(s.energy.margin_min_j)},
        {"delivered_j", number(s.energy.delivered_j)}}},
      {"link",
       {{"rtt_p50_ms", number(s.link.rtt_p50_ms)},
        {"rtt_p99_ms", number(s.link.rtt_p99_ms)},
        {"sent", s.link.datagrams.sent},
        {"accepted", s.link.datagrams.accepted},
        {"late", s.link.datagrams.late},
        {"refused", s.link.datagrams.refused},
        {"down",
         {{"loss_percent", number(s.link.down_loss_percent)},
          {"longest_gap_ms", number(s.link.down_longest_gap_ms)},
          {"age_p99_ms", number(s.link.down_age_p99_ms)}}}}},
      {"machine",
       {{"ticks", r.device.ticks},
        {"late_ticks", s.late_ticks},
        {"missed_ticks", r.device.missed},
        {"expired_commands", r.device.expired},
        {"period_p50_ms", number(r.device.period_p50_s * 1e3)},
        {"period_p99_ms", number(r.device.period_p99_s * 1e3)},
        {"period_max_ms", number(r.device.period_max_s * 1e3)},
        {"trace_dropped", r.trace_dropped},
        {"realtime", r.realtime}}},
      {"device_statistics", to_json(r.device, r.histograms)}};
  return j.dump(2) + "\n";
}

std::string server_lost_text(bool announced, double waited_s, const std::string& answer) {
  const std::string newest = answer.empty() ? "" : "Newest reason: " + answer + ". ";
  if (announced)
    return format(
        "server lost: it ended or gave the session away, and no server has given the seat back for %.0f s. %sAsk its "
        "operator when it serves the session again, then join again",
        waited_s, newest.c_str());
  if (!answer.empty())
    return format(
        "server lost: a server was reached, but none has given the seat back for %.0f s. %sAsk its operator, then join "
        "again",
        waited_s, newest.c_str());
  return format(
      "server lost: no news for %.0f s; the force was released after the first losses. Check the network and the "
      "server, then join again",
      waited_s);
}

std::string join_failure_json(const std::string& seat, const std::string& server, const std::string& device,
                              const std::string& why) {
  const ReportJson j = {{"seat", seat},
                        {"server", server},
                        {"device", device},
                        {"verdict", to_text(SeatVerdict::kNotJudged)},
                        {"ended_by", "never_attached"},
                        {"reason", why}};
  return j.dump(2, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

}  // namespace tandem::client
