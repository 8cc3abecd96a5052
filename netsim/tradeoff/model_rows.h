#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "netsim/tradeoff/device_task.h"
#include "netsim/tradeoff/tool_task.h"

/// The price of models: a mass or an arm, with and without weight, friction and surfaces; and of the numerics of the
/// simulated device. No clock; callers measure the costs.
namespace tandem::netsim::tradeoff {

/// One model with one choice of numerics at one tick rate.
struct ModelChoice {
  ModelTier model = ModelTier::kVirtualTool;
  ContactTier contact = ContactTier::kNone;
  double tick_hz = 1000;
  std::optional<NumericsSpec> numerics;     ///< empty: the default of that model
  std::variant<ToolTask, DeviceTask> task;  ///< a virtual tool, or a device
};
/// Measured cost of one tick of a model, without hand and motors; empty: not measured.
struct ModelCost {
  std::optional<double> instructions, ns;
};
/// A choice with its errors and its cost.
struct ModelRow {
  ModelChoice choice;
  bool stable = true;  ///< false: the run left its truth; the errors mean nothing
  /// RMS over the ticks against the truth of the same model; empty: no reference solves friction of surfaces.
  std::optional<double> path_rms_m, force_rms_n, energy_rms_j;
  /// RMS distance between the truths of this model and of the fullest one that the scene allows; tiers only.
  std::optional<double> apart_path_m, apart_force_n;
  ModelCost cost;
  bool pareto = false;  ///< of the choices for the device: no stable row is better in force error and cost at once
  /// Steps of the built-in scheme per tick: at most 0.25 ms each (hal/sim/touch_plant.h).
  [[nodiscard]] double built_in_steps() const noexcept { return std::ceil(1 / (choice.tick_hz * 0.25e-3) - 1e-9); }
  /// Cost per second: instructions, or else steps.
  [[nodiscard]] double work_per_s() const noexcept {
    return choice.tick_hz * cost.instructions.value_or(choice.numerics ? choice.numerics->substeps : built_in_steps());
  }
};

/// Returns all tiers that the scene allows, at its tick rate, with the same hand: a point and a virtual tool on one
/// axis; a virtual tool, an arm, and an arm with friction and gravity in three. Each in free space, and on the scene's
/// plane or tissue; the virtual tool also with friction.
[[nodiscard]] std::vector<ModelChoice> tier_choices(const SceneSpec& scene);
/// Returns the built-in scheme and all numerics of the scene's device. Explicit integrators only without friction.
[[nodiscard]] std::vector<ModelChoice> device_choices(const SceneSpec& scene, const std::vector<double>& ticks_hz,
                                                      const std::vector<std::uint8_t>& substeps);

/// A model in its motion.
class ModelRun {
 public:
  /// @param from  time at which the motion begins [s]
  explicit ModelRun(const ModelChoice& choice, double from = 0);
  void prepare() noexcept {
    std::visit([](auto& run) { run.prepare(); }, run_);
  }
  /// Advances the model by one tick: the part whose cost is measured.
  void advance() noexcept {
    std::visit([](auto& run) { run.advance(); }, run_);
  }
  [[nodiscard]] ToolSample sample() const noexcept {
    return std::visit([](const auto& run) { return run.sample(); }, run_);
  }

 private:
  std::variant<SteppedTool, DeviceRun> run_;
};

/// Measures all choices. Choices of one task and tick rate that follow each other share their reference.
/// @param costs  as many as choices, or none  @param go_on  called before each choice; false: stop
[[nodiscard]] std::vector<ModelRow> measure_models(const std::vector<ModelChoice>& choices,
                                                   const std::vector<ModelCost>& costs,
                                                   const std::function<bool(std::size_t)>& go_on);
/// Sets the distance of each tier from the fullest one with the same contact.
void compare_tiers(std::vector<ModelRow>& tiers);
/// Marks the rows that no other row beats in both force error and work.
void mark_pareto(std::vector<ModelRow>& rows);

}  // namespace tandem::netsim::tradeoff
