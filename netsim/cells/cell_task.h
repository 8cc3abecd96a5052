#pragma once

#include <memory>

#include "netsim/cells/cell.h"
#include "netsim/feel/probe_scene.h"

/// Tasks of cells as runs of the feel probes. In every task the hands move, then intend to hold still without tremor.
namespace tandem::netsim {

/// Outages come in every kOutagePeriod, from kOutageFrom on of the network's time [s].
inline constexpr double kOutagePeriod = 3, kOutageFrom = 5;

/// Parts of a run, in session time [s].
struct TaskTimes {
  double from = 3, to = 9;       ///< motion, or a constant press, that is measured
  double rest = 10;              ///< from here on no hand intends to move
  double cycle = 13;             ///< oscillation is judged in [cycle, end), drift in the last second
  double end = 16;               ///< of the session
  double authority_changes = 6;  ///< CellAlpha::kStepped
  bool contact = false;          ///< whether the tool touches a wall
};

/// Input that all cells of a file share.
struct CellInput {
  SceneSpec scene;                                                 ///< scene of the file
  std::shared_ptr<const hal::sim::RecordedMotion> recording = {};  ///< CellTask::kRecorded
};

/// Returns the times of a task. @param recording  of CellTask::kRecorded
[[nodiscard]] TaskTimes task_times(CellTask task, const hal::sim::RecordedMotion* recording);

/// Returns the channel, devices and network of a cell.
[[nodiscard]] FeelSetup setup_of(const Cell& cell, const CellInput& input);

/// Returns the run of a cell with the hands of one seed.
/// @pre a cell with CellTask::kRecorded has a recording
[[nodiscard]] ProbeRun run_of(const Cell& cell, const CellInput& input, const FeelSetup& setup, std::uint64_t seed);

}  // namespace tandem::netsim
