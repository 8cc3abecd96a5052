#include "server/app/monitor/metrics.h"

#include <prometheus/text_serializer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/io/clock.h"
#include "common/io/log.h"

namespace tandem::server {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

constexpr Duration kTickAgeMax = std::chrono::seconds(1);

/// A metrics page under construction. Families appear in the order of their first value.
class Families {
 public:
  void count(const char* name, const char* help, Labels labels, double value) {
    metric(name, help, MetricType::Counter, std::move(labels)).counter.value = value;
  }
  void gauge(const char* name, const char* help, Labels labels, double value) {
    metric(name, help, MetricType::Gauge, std::move(labels)).gauge.value = value;
  }
  void ticks(const char* name, const char* help, Labels labels, const TickHistogram& counts) {
    ClientMetric::Histogram& h = metric(name, help, MetricType::Histogram, std::move(labels)).histogram;
    std::uint64_t so_far = 0;
    for (std::size_t i = 0; i < TickHistogram::kBounds.size(); ++i)
      h.bucket.push_back({so_far += counts.count(i), TickHistogram::kBounds[i]});
    h.sample_count = so_far + counts.count(TickHistogram::kBounds.size());
    h.sample_sum = counts.sum();
  }
  [[nodiscard]] std::string text() const { return prometheus::TextSerializer{}.Serialize(families_); }

 private:
  ClientMetric& metric(const char* name, const char* help, MetricType type, Labels labels) {
    auto family = std::ranges::find(families_, name, &MetricFamily::name);
    if (family == families_.end()) family = families_.insert(family, {name, help, type, {}});
    ClientMetric& made = family->metric.emplace_back();
    made.label = std::move(labels);
    return made;
  }
  std::vector<MetricFamily> families_;
};

const char* to_text(transport::DropReason reason) {
  constexpr const char* kNames[] = {"header", "connection", "too_old", "tag", "duplicate", "body", "rate", "role"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(transport::DropReason::kCount));
  return kNames[static_cast<std::size_t>(reason)];
}

void describe_seat(Families& page, const Labels& who, const SeatStatus& seat) {
  const auto with = [&](const char* name, std::string value) {
    Labels labels = who;
    labels.push_back({name, std::move(value)});
    return labels;
  };
  page.gauge("tandem_seat_taken", "Whether a client has joined this seat", who, seat.taken ? 1 : 0);
  page.gauge("tandem_authority", "Authority of the seat over the tool it follows", who, seat.alpha);
  page.gauge("tandem_gate_state", "Force gate: 0 off, 1 zero, 2 ramp-in, 3 active, 4 releasing, 5 latched, 6 fault",
             who, static_cast<double>(seat.gate));
  page.count("tandem_gate_trip_total", "Times the force gate tripped", who, seat.gate_trips);
  page.gauge("tandem_energy_joules", "Least unspent energy of the seat's ledger so far", with("port", "margin"),
             seat.margin_j);
  if (!seat.taken) return;  // the other metrics are per connection
  page.gauge("tandem_loop_age_seconds", "Age of the newest echo of the seat", who, seat.loop_age_s);
  page.gauge("tandem_rtt_seconds", "Round trip of the network, without the waits for ticks", with("quantile", "0.5"),
             1e-3 * seat.link.rtt_p50_ms);
  page.gauge("tandem_rtt_seconds", "", with("quantile", "0.99"), 1e-3 * seat.recent_rtt_p99_ms);
  page.count("tandem_udp_accepted_total", "Datagrams that were applied", who, static_cast<double>(seat.accepted));
  page.count("tandem_udp_late_total", "Authentic datagrams older than one that was applied", who,
             static_cast<double>(seat.late));
  page.count("tandem_udp_lost_total", "Datagrams that did not arrive", who, static_cast<double>(seat.lost));
  page.count("tandem_client_tick_late_total", "Late servo ticks of the client's machine", who, seat.late_ticks);
}

void describe_service(Families& page, const ServiceStatus& service) {
  page.gauge("tandem_service_registered", "1: the server is registered in its service", {}, service.registered ? 1 : 0);
  page.gauge("tandem_service_directory_answers", "1: the directory of the service has answered in the last 2 s", {},
             service.answers ? 1 : 0);
  page.gauge("tandem_service_follows", "1: the server's copy of the directory is up to date", {},
             service.follows ? 1 : 0);
  if (service.lease_age_s)
    page.gauge("tandem_service_lease_age_seconds", "Time since the newest renewal of the lease was sent", {},
               *service.lease_age_s);
  page.gauge("tandem_service_held", "1: the sessions are HELD, because the lease was not renewed in time", {},
             service.held() ? 1 : 0);
  page.gauge("tandem_service_owned_sessions", "Sessions of the service that this server serves", {},
             static_cast<double>(service.owned));
  page.gauge("tandem_service_sessions", "Sessions of the service, as far as this server knows", {},
             static_cast<double>(service.sessions));
  page.gauge("tandem_service_members", "Servers of the service, as far as this server knows", {},
             static_cast<double>(service.members));
  page.count("tandem_service_moves_total", "Sessions that this server has begun to move to other servers", {},
             static_cast<double>(service.moves));
  page.count("tandem_service_directory_lost_total",
             "Times at which the directory was begun from nothing, or put back to an older state", {},
             static_cast<double>(service.losses));
  page.count("tandem_service_unanswered_total", "Requests to the directory without an answer", {},
             static_cast<double>(service.unanswered));
  page.count("tandem_service_written_total", "Snapshots and lists that were written to the directory", {},
             static_cast<double>(service.writes.written));
  page.count("tandem_service_refused_total", "Snapshots and lists that came after the end of an ownership", {},
             static_cast<double>(service.writes.refused));
  page.gauge("tandem_service_voucher_expiry_seconds",
             "Last second at which the voucher of this server is valid, since 1970, UTC", {},
             static_cast<double>(service.voucher_ends));
}

std::string metrics(const SessionRegistry& registry, const ControlPlane& plane, const AuditState& audit,
                    const ServiceStatus* service) {
  Families page;
  if (service != nullptr) describe_service(page, *service);
  const RejectedDatagrams rejected = registry.rejected();
  std::array<std::size_t, rpc::kSessionPhases> sessions{};
  std::uint64_t stray = rejected.unmatched;
  for (const SessionEntry& entry : registry.entries()) {
    if (entry.closing) continue;
    const SessionStatus status = entry.session().status();
    ++sessions[static_cast<std::size_t>(phase_of(status.state, status.may_act))];
    const auto& seats = entry.scene().seats;
    const std::string& name = entry.registration.name;
    for (std::size_t i = 0; i < seats.size(); ++i)
      describe_seat(page, {{"session", name}, {"seat", seats[i].name}}, status.seats[i]);
    page.gauge("tandem_session_time_seconds", "Session time", {{"session", name}}, status.time);
    page.count("tandem_audit_events_lost_total",
               "Events of the session lost because its queue was full: they are not in the audit log",
               {{"session", name}}, static_cast<double>(status.audit_dropped));
    const auto recording = entry.registration.recording ? entry.registration.recording->status() : std::nullopt;
    page.gauge("tandem_recording", "1: the server records the session", {{"session", name}}, recording ? 1 : 0);
    if (recording) {
      page.count("tandem_recording_dropped_ticks_total", "Ticks that the recording of the session lost",
                 {{"session", name}}, static_cast<double>(recording->dropped));
      page.gauge("tandem_recording_failing", "1: the recording drops ticks now", {{"session", name}},
                 recording->trouble.empty() ? 0 : 1);
    }
    page.gauge("tandem_session_broken", "1: an invariant that the session's law promises was broken",
               {{"session", name}}, static_cast<double>(status.violations));
  }
  for (std::size_t i = 0; i < sessions.size(); ++i)
    page.gauge("tandem_sessions", "Sessions by phase", {{"phase", rpc::to_text(static_cast<rpc::SessionPhase>(i))}},
               static_cast<double>(sessions[i]));
  page.count("tandem_session_moves_total", "Sessions that moved from a strained tick thread to another", {},
             static_cast<double>(registry.moves()));
  const std::vector<const Shard*> shards = registry.requests().shards();
  for (std::size_t i = 0; i < shards.size(); ++i) {
    const Shard* const shard = shards[i];
    const Labels who{{"tick_hz", std::to_string(std::lround(1.0 / seconds(shard->period())))},
                     {"shard", std::to_string(i)}};
    page.gauge("tandem_shard_sessions", "Sessions that the tick thread serves", who,
               static_cast<double>(shard->sessions()));
    page.ticks("tandem_tick_seconds", "Processor time of a tick, all sessions of a shard", who,
               shard->load().lengths());
    page.ticks("tandem_tick_lateness_seconds", "Lateness of the start of ticks", who, shard->load().lateness());
    page.count("tandem_tick_late_total", "Ticks that began more than 1 ms late", who,
               static_cast<double>(shard->load().late_ticks()));
    page.gauge("tandem_tick_load", "Processor time of a tick, 99th percentile of the last 1000, share of the tick", who,
               shard->load().tick_share());
    page.gauge("tandem_core_load", "Processor time of the thread, over the last second, share of one processor", who,
               shard->load().cpu_share());
    page.gauge("tandem_shed_level",
               "Load-shedding level: 0 none, 1 telemetry, 2-3 observers, 4-5 evaluators, 6 new joins", who,
               static_cast<double>(shard->load().state().level));
    page.gauge("tandem_overloaded", "1: the ticks of the thread are late, and all hands of its sessions are released",
               who, shard->load().state().overloaded ? 1 : 0);
    page.count("tandem_overloads_total", "Times at which the ticks of the thread became so late", who,
               static_cast<double>(shard->load().overloads()));
    stray += shard->unmatched_datagrams();
  }
  for (std::size_t r = 0; r < rejected.by_reason.size(); ++r)
    page.count("tandem_udp_drop_total", "Rejected datagrams, by reason",
               {{"reason", to_text(static_cast<transport::DropReason>(r))}},
               static_cast<double>(rejected.by_reason[r]));
  page.count("tandem_udp_drop_total", "", {{"reason", "stray"}}, static_cast<double>(stray));
  page.count("tandem_aead_fail_total", "Datagrams whose tag was wrong", {},
             static_cast<double>(rejected.by_reason[static_cast<std::size_t>(transport::DropReason::kTag)]));
  for (std::size_t i = 0; i < kControlEvents; ++i)
    page.count("tandem_joins_total", "Events of the control connections, by result",
               {{"result", std::string(to_text(static_cast<ControlEvent>(i)))}},
               static_cast<double>(plane.count(static_cast<ControlEvent>(i))));
  page.gauge("tandem_draining", "1: the server rejects new joins", {}, registry.drain().active() ? 1 : 0);
  page.count("tandem_audit_lost_total", "Lines that could not be written to the audit log", {},
             static_cast<double>(audit.lost));
  page.count("tandem_audit_suppressed_total",
             "Lines about refused peers that the rate limit of the audit log suppressed", {},
             static_cast<double>(audit.left_out));
  page.gauge("tandem_audit_failing", "1: the audit log cannot be written, or not be rotated", {},
             audit.trouble.empty() ? 0 : 1);
  page.count("tandem_log_drop_total", "Log lines that could not be written in time", {},
             static_cast<double>(io::log_dropped()));
  return page.text();
}

/// Message about a shard that does not tick; empty if all do.
std::string stalled_text(const SessionRegistry& registry) {
  const Time now = io::monotonic_now();
  for (const Shard* shard : registry.requests().shards())
    if (now - shard->load().last_tick() > kTickAgeMax)
      return "a tick thread has not run for " + std::to_string(seconds(now - shard->load().last_tick())) + " s\n";
  return {};
}

/// Why a member of a service can take no clients now; empty: it can.
const char* unready_text(const ServiceStatus& service) {
  if (!service.answers)
    return service.held() ? "the directory of the service does not answer, and the sessions are HELD\n"
                          : "the directory of the service does not answer\n";
  if (service.name_taken) return "another server is registered in the service under the name of this one\n";
  if (!service.registered) return "this server is not registered in its service\n";
  if (service.recovers)
    return "the directory of the service was begun from nothing, or put back to an older state: sessions are served "
           "again within seconds\n";
  return service.held() ? "the sessions are HELD: the lease of this server was not renewed in time\n" : "";
}

}  // namespace

HttpResponse monitoring_page(std::string_view path, const SessionRegistry& registry, const ControlPlane& plane,
                             const AuditState& audit, const ServiceStatus* service) {
  if (path == "/metrics")
    return {200, "text/plain; version=0.0.4; charset=utf-8", metrics(registry, plane, audit, service)};
  if (path != "/healthz" && path != "/readyz") return {404, "text/plain", "/metrics, /healthz or /readyz\n"};
  const std::string why = stalled_text(registry);
  if (!why.empty()) return {503, "text/plain", why};
  if (path == "/readyz" && registry.drain().active()) return {503, "text/plain", "draining\n"};
  if (path == "/readyz" && !audit.trouble.empty())
    return {503, "text/plain", "the audit log fails; the server's own log has the cause\n"};
  if (path == "/readyz" && service != nullptr)
    if (const std::string unready = unready_text(*service); !unready.empty()) return {503, "text/plain", unready};
  return {200, "text/plain", "ok\n"};
}

}  // namespace tandem::server
