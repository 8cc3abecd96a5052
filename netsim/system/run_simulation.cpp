#include "netsim/system/run_simulation.h"

#include <stdexcept>

#include "common/transport/digest.h"
#include "netsim/feel/observed_feel.h"
#include "netsim/system/session_notes.h"
#include "netsim/system/simulation.h"
#include "netsim/system/simulation_report.h"
#include "server/report/trace_csv.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kRowsAtOnce = 60'000;  // [bytes]
constexpr std::uint64_t kTicksPerLook = 250;

/// Makes a simulation; also returns the errors of links, which Simulation::make throws.
std::expected<std::unique_ptr<Simulation>, std::string> make(const SimulationConfig& setup) {
  try {
    return Simulation::make(setup);
  } catch (const std::invalid_argument& e) {
    return std::unexpected(std::string(e.what()));
  }
}

}  // namespace

SimulationResult run_simulation(const SimulationConfig& setup, const SimulationObserver& observer) {
  const auto made = make(setup);
  SimulationResult run;
  if (!made) {
    run.trouble = made.error();
    return run;
  }
  run = run_simulation(**made, setup.seed, observer);
  if (run.trouble.empty()) run.notes = session_notes(setup, session_span(**made));
  return run;
}

SimulationResult run_simulation(Simulation& simulation, std::uint64_t seed, const SimulationObserver& observer) {
  SimulationResult run;
  server::ReportBuilder builder{simulation.scene()};
  ObservedFeel feel{simulation.scene()};
  const server::TraceCsv csv{simulation.scene()};
  transport::Digest digest;
  std::string rows = csv.header();
  if (observer.begin) observer.begin(simulation);
  const auto flush = [&] {
    digest.add(rows);
    if (observer.trace) observer.trace(rows);
    rows.clear();
  };
  for (std::uint64_t n = 0; simulation.step(); ++n) {
    if (observer.tick) observer.tick(simulation);
    const server::TickRecord& record = simulation.record();
    builder.add(record);
    feel.add(record);
    if (record.running) csv.append(record, rows);
    if (rows.size() > kRowsAtOnce) flush();
    if (n % kTicksPerLook == 0 && observer.keep_running &&
        !observer.keep_running(simulation.session().clock().time())) {
      run.interrupted = true;
      break;
    }
  }
  flush();
  run.trouble = simulation.trouble();
  run.links = simulation.link_qualities();
  run.report = simulation_report(simulation, builder, seed);
  run.report.trace_hash = digest.hex();
  std::vector<std::uint32_t> trips;
  for (const server::SeatReport& seat : run.report.seats) trips.push_back(seat.gate_trips);
  run.report.feel = feel.values(trips);
  if (run.trouble.empty() && run.report.duration_s <= 0 && !run.interrupted)
    run.trouble = "the session never ran: there is nothing to judge";
  return run;
}

}  // namespace tandem::netsim
