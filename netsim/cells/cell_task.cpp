#include "netsim/cells/cell_task.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/milliseconds.h"
#include "common/base/rng.h"
#include "netsim/feel/probes.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kCircleHz = 0.5, kCircleRadius = 0.05, kCircleEnd = 9;            // [Hz, m, s]
constexpr double kStepAt = 4, kStepFor = 0.15, kStepAway = 0.02;                   // [s, s, m]
constexpr double kLeadAt = 3, kLeadFor = 0.5, kLeadAway = 0.03;                    // [s, s, m]
constexpr double kSlowAt = 5, kSlowHz = 0.25, kSlowRadius = 0.02, kSlowEnd = 8.5;  // [s, Hz, m, s]
constexpr double kReachAt = 2, kReach = 0.03;                                      // [s, m]
constexpr std::size_t kReaches = 7;
constexpr double kPressedAt = 6, kPressRest = 7, kHoldFrom = 9, kHoldTo = 12;  // [s]
constexpr double kRecordingMax = 20, kRecordingSettle = 3;                     // [s]
constexpr double kAfterRest = 3, kJudged = 3;                                  // [s]

double rise(double t) { return hal::sim::min_jerk(t).value; }

hal::Vec3 circle(double t) {
  const double r = kCircleRadius * (rise(t) - rise(t - kCircleEnd));
  return {r * std::cos(kTurn * kCircleHz * t), 0, r * std::sin(kTurn * kCircleHz * t)};
}

hal::Vec3 step(double t) { return {kStepAway * rise((t - kStepAt) / kStepFor), 0, 0}; }

hal::Vec3 lead(double t) {
  const double away = kLeadAway * rise((t - kLeadAt) / kLeadFor),
               r = kSlowRadius * (rise(t - kSlowAt) - rise(t - kSlowEnd)), turn = kTurn * kSlowHz * (t - kSlowAt);
  return {away + r * std::cos(turn), 0, r * std::sin(turn) - away};
}

/// Returns a motion between drawn points within a cube of 2 kReach, one second each; it ends where it began.
IntendedPath reaches(std::uint64_t seed) {
  const RandomKey key = RandomKey{seed}.derive(0x67657374U);
  std::array<hal::Vec3, kReaches + 1> points{};
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      points[i][static_cast<Eigen::Index>(axis)] = key.uniform(3 * i + axis, -kReach, kReach);
  points.back() = hal::Vec3::Zero();
  return [points](double t) {
    hal::Vec3 at = hal::Vec3::Zero(), before = hal::Vec3::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      at += rise(t - kReachAt - static_cast<double>(i)) * (points[i] - before);
      before = points[i];
    }
    return at;
  };
}

bool contact_of(CellTask task) { return task == CellTask::kWall || task == CellTask::kTissue; }

IntendedPath path_of(const Cell& cell, const FeelSetup& setup, std::uint64_t seed) {
  switch (cell.task) {
    case CellTask::kWall:
    case CellTask::kTissue:
      return press_path(press_depth(setup), kPressedAt);
    case CellTask::kFollowerRelaxed:
    case CellTask::kFollowerTight:
      return lead;
    case CellTask::kStep:
      return step;
    case CellTask::kGesture:
      return reaches(seed);
    default:
      return circle;
  }
}

/// Returns the path with the tremor and noise of a hand, which end before the rest.
std::shared_ptr<const hal::sim::RecordedMotion> unsteady(const DrawnHand& hand, const IntendedPath& path,
                                                         const TaskTimes& times) {
  const DrawnHand steady{HandKind::kPlain, 1, 0};  // adds no noise of its own
  return steady.move(
      [&](double t) -> hal::Vec3 {
        return path(t) + rise(t) * (1 - rise(t - (times.rest - 1))) * hand.unsteadiness(t);
      },
      times.end);
}

}  // namespace

TaskTimes task_times(CellTask task, const hal::sim::RecordedMotion* recording) {
  TaskTimes times;
  if (contact_of(task)) {
    times.from = kHoldFrom;
    times.to = times.authority_changes = kHoldTo;
    times.rest = kPressRest;
    times.contact = true;
  } else if (task == CellTask::kStep) {
    times.from = kStepAt;
    times.to = 7.5;
  } else if (task == CellTask::kRecorded && recording != nullptr) {
    times.to = times.rest = std::min(kRecordingMax, recording->duration());
    times.from = std::min(kRecordingSettle, 0.5 * times.to);
    times.authority_changes = 0.5 * (times.from + times.to);
    times.cycle = times.rest + kAfterRest;
    times.end = times.cycle + kJudged;
  }
  return times;
}

FeelSetup setup_of(const Cell& cell, const CellInput& input) {
  FeelSetup setup{.scene = input.scene};
  choose_law(setup.scene, cell.law);
  setup.scene.channel.coupling = cell.coupling;
  SimpleNetwork network{.delay = from_milliseconds(cell.delay_ms),
                        .jitter = from_milliseconds(cell.jitter_ms),
                        .loss = cell.loss_percent / 100};
  if (cell.outage_ms > 0)
    network.outages.push_back({.start = from_seconds(kOutageFrom),
                               .length = from_milliseconds(cell.outage_ms),
                               .period = from_seconds(kOutagePeriod)});
  setup.network = link_from(network);
  return setup;
}

ProbeRun run_of(const Cell& cell, const CellInput& input, const FeelSetup& setup, std::uint64_t seed) {
  const TaskTimes times = task_times(cell.task, input.recording.get());
  const IntendedPath path = path_of(cell, setup, seed);
  const DrawnHand leader{setup.hands, seed, 0};
  ProbeRun run{.length = times.end,
               .share = cell.alpha == CellAlpha::kHalf   ? 0.5
                        : cell.alpha == CellAlpha::kZero ? 0
                                                         : 1.0};
  run.hands.push_back(
      {firm(leader), cell.task == CellTask::kRecorded ? input.recording : unsteady(leader, path, times)});
  for (std::size_t i = 1; i < cell.hands; ++i) {
    const DrawnHand other{setup.hands, seed, i};
    if (cell.task == CellTask::kFollowerTight) {
      run.hands.push_back({firm(other), unsteady(other, path, times)});
    } else {
      run.hands.push_back({relaxed(other)});
    }
  }
  if (times.contact) {
    run.start_x = -kPressFront;
    run.environment = wall_of(cell.task == CellTask::kWall ? kBone : kTissue);
  }
  if (cell.alpha == CellAlpha::kStepped) run.hand_over_at = times.authority_changes;
  return run;
}

}  // namespace tandem::netsim
