#include "netsim/world_report.h"

namespace tandem::netsim {

namespace {

constexpr double kMs = 1e3;

server::DirectionReport direction(const link::Link& receiver, Time now) {
  const link::LinkStats& s = receiver.stats();
  return {s.loss_percent(), seconds(receiver.longest_gap(now)) * kMs, seconds(Duration{s.age.quantile(0.99)}) * kMs};
}

}  // namespace

std::vector<server::LinkReport> link_reports(const World& world) {
  std::vector<server::LinkReport> reports(world.scene().seats.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const client::Seat* seat = world.seat(i);
    const link::Link* server_end = world.session().seat(i).link();
    if (seat == nullptr || server_end == nullptr) continue;
    reports[i].rtt_p50_ms = seconds(seat->link().freshness().rtt_p50()) * kMs;
    reports[i].rtt_p99_ms = seconds(Duration{seat->link().freshness().rtts().quantile(0.99)}) * kMs;
    reports[i].up = direction(*server_end, world.now());
    reports[i].down = direction(seat->link(), world.own_time(i));
  }
  return reports;
}

server::RunReport world_report(const World& world, const server::ReportBuilder& builder, std::uint64_t seed) {
  server::RunReport report = builder.build(link_reports(world));
  report.seed = seed;
  report.violations = world.violations().list();
  report.passed = world.violations().passed();
  for (std::size_t i = 0; i < report.seats.size(); ++i)
    report.seats[i].gate_trips = world.gate_trips(i);
  return report;
}

}  // namespace tandem::netsim
