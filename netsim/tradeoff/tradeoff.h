#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/control/numerics.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/tradeoff/model_rows.h"
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
  double force_rms_n = 0;         ///< of the truth
  std::vector<Row> rows;          ///< numerics of the simulated tool; none if a device moves the first tool
  std::vector<Advice> advice;     ///< for these
  std::vector<ModelRow> tiers;    ///< models of body and surfaces
  std::vector<ModelRow> devices;  ///< numerics of the simulated device
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
/// Returns one advice per use. Rows that differ by less than kAdviceMargin in work or in error count as equal; among
/// equals a row in double, then one with the proof of passivity, then the cheaper one is advised.
[[nodiscard]] std::vector<Advice> advice_for(const Tradeoff& tradeoff);

/// Work of a core [instructions/s] of which the advice for many seats spends half.
inline constexpr double kCoreInstructions = 3e9;
inline constexpr double kSeatsOfACore = 32;
/// Force error that the advice for a lesson accepts: a share of the RMS force, and this much where forces are small
/// [N].
inline constexpr double kLessonError = 0.02, kLessonForce = 0.02;

/// Relative difference below which two rows count as equal. Counts and errors differ by that much between compilers.
inline constexpr double kAdviceMargin = 0.05;

/// Table for a terminal: the rows of the Pareto front, or all. @param times  with the columns in ns
[[nodiscard]] std::string tradeoff_text(const Tradeoff& tradeoff, bool all, bool times);
/// One line per row of the tool, of the tiers and of the device, SI units.
[[nodiscard]] std::string tradeoff_csv(const Tradeoff& tradeoff, bool times);
/// Force error over work in decades, one line per integrator, one panel per precision: of the tool and of the device.
[[nodiscard]] plot::Figure tool_figure(const Tradeoff& tradeoff);
[[nodiscard]] plot::Figure device_figure(const Tradeoff& tradeoff);
/// The first figure that has rows, as an SVG file.
[[nodiscard]] std::string tradeoff_svg(const Tradeoff& tradeoff);
/// All tables and figures as one HTML file: no script, no external resource, light and dark.
/// @param version  of the program
[[nodiscard]] std::string tradeoff_page(const Tradeoff& tradeoff, bool times, const std::string& version);

/// A row in words and numbers, as all tables print it.
struct RowCells {
  std::string tick, integrator, type, substeps;
  std::vector<std::string> costs, numbers;
};
/// @param times  with ns
[[nodiscard]] RowCells cells_of(const Row& row, bool times);
[[nodiscard]] RowCells cells_of(const ModelRow& row, bool times);
[[nodiscard]] std::string model_name(const ModelRow& row);
[[nodiscard]] std::string contact_name(const ModelRow& row);
/// Returns the keys of a scene that choose a row.
[[nodiscard]] std::string words_of(const Row& row);

}  // namespace tandem::netsim::tradeoff
