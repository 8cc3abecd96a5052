#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/app/test_run.h"

/// Runs one scene over a grid of networks, to find the networks on which it fails.
namespace tandem::netsim {

struct SweepSpec {
  SceneSpec scene;
  std::string scene_name;  ///< as typed, for commands
  std::vector<double> delays_ms{0}, jitters_ms{0}, losses_percent{0};
  std::string metric = "tracking_rms_m";  ///< metric of every MASTER seat, or of every tool
  std::string options;                    ///< further options of `run` that repeat a point, for example `--duration 5`
};

struct SweepPoint {
  double delay_ms = 0, jitter_ms = 0, loss_percent = 0;
  double worst = 0, median = 0;  ///< over seeds, of the worst seat or tool; NaN: no such number
  std::uint64_t worst_seed = 0;
  bool broken = false;   ///< a required invariant was broken in some seed
  bool trouble = false;  ///< a seed could not begin or crashed
  bool complete = true;  ///< all seeds were run
};

struct Sweep {
  SweepSpec spec;
  Limit::Of of = Limit::Of::kSeat;
  TestResult runs;                 ///< one scenario per point
  std::vector<SweepPoint> points;  ///< nested by jitter (outermost), delay, loss

  /// Returns whether every point is complete and broke no invariant.
  [[nodiscard]] bool good() const noexcept;
  /// Returns the unit of the metric, from its ending.
  [[nodiscard]] std::string unit() const;
  /// Returns the value of the worst seat or tool of one seed; NaN if one of them has no number.
  [[nodiscard]] double value_of(const SeedOutcome& outcome) const;
  /// Returns the command that repeats one seed of a point and writes its trace.
  [[nodiscard]] std::string replay(const SweepPoint& point, std::uint64_t seed) const;
};

/// Maximum number of values of one axis, and of points of a grid.
inline constexpr std::size_t kSweepAxisMax = 64, kSweepPointsMax = 10'000;

/// Reads a list such as `0,20,50.5`. Error: the invalid value and the allowed range.
[[nodiscard]] std::expected<std::vector<double>, std::string> parse_axis(std::string_view text, double lo, double hi,
                                                                         std::string_view unit);

/// Returns what a metric is measured of, if a sweep supports it. Error: the nearest supported metric.
[[nodiscard]] std::expected<Limit::Of, std::string> sweep_metric(std::string_view metric);

/// Runs all seeds of all points in parallel.
/// @param spec  its metric must be accepted by sweep_metric
[[nodiscard]] Sweep run_sweep(SweepSpec spec, const TestOptions& options);

/// Returns a map for terminals: one table per jitter; rows are delays, columns are losses.
[[nodiscard]] std::string sweep_map(const Sweep& sweep);
/// Returns CSV: `delay[ms],jitter[ms],loss[%],worst[UNIT],median[UNIT],worst_seed[1],broken[1],trouble[1]`. A cell
/// without a number is empty.
[[nodiscard]] std::string sweep_csv(const Sweep& sweep);
/// Returns JSON; equal seeds and build give equal bytes:
/// {"version": 1, "scene", "metric", "unit", "good", "points": [{"delay_ms", "jitter_ms", "loss_percent",
///  "worst"|null, "median"|null, "worst_seed"|null, "broken", "trouble", "seeds": [{"seed", "value"|null,
///  "broken": [text], "trouble", "trace_hash", "replay"}]}]}
[[nodiscard]] std::string sweep_json(const Sweep& sweep);

}  // namespace tandem::netsim
