#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/app/test_run.h"

/// One scene over a grid of networks: where does it stop to be good?
namespace tandem::netsim {

struct SweepSpec {
  SceneSpec scene;
  std::string scene_name;  ///< as typed, for commands
  std::vector<double> delays_ms{0}, jitters_ms{0}, losses_percent{0};
  std::string metric = "tracking_rms_m";  ///< of every MASTER seat, or of every tool
  std::string options;                    ///< what else `run` needs to repeat a point, such as `--duration 5`
};

struct SweepPoint {
  double delay_ms = 0, jitter_ms = 0, loss_percent = 0;
  double worst = 0, median = 0;  ///< over seeds, of the worst seat or tool; NaN: no such number
  std::uint64_t worst_seed = 0;
  bool broken = false;   ///< a promised invariant, in any seed
  bool trouble = false;  ///< a seed could not begin or crashed
  bool complete = true;  ///< every seed was run
};

struct Sweep {
  SweepSpec spec;
  Limit::Of of = Limit::Of::kSeat;
  TestResult runs;                 ///< one scenario per point
  std::vector<SweepPoint> points;  ///< jitter outermost, then delay, then loss

  /// Every point was run whole and broke no invariant.
  [[nodiscard]] bool good() const noexcept;
};

/// Most values of one axis, and points of a grid.
inline constexpr std::size_t kSweepAxisMax = 64, kSweepPointsMax = 10'000;

/// Reads `0,20,50.5`. Error: what is wrong and what is allowed.
[[nodiscard]] std::expected<std::vector<double>, std::string> parse_axis(std::string_view text, double lo, double hi,
                                                                         std::string_view unit);

/// Whether a metric can be swept. Error: the nearest that can.
[[nodiscard]] std::expected<Limit::Of, std::string> sweep_metric(std::string_view metric);

/// Runs all seeds of all points side by side.
/// @param spec  its metric is one of sweep_metric
[[nodiscard]] Sweep run_sweep(SweepSpec spec, const TestOptions& options);

/// A map for people: one table per jitter, rows are delays, columns are losses.
[[nodiscard]] std::string sweep_map(const Sweep& sweep);
/// `delay[ms],jitter[ms],loss[%],worst[UNIT],median[UNIT],worst_seed[1],broken[1],trouble[1]`; an empty cell where there is no number.
[[nodiscard]] std::string sweep_csv(const Sweep& sweep);
/// {"version": 1, "scene", "metric", "unit", "good", "points": [{"delay_ms", "jitter_ms", "loss_percent", "worst"|null,
///  "median"|null, "worst_seed"|null, "broken", "trouble", "seeds": [{"seed", "value"|null, "broken": [text], "trouble",
///  "trace_hash", "replay"}]}]}; the same bytes for equal seeds and build.
[[nodiscard]] std::string sweep_json(const Sweep& sweep);

}  // namespace tandem::netsim
