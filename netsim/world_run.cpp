#include "netsim/world_run.h"

#include <stdexcept>

#include "common/link/digest.h"
#include "netsim/feel/observed_feel.h"
#include "netsim/world.h"
#include "netsim/world_notes.h"
#include "netsim/world_quality.h"
#include "netsim/world_report.h"
#include "server/trace_csv.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kRowsAtOnce = 60'000;  // [bytes]
constexpr std::uint64_t kTicksPerLook = 250;

/// Also of a link that cannot be simulated, which World::make throws.
std::expected<std::unique_ptr<World>, std::string> make(const WorldSetup& setup) {
  try {
    return World::make(setup);
  } catch (const std::invalid_argument& e) {
    return std::unexpected(std::string(e.what()));
  }
}

}  // namespace

WorldRun run_world(const WorldSetup& setup, const WorldRunWatch& watch) {
  const auto made = make(setup);
  WorldRun run;
  if (!made) {
    run.trouble = made.error();
    return run;
  }
  run = run_world(**made, setup.seed, watch);
  if (run.trouble.empty()) run.notes = session_notes(setup, session_span(**made));
  return run;
}

WorldRun run_world(World& world, std::uint64_t seed, const WorldRunWatch& watch) {
  WorldRun run;
  server::ReportBuilder builder{world.scene()};
  ObservedFeel feel{world.scene()};
  const server::TraceCsv csv{world.scene()};
  link::Digest digest;
  std::string rows = csv.header();
  const auto flush = [&] {
    digest.add(rows);
    if (watch.trace) watch.trace(rows);
    rows.clear();
  };
  for (std::uint64_t n = 0; world.step(); ++n) {
    if (watch.tick) watch.tick(world);
    const server::TickRecord& record = world.record();
    builder.add(record);
    feel.add(record);
    if (record.running) csv.append(record, rows);
    if (rows.size() > kRowsAtOnce) flush();
    if (n % kTicksPerLook == 0 && watch.go_on && !watch.go_on(world.session().time())) {
      run.interrupted = true;
      break;
    }
  }
  flush();
  run.trouble = world.trouble();
  run.links = link_qualities(world);
  run.report = world_report(world, builder, seed);
  run.report.trace_hash = digest.hex();
  std::vector<std::uint32_t> trips;
  for (const server::SeatReport& seat : run.report.seats) trips.push_back(seat.gate_trips);
  run.report.feel = feel.values(trips);
  if (run.trouble.empty() && run.report.duration_s <= 0 && !run.interrupted)
    run.trouble = "the session never ran: there is nothing to judge";
  return run;
}

}  // namespace tandem::netsim
