#include "netsim/system/simulation_report.h"

namespace tandem::netsim {

namespace {

constexpr double kMs = 1e3;

server::DirectionReport direction(const transport::SecureChannel& receiver, Time now) {
  const transport::SecureChannelStats& s = receiver.stats();
  return {s.loss_percent(), seconds(receiver.longest_gap(now)) * kMs, seconds(Duration{s.age.quantile(0.99)}) * kMs};
}

}  // namespace

std::vector<server::LinkReport> link_reports(const Simulation& world) {
  std::vector<server::LinkReport> reports(world.scene().seats.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const client::Seat* seat = world.seat(i);
    const transport::SecureChannel* server_end = world.session().seat(i).link();
    if (seat == nullptr || server_end == nullptr) continue;
    reports[i].rtt_p50_ms = seconds(seat->link().timing().rtt_p50()) * kMs;
    reports[i].rtt_p99_ms = seconds(Duration{seat->link().timing().rtts().quantile(0.99)}) * kMs;
    reports[i].up = direction(*server_end, world.now());
    reports[i].down = direction(seat->link(), world.client(i).own_time(world.now()));
  }
  return reports;
}

server::RunReport simulation_report(const Simulation& world, const server::ReportBuilder& builder, std::uint64_t seed) {
  server::RunReport report = builder.build(link_reports(world));
  report.seed = seed;
  report.violations = world.violations().list();
  report.passed = world.violations().passed();
  for (std::size_t i = 0; i < report.seats.size(); ++i)
    report.seats[i].gate_trips = world.client(i).program().gate_trips();
  return report;
}

}  // namespace tandem::netsim
