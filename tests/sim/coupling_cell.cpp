#include "tests/sim/coupling_cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"
#include "netsim/system/simulation.h"
#include "proto/text/scene_text.h"
#include "tests/support/simulation_run.h"

namespace tandem::test {
namespace {

using hal::Vec3;
using netsim::DrawnHand;
using netsim::HandKind;

struct Course {
  double length = 7, from = 3;  ///< of the session, and of what is measured [s]
};
Course course_of(Motion motion) {
  if (motion == Motion::kPress) return {9, 7};
  if (motion == Motion::kKick) return {8, 5.3};
  return {};
}

Vec3 intention(Motion motion, double t) {
  constexpr double kTurn = 2 * std::numbers::pi;
  switch (motion) {
    case Motion::kCircle: {
      const double r = 0.05 * hal::sim::min_jerk(t).value;
      return {r * std::cos(kTurn * 0.5 * t), 0, r * std::sin(kTurn * 0.5 * t)};
    }
    case Motion::kReach: {
      const double phase = std::fmod(t, 2.0);
      const double there = hal::sim::min_jerk(phase / 0.5).value - hal::sim::min_jerk((phase - 1) / 0.5).value;
      return {0.04 * there, 0, 0};
    }
    case Motion::kPress:
      return {-0.01 + 0.01 * hal::sim::min_jerk((t - 1) / 1).value + 0.008 * hal::sim::min_jerk((t - 2) / 2).value, 0,
              0};
    default:
      return netsim::kick_path(t);
  }
}

netsim::SimulationConfig config_of(SceneSpec scene, std::size_t hands, double delay_ms, Motion motion,
                                   std::uint64_t seed) {
  const Course course = course_of(motion);
  scene.timeline.clear();
  scene.phases.clear();
  scene.duration = course.length;
  const SeatSpec pattern = scene.seats[0];
  scene.seats.assign(hands, pattern);
  scene.follow = {};
  AuthorityRow row;
  netsim::SimulationConfig out;
  for (std::size_t i = 0; i < hands; ++i) {
    SeatSpec& seat = scene.seats[i];
    seat.name = "hand" + std::to_string(i);
    seat.role = i == 0 ? Role::kInstructor : Role::kTrainee;
    seat.required = true;
    seat.device.start = {motion == Motion::kPress ? -0.01 : 0, 0, 0};
    const DrawnHand hand{HandKind::kDrawn, seed, i}, steady{HandKind::kPlain, seed, i};  // `steady`: without tremor
    const bool kick = motion == Motion::kKick;
    if (kick) {
      seat.hand = hand.with_impedance(HandModel::kRecorded, 50, 1, 0.2);
      const auto still = [](double) { return Vec3(0, 0, 0); };
      out.motions[seat.name] = i == 0 ? steady.move([&](double t) { return intention(motion, t); }, course.length)
                                      : steady.move(still, course.length);
    } else if (i == 0) {
      seat.hand = netsim::firm(hand);
      out.motions[seat.name] = hand.move([&](double t) { return intention(motion, t); }, course.length);
    } else {
      seat.hand = netsim::relaxed(hand);
    }
    scene.follow[i][0] = 1;
    row.alpha[i] = kick ? 1.0 / static_cast<double>(hands) : (i == 0 ? 1 : 0);
  }
  scene.tools[0].slave.start = scene.seats[0].device.start;
  scene.tools[0].environment = motion == Motion::kPress ? netsim::wall_of(netsim::kBone) : EnvironmentSpec{};
  scene.authority = {row};
  if (const auto problem = law_problem(scene)) throw std::runtime_error(problem->words);
  out.scene = std::move(scene);
  out.network = netsim::link_from(delayed(delay_ms));
  out.seed = seed;
  return out;
}

CellValues measure(const netsim::SimulationConfig& config, Motion motion) {
  auto made = netsim::Simulation::make(config);
  if (!made) throw std::runtime_error(made.error());
  netsim::Simulation& simulation = **made;
  const Course course = course_of(motion);
  const std::size_t hands = config.scene.seats.size();
  std::vector<std::vector<Vec3>> x(hands), f(hands);
  std::vector<Vec3> tool, bone;
  double engaged = 0, rows = 0;
  const auto vector_of = [](const server::Triple& v) { return Vec3(v[0], v[1], v[2]); };
  while (simulation.step()) {
    const server::TickRecord& record = simulation.record();
    if (!record.running || record.tick / config.scene.tick_hz < course.from) continue;
    for (std::size_t i = 0; i < hands; ++i) {
      x[i].push_back(vector_of(record.seats[i].x));
      f[i].push_back(vector_of(record.seats[i].f_out));
    }
    tool.push_back(vector_of(record.tools[0].x));
    bone.push_back(vector_of(record.tools[0].f_env));
    engaged += record.seats[0].engaged ? 1 : 0;
    ++rows;
  }
  if (!simulation.trouble().empty() || tool.empty()) throw std::runtime_error("no session: " + simulation.trouble());
  CellValues out;
  out.engaged = engaged / rows;
  const auto shaking = [&](std::size_t from) {
    double worst = 0;
    for (std::size_t i = from; i < hands; ++i)
      worst = netsim::larger(worst, netsim::rms_above(f[i], 1, config.scene.tick_hz));
    return worst;
  };
  if (motion == Motion::kKick) {
    out.shaking = shaking(0);
  } else if (motion == Motion::kPress) {
    const double depth = netsim::mean(netsim::along_x(x[0])), felt = -netsim::mean(netsim::along_x(f[0])),
                 exerted = -netsim::mean(netsim::along_x(bone));
    out.stiffness = depth > 0 ? std::max(0.0, std::min(felt, exerted)) / depth : 0;
    out.unrest = shaking(1);
  } else {
    out.tracking = netsim::rms_difference(x[0], tool);
    out.following = 0;
    for (std::size_t i = 1; i < hands; ++i)
      out.following += netsim::rms_difference(x[i], x[0]) / static_cast<double>(hands - 1);
    out.drag = netsim::rms(f[0]);
  }
  return out;
}

SceneSpec scene_of(const Contender& contender) {
  SceneSpec scene = shipped("free_motion");
  choose_law(scene, contender.law);
  scene.channel.coupling = contender.coupling;
  return scene;
}

}  // namespace

CellValues run_cell(const Contender& contender, std::size_t hands, double delay_ms, Motion motion, std::uint64_t seed) {
  return measure(config_of(scene_of(contender), hands, delay_ms, motion, seed), motion);
}

Cell average_cell(const Contender& contender, std::size_t hands, double delay_ms, std::uint64_t seeds) {
  Cell cell;
  const auto n = static_cast<double>(seeds);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const Motion motion : {Motion::kCircle, Motion::kReach}) {
      const CellValues v = run_cell(contender, hands, delay_ms, motion, seed);
      cell.tracking += v.tracking / (2 * n);
      cell.following += v.following / (2 * n);
      cell.drag += v.drag / (2 * n);
    }
    const CellValues press = run_cell(contender, hands, delay_ms, Motion::kPress, seed);
    cell.stiffness += press.stiffness / n;
    cell.unrest += press.unrest / n;
    cell.unstable += run_cell(contender, hands, delay_ms, Motion::kKick, seed).unstable() ? 1 / n : 0;
  }
  return cell;
}

bool loses(const Measure& measure, const Cell& own, const Cell& other) {
  const double mine = own.*measure.value, theirs = other.*measure.value;
  const double behind = measure.more ? theirs - mine : mine - theirs;
  return behind > 0.1 * std::abs(theirs) && behind > measure.tolerance;
}

CellValues run_raw_peers(std::size_t hands, double delay_ms, double k, std::uint64_t seed) {
  SceneSpec scene = scene_of({"raw + pd_peer", LawKind::kRaw, HandCouplingKind::kPdPeer});
  scene.channel.k = k;
  scene.channel.k_min = std::min(scene.channel.k_min, k);
  return measure(config_of(std::move(scene), hands, delay_ms, Motion::kKick, seed), Motion::kKick);
}

}  // namespace tandem::test
