#include "netsim/tradeoff/model_rows.h"

#include <algorithm>
#include <cmath>

#include "common/setup/channel_factory.h"
#include "netsim/tradeoff/reference.h"

namespace tandem::netsim::tradeoff {
namespace {

constexpr double kTierFriction = 0.3;  ///< of the tier with friction if the scene's surfaces have none [1]

double distance2(const std::array<double, 3>& a, const std::array<double, 3>& b) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

std::vector<ToolSample> truth_of(const ModelChoice& choice) {
  if (const auto* tool = std::get_if<ToolTask>(&choice.task))
    return reference(*tool, choice.tick_hz, HandInput::kContinuous);
  return device_reference(std::get<DeviceTask>(choice.task), choice.tick_hz);
}

/// The surfaces of one contact tier; nothing if the scene has none of that kind.
std::optional<EnvironmentSpec> surfaces_of(const EnvironmentSpec& scene, ContactTier tier) {
  EnvironmentSpec out;
  if (tier == ContactTier::kNone) return out;
  if (tier != ContactTier::kTissue) out.wall = scene.wall;
  if (tier == ContactTier::kTissue || (tier == ContactTier::kFriction && !out.wall)) out.tissue = scene.tissue;
  if (!out.wall && !out.tissue) return std::nullopt;
  const auto rough = [&](auto& surface) {
    if (!surface) return;
    surface->mu = tier != ContactTier::kFriction ? 0 : surface->mu > 0 ? surface->mu : kTierFriction;
  };
  rough(out.wall);
  rough(out.tissue);
  return out;
}

ContactTier contact_of(const EnvironmentSpec& surfaces) noexcept {
  return surfaces.wall ? ContactTier::kPlane : surfaces.tissue ? ContactTier::kTissue : ContactTier::kNone;
}

SimDeviceSpec device_of(SimDeviceSpec device, ModelTier model) noexcept {
  device.model = model == ModelTier::kPoint ? DeviceModel::kLinear : DeviceModel::kTouch;
  if (model == ModelTier::kArm) {
    device.gravity = false;
    device.friction = 0;
  } else if (model == ModelTier::kFullArm) {
    device.gravity = true;
    if (!(device.friction > 0)) device.friction = SimDeviceSpec{}.friction;
  }
  return device;
}

/// Whether no reference solves the friction of these surfaces.
bool is_rough(const ModelChoice& choice) noexcept { return choice.contact == ContactTier::kFriction; }

void measure(ModelRow& row, const std::vector<ToolSample>& truth) {
  ModelRun run(row.choice);
  double path = 0, force = 0, energy = 0;
  for (const ToolSample& sample : truth) {
    run.prepare();
    run.advance();
    const ToolSample now = run.sample();
    const double away = distance2(now.x, sample.x);
    if (!(away < kLost * kLost)) {
      row.stable = false;
      return;
    }
    path += away;
    force += distance2(now.force, sample.force);
    energy += (now.energy - sample.energy) * (now.energy - sample.energy);
  }
  const double n = std::max(1.0, static_cast<double>(truth.size()));
  row.path_rms_m = std::sqrt(path / n);
  row.force_rms_n = std::sqrt(force / n);
  row.energy_rms_j = std::sqrt(energy / n);
}

}  // namespace

std::vector<ModelChoice> tier_choices(const SceneSpec& scene) {
  const DeviceTask own = device_task(scene);
  const std::vector<ModelTier> models =
      scene.dof == 1 ? std::vector{ModelTier::kPoint, ModelTier::kVirtualTool}
                     : std::vector{ModelTier::kVirtualTool, ModelTier::kArm, ModelTier::kFullArm};
  std::vector<ModelChoice> out;
  for (const ContactTier contact :
       {ContactTier::kNone, ContactTier::kPlane, ContactTier::kTissue, ContactTier::kFriction}) {
    const auto surfaces = surfaces_of(scene.tools[0].environment, contact);
    if (!surfaces) continue;
    ToolTask tool = tool_task(scene);
    tool.contacts = setup::contacts(*surfaces);
    for (const ModelTier model : models) {
      if (model == ModelTier::kVirtualTool) {
        out.push_back({model, contact, scene.tick_hz, {}, tool});
      } else if (contact != ContactTier::kFriction) {
        const DeviceTask task{tool, device_of(own.device, model), *surfaces, tool.k_c, tool.b_rel};
        out.push_back({model, contact, scene.tick_hz, {}, task});
      }
    }
  }
  return out;
}

std::vector<ModelChoice> device_choices(const SceneSpec& scene, const std::vector<double>& ticks_hz,
                                        const std::vector<std::uint8_t>& substeps) {
  const DeviceTask task = device_task(scene);
  const ContactTier contact = contact_of(task.environment);
  std::vector<ModelChoice> out;
  for (const double tick_hz : ticks_hz) {
    out.push_back({tier_of(task.device), contact, tick_hz, {}, task});
    for (std::size_t i = 0; i < control::kIntegrators; ++i) {
      const auto how = static_cast<IntegratorKind>(i);
      if (task.device.friction > 0 && (how == IntegratorKind::kSemiImplicitEuler || how == IntegratorKind::kRk4))
        continue;
      for (const PrecisionKind precision : {PrecisionKind::kDouble, PrecisionKind::kFloat})
        for (const std::uint8_t n : substeps)
          out.push_back({tier_of(task.device), contact, tick_hz, NumericsSpec{how, precision, n}, task});
    }
  }
  return out;
}

ModelRun::ModelRun(const ModelChoice& choice, double from)
    : run_(std::holds_alternative<ToolTask>(choice.task)
               ? decltype(run_)(SteppedTool(std::get<ToolTask>(choice.task), choice.tick_hz, {}, from))
               : decltype(run_)(DeviceRun(std::get<DeviceTask>(choice.task), choice.tick_hz, choice.numerics, from))) {}

std::vector<ModelRow> measure_models(const std::vector<ModelChoice>& choices, const std::vector<ModelCost>& costs,
                                     const std::function<bool(std::size_t)>& go_on) {
  std::vector<ModelRow> rows;
  std::vector<ToolSample> truth;
  for (std::size_t i = 0; i < choices.size() && go_on(i); ++i) {
    ModelRow& row = rows.emplace_back();
    row.choice = choices[i];
    if (i < costs.size()) row.cost = costs[i];
    if (is_rough(row.choice)) continue;
    const bool same = i > 0 && choices[i].numerics && choices[i - 1].tick_hz == choices[i].tick_hz;
    if (!same) truth = truth_of(row.choice);
    measure(row, truth);
  }
  return rows;
}

void compare_tiers(std::vector<ModelRow>& tiers) {
  for (ModelRow& row : tiers) {
    if (is_rough(row.choice)) continue;
    const auto fullest = std::ranges::max_element(tiers, {}, [&](const ModelRow& other) {
      return other.choice.contact == row.choice.contact ? static_cast<int>(other.choice.model) : -1;
    });
    if (fullest->choice.model == row.choice.model) continue;
    const std::vector<ToolSample> own = truth_of(row.choice), full = truth_of(fullest->choice);
    double path = 0, force = 0;
    for (std::size_t k = 0; k < own.size(); ++k) {
      path += distance2(own[k].x, full[k].x);
      force += distance2(own[k].force, full[k].force);
    }
    row.apart_path_m = std::sqrt(path / static_cast<double>(own.size()));
    row.apart_force_n = std::sqrt(force / static_cast<double>(own.size()));
  }
}

void mark_pareto(std::vector<ModelRow>& rows) {
  const auto measured = [](const ModelRow& row) { return row.stable && row.force_rms_n.has_value(); };
  for (ModelRow& row : rows) {
    row.pareto = measured(row) && std::ranges::none_of(rows, [&](const ModelRow& other) {
                   if (!measured(other)) return false;
                   const bool no_worse =
                       *other.force_rms_n <= *row.force_rms_n && other.work_per_s() <= row.work_per_s();
                   return no_worse && (*other.force_rms_n < *row.force_rms_n || other.work_per_s() < row.work_per_s());
                 });
  }
}

}  // namespace tandem::netsim::tradeoff
