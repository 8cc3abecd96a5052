#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/control/numerics.h"
#include "netsim/tradeoff/tool_task.h"

/// The price of numerics: how far a simulated tool is from the truth, and what its steps cost. No clock; callers
/// measure the costs.
namespace tandem::netsim::tradeoff {

/// Cost of one tick, as measured; empty: not measured.
struct Cost {
  std::optional<double> tool_instructions;  ///< of the tool's step
  std::optional<double> seat_instructions;  ///< of a seat's copy with its ledger, which includes that step
  std::optional<double> tool_ns, seat_ns;   ///< the same as time
};
/// One choice of numerics at one tick rate.
struct Row {
  double tick_hz = 1000;
  control::Numerics numerics;
  bool stable = true;            ///< false: the run left the reference; the errors mean nothing
  double path_rms_m = 0;         ///< position against the truth
  double integrator_rms_m = 0;   ///< position against the reference with held input: of the integrator only
  double force_rms_n = 0;        ///< force on the hand, at the ticks
  double energy_rms_j = 0;       ///< stored energy
  double stiffness_max_n_m = 0;  ///< stable_stiffness.h
  Cost cost;
  bool pareto = false;  ///< no stable row is better in force error and cost at once
  /// Cost per second: instructions of the seat, or else steps of the tool.
  [[nodiscard]] double work_per_s() const noexcept {
    return tick_hz * cost.seat_instructions.value_or(numerics.substeps);
  }
};
/// The choices to try.
struct Grid {
  std::vector<double> ticks_hz{100, 200, 500, 1000, 2000, 5000, 10000};
  std::vector<std::uint8_t> substeps{1, 4, 16};
};
/// A recommended row for a use.
struct Advice {
  std::string use, rule;   ///< and how the row was chosen
  std::optional<Row> row;  ///< empty: no row satisfies the rule
};
struct Tradeoff {
  std::string scene;
  ToolTask task;
  double scene_tick_hz = 1000;
  double force_rms_n = 0;  ///< of the truth
  std::vector<Row> rows;
  std::vector<Advice> advice;
  std::vector<std::string> notes;
  bool interrupted = false;
};

/// Returns the row of one choice, without cost. @param truth, held  references at this tick rate
[[nodiscard]] Row measure(const ToolTask& task, double tick_hz, const control::Numerics& numerics,
                          const std::vector<ToolSample>& truth, const std::vector<ToolSample>& held);

/// Measures all rows of the grid. @param cost_of  cost of a choice  @param go_on  called before each row with the
/// number of rows done and of all rows; false: stop
[[nodiscard]] Tradeoff run_tradeoff(const SceneSpec& scene, const Grid& grid,
                                    const std::function<Cost(const control::Numerics&)>& cost_of,
                                    const std::function<bool(std::size_t, std::size_t)>& go_on);

/// Marks the rows that no other row beats in both force error and work.
void mark_pareto(std::vector<Row>& rows);
/// Returns one advice per use.
[[nodiscard]] std::vector<Advice> advice_for(const Tradeoff& tradeoff);

/// Work of a core [instructions/s] of which the advice for many seats spends half.
inline constexpr double kCoreInstructions = 3e9;
inline constexpr double kSeatsOfACore = 32;
/// Force error that the advice for a lesson accepts: a share of the RMS force, and this much where forces are small
/// [N].
inline constexpr double kLessonError = 0.02, kLessonForce = 0.02;

/// Table for a terminal: the rows of the Pareto front, or all. @param times  with the columns in ns
[[nodiscard]] std::string tradeoff_text(const Tradeoff& tradeoff, bool all, bool times);
/// One line per row, SI units.
[[nodiscard]] std::string tradeoff_csv(const Tradeoff& tradeoff, bool times);
/// Force error over work in decades, one line per integrator and precision, as an SVG file.
[[nodiscard]] std::string tradeoff_svg(const Tradeoff& tradeoff);

}  // namespace tandem::netsim::tradeoff
