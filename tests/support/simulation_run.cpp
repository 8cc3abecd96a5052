#include "tests/support/simulation_run.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "common/transport/digest.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/report/trace_csv.h"

namespace tandem::test {

SceneSpec shipped(const std::string& name) {
  const auto* found = find_shipped_scene(name);
  if (found == nullptr) throw std::runtime_error("no shipped scene " + name);
  auto scene = parse_scene(found->text, name + ".textproto");
  if (!scene) throw std::runtime_error(to_text(scene.error()));
  return *scene;
}

SceneSpec set_position(const std::string& name) {
  SceneSpec scene = shipped(name);
  choose_law(scene, LawKind::kSetPosition);
  for (ToolSpec& tool : scene.tools) {
    if (!tool.is_virtual) continue;
    tool.is_virtual = false;
    tool.m_s = kDeviceToolMass;
    tool.slave.model = scene.dof == 1 ? DeviceModel::kLinear : DeviceModel::kTouch;
    if (scene.dof == 1) tool.slave.encoder = 5.5e-5;
  }
  if (name == "contact")
    for (SeatSpec& seat : scene.seats) seat.hand.trajectory.waypoints.back().p.x = 0.019;
  return scene;
}

std::vector<SceneSpec> under_both_laws(const std::string& name) { return {shipped(name), set_position(name)}; }

netsim::SimpleNetwork delayed(double delay_ms, double jitter_ms, double loss_percent) {
  netsim::SimpleNetwork net;
  net.delay = from_seconds(delay_ms * 1e-3);
  net.jitter = from_seconds(jitter_ms * 1e-3);
  net.loss = loss_percent / 100;
  return net;
}

netsim::SimpleNetwork with_outages(netsim::SimpleNetwork net, double length_s, double period_s) {
  netsim::OutageSpec outage;
  outage.start = from_seconds(period_s);
  outage.length = from_seconds(length_s);
  outage.period = from_seconds(period_s);
  net.outages.push_back(outage);
  return net;
}

const server::SeatReport& RunResult::seat(const std::string& name) const {
  const auto found = std::ranges::find_if(report.seats, [&](const auto& s) { return s.name == name; });
  if (found == report.seats.end()) throw std::runtime_error("no seat " + name);
  return *found;
}

const server::SeatMetrics& RunResult::phase(const std::string& phase, const std::string& seat) const {
  for (const auto& p : report.phases)
    for (std::size_t i = 0; i < p.seats.size(); ++i)
      if (p.name == phase && report.seats[i].name == seat) return p.seats[i];
  throw std::runtime_error("no phase " + phase + " of " + seat);
}

RunResult run(const SceneSpec& scene, const netsim::SimpleNetwork& net, std::uint64_t seed, const Observer& observer) {
  auto made = netsim::Simulation::make({scene, netsim::link_from(net), seed, {}});
  if (!made) throw std::runtime_error(made.error());
  netsim::Simulation& simulation = **made;
  server::ReportBuilder builder{simulation.scene()};
  const server::TraceCsv csv{simulation.scene()};
  transport::Digest digest;
  std::string row = csv.header();
  digest.add(row);
  RunResult result;
  std::vector<hal::Vec3> force(scene.seats.size(), hal::Vec3::Zero());
  bool force_known = false;
  // Bounds a session that cannot begin: the scene's duration plus 20 s of virtual time.
  const auto most = static_cast<std::uint64_t>((scene.duration + 20) * scene.tick_hz);
  while (simulation.step() && result.ticks < most) {
    ++result.ticks;
    const server::TickRecord& record = simulation.record();
    builder.add(record);
    if (record.running) {
      row.clear();
      csv.append(record, row);
      digest.add(row);
      const double t = record.tick / scene.tick_hz;
      for (std::size_t i = 0; i < scene.masters(); ++i) {
        const bool pushed = std::ranges::any_of(scene.seats[i].hand.deviations, [&](const Deviation& d) {
          return t >= d.at - 0.05 && t <= d.at + d.length + 0.5;
        });
        if (!pushed)
          result.hand_speed_max = std::max(result.hand_speed_max, simulation.device(i).ground_truth().dx.norm());
        const hal::Vec3 f = simulation.device(i).state().f_out;
        if (force_known) result.force_step_max = std::max(result.force_step_max, (f - force[i]).norm());
        force[i] = f;
      }
      force_known = true;
      for (std::size_t j = 0; j < scene.tools.size(); ++j) {
        double sum = 0;
        for (std::size_t i = 0; i < scene.masters(); ++i) sum += simulation.session().tool(j).authority.alpha(i);
        if (!simulation.session().tool(j).authority.held())
          result.authority_error_max = std::max(result.authority_error_max, std::abs(sum - 1));
      }
    }
    if (observer) observer(simulation);
  }
  result.trouble = simulation.trouble();
  result.report = netsim::simulation_report(simulation, builder, seed);
  result.report.trace_hash = digest.hex();
  return result;
}

unsigned count_factor() {
  const char* counts = std::getenv("TANDEM_COUNTS");
  const std::string_view text = counts == nullptr ? "reduced" : counts;
  return text == "nightly" ? 20 : text == "full" ? 5 : 1;
}

}  // namespace tandem::test
