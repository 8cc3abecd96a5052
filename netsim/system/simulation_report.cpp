#include "netsim/system/simulation_report.h"

namespace tandem::netsim {

namespace {

constexpr double kMs = 1e3;

server::DirectionReport direction(const transport::SecureChannel& receiver, Time now) {
  const transport::SecureChannelStats& s = receiver.stats();
  return {s.loss_percent(), seconds(receiver.longest_gap(now)) * kMs, seconds(Duration{s.age.quantile(0.99)}) * kMs};
}

}  // namespace

std::vector<server::LinkReport> link_reports(const Simulation& simulation) {
  std::vector<server::LinkReport> reports(simulation.scene().seats.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const client::Seat* seat = simulation.seat(i);
    const transport::SecureChannel* server_end = simulation.session().seat(i).link();
    if (seat == nullptr || server_end == nullptr) continue;
    reports[i].rtt_p50_ms = seconds(seat->link().timing().rtt_p50()) * kMs;
    reports[i].rtt_p99_ms = seconds(Duration{seat->link().timing().rtts().quantile(0.99)}) * kMs;
    reports[i].up = direction(*server_end, simulation.now());
    reports[i].down = direction(seat->link(), simulation.client(i).own_time(simulation.now()));
  }
  return reports;
}

server::RunReport simulation_report(const Simulation& simulation, const server::ReportBuilder& builder,
                                    std::uint64_t seed) {
  server::RunReport report = builder.build(link_reports(simulation));
  report.seed = seed;
  report.violations = simulation.violations().list();
  report.passed = simulation.violations().passed();
  for (std::size_t i = 0; i < report.seats.size(); ++i)
    report.seats[i].gate_trips = simulation.client(i).program().gate_trips();
  return report;
}

}  // namespace tandem::netsim
