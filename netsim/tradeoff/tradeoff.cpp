#include "netsim/tradeoff/tradeoff.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/base/format.h"
#include "netsim/tradeoff/reference.h"
#include "netsim/tradeoff/stable_stiffness.h"

namespace tandem::netsim::tradeoff {
namespace {

double square(const std::array<double, 3>& a, const std::array<double, 3>& b) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

bool is_proven(const Row& row) noexcept { return row.stable && row.numerics.keeps_proof(); }

/// Keeps the rows whose number is at most kAdviceMargin above the least.
template <class Number>
void keep_least(std::vector<const Row*>& rows, Number&& number) {
  double least = std::numeric_limits<double>::infinity();
  for (const Row* row : rows) least = std::min(least, number(*row));
  std::erase_if(rows, [&](const Row* row) { return number(*row) > (1 + kAdviceMargin) * least; });
}

/// Returns the allowed row with the least `first`, then the least `second`, by the rule of `advice_for`.
template <class Allowed, class First, class Second>
std::optional<Row> best(const std::vector<Row>& rows, Allowed&& allowed, First&& first, Second&& second) {
  std::vector<const Row*> left;
  for (const Row& row : rows)
    if (allowed(row)) left.push_back(&row);
  keep_least(left, first);
  keep_least(left, second);
  const auto rank = [](const Row* row) {
    return std::tuple(row->numerics.precision != control::Precision::kDouble, !row->numerics.keeps_proof(),
                      row->work_per_s());
  };
  const auto it = std::ranges::min_element(left, {}, rank);
  return it == left.end() ? std::nullopt : std::optional(**it);
}

}  // namespace

Row measure(const ToolTask& task, double tick_hz, const control::Numerics& numerics,
            const std::vector<ToolSample>& truth, const std::vector<ToolSample>& held) {
  Row row{.tick_hz = tick_hz, .numerics = numerics, .cost = {}};
  SteppedTool tool(task, tick_hz, numerics);
  double path = 0, integrator = 0, force = 0, energy = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const bool finite = tool.step();
    const ToolSample now = tool.sample();
    const double away = square(now.x, truth[k].x);
    if (!finite || !(away < kLost * kLost)) {
      row.stable = false;
      break;
    }
    path += away;
    integrator += square(now.x, held[k].x);
    force += square(now.force, truth[k].force);
    energy += (now.energy - truth[k].energy) * (now.energy - truth[k].energy);
  }
  const double n = std::max(1.0, static_cast<double>(truth.size()));
  row.path_rms_m = std::sqrt(path / n);
  row.integrator_rms_m = std::sqrt(integrator / n);
  row.force_rms_n = std::sqrt(force / n);
  row.energy_rms_j = std::sqrt(energy / n);
  row.stiffness_max_n_m = stable_stiffness(task, tick_hz, numerics);
  return row;
}

void mark_pareto(std::vector<Row>& rows) {
  for (Row& row : rows) {
    row.pareto = row.stable && std::ranges::none_of(rows, [&](const Row& other) {
                   if (!other.stable) return false;
                   const bool no_worse = other.force_rms_n <= row.force_rms_n && other.work_per_s() <= row.work_per_s();
                   return no_worse && (other.force_rms_n < row.force_rms_n || other.work_per_s() < row.work_per_s());
                 });
  }
}

Tradeoff run_tradeoff(const SceneSpec& scene, const Grid& grid,
                      const std::function<Cost(const control::Numerics&)>& cost_of,
                      const std::function<bool(std::size_t, std::size_t)>& go_on) {
  Tradeoff out;
  out.scene = scene.name;
  out.task = tool_task(scene);
  out.scene_tick_hz = scene.tick_hz;
  if (!scene.tools[0].is_virtual) return out;
  const std::size_t count =
      grid.ticks_hz.size() * grid.substeps.size() * control::kIntegrators * control::kPrecisionNames.size();
  for (const double tick_hz : grid.ticks_hz) {
    if (out.interrupted) break;
    const std::vector<ToolSample> truth = reference(out.task, tick_hz, HandInput::kContinuous);
    const std::vector<ToolSample> held = reference(out.task, tick_hz, HandInput::kHeld);
    double force2 = 0;
    for (const ToolSample& sample : truth) force2 += square(sample.force, {});
    out.force_rms_n = std::sqrt(force2 / std::max(1.0, static_cast<double>(truth.size())));
    for (std::size_t i = 0; i < control::kIntegrators * control::kPrecisionNames.size() * grid.substeps.size(); ++i) {
      if (!go_on(out.rows.size(), count)) {
        out.interrupted = true;
        break;
      }
      const std::size_t each = grid.substeps.size() * control::kPrecisionNames.size();
      const control::Numerics numerics{static_cast<control::Integrator>(i / each),
                                       static_cast<control::Precision>(i / grid.substeps.size() % 2),
                                       grid.substeps[i % grid.substeps.size()]};
      out.rows.push_back(measure(out.task, tick_hz, numerics, truth, held));
      out.rows.back().cost = cost_of(numerics);
    }
  }
  mark_pareto(out.rows);
  out.advice = advice_for(out);
  return out;
}

std::vector<Advice> advice_for(const Tradeoff& tradeoff) {
  const auto fast = [&](const Row& row) { return row.tick_hz >= tradeoff.scene_tick_hz; };
  const auto work = [](const Row& row) { return row.work_per_s(); };
  const auto error = [](const Row& row) { return row.force_rms_n; };
  const auto same = [](const Row&) { return 0.0; };
  const double accepted = std::max(kLessonError * tradeoff.force_rms_n, kLessonForce);
  const double budget = 0.5 * kCoreInstructions / kSeatsOfACore;
  const auto for_lesson = [&](const Row& r) { return is_proven(r) && fast(r) && r.force_rms_n <= accepted; };
  const auto within_budget = [&](const Row& r) {
    return is_proven(r) && fast(r) && r.cost.seat_instructions && r.work_per_s() <= budget;
  };
  const auto stable = [](const Row& r) { return r.stable; };
  std::vector<Advice> out;
  out.push_back({"a lesson on one desk",
                 format("least work with the proof of passivity, the scene's tick or faster, and a force error of at "
                        "most %.3g N: %.0f %% of the force, at least %g N",
                        accepted, 100 * kLessonError, kLessonForce),
                 best(tradeoff.rows, for_lesson, work, error)});
  out.push_back({"32 seats on one core",
                 format("least force error with the proof of passivity, the scene's tick or faster, and at most %.3g "
                        "instructions/s per seat: half of a core of %.2g/s",
                        budget, kCoreInstructions),
                 best(tradeoff.rows, within_budget, error, work)});
  out.push_back(
      {"a paper's figure",
       format("least force error of all stable rows within %.0f %%, at any work; among these in double, with the "
              "proof of passivity, and then the least work",
              100 * kAdviceMargin),
       best(tradeoff.rows, stable, error, same)});
  return out;
}

}  // namespace tandem::netsim::tradeoff
