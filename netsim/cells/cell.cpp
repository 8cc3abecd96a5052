#include "netsim/cells/cell.h"

#include <algorithm>

#include "common/base/format.h"
#include "common/setup/channel_factory.h"
#include "netsim/cells/cell_task.h"
#include "netsim/feel/probe_scene.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {
namespace {

/// Calls `use` for every value of an axis, with the member set to it.
template <class Value, class Member, class Use>
void over(const CellAxis<Value>& axis, Cell& cell, Member Cell::* member, const Use& use) {
  for (const auto& [value, place] : axis) {
    cell.*member = value;
    use();
  }
}

}  // namespace

std::vector<Cell> cells_of(const CellsSpec& spec) {
  std::vector<Cell> cells;
  cells.reserve(spec.cells());
  for (std::size_t g = 0; g < spec.grids.size(); ++g) {
    const CellGridSpec& grid = spec.grids[g];
    Cell cell;
    cell.grid = g;
    const auto add = [&] {
      cell.number = cells.size() + 1;
      cells.push_back(cell);
    };
    const auto delays = [&] { over(grid.delays_ms, cell, &Cell::delay_ms, add); };
    const auto losses = [&] { over(grid.losses_percent, cell, &Cell::loss_percent, delays); };
    const auto jitters = [&] { over(grid.jitters_ms, cell, &Cell::jitter_ms, losses); };
    const auto outages = [&] { over(grid.outages_ms, cell, &Cell::outage_ms, jitters); };
    const auto hands = [&] { over(grid.hands, cell, &Cell::hands, outages); };
    const auto alphas = [&] { over(grid.alphas, cell, &Cell::alpha, hands); };
    const auto tasks = [&] { over(grid.tasks, cell, &Cell::task, alphas); };
    const auto couplings = [&] { over(grid.couplings, cell, &Cell::coupling, tasks); };
    over(grid.laws, cell, &Cell::law, couplings);
  }
  return cells;
}

SceneSpec scene_of(const Cell& cell, const SceneSpec& base) {
  SceneSpec scene = base;
  choose_law(scene, cell.law);
  scene.channel.coupling = cell.coupling;
  ProbeRun run;
  run.hands.resize(cell.hands);
  return simulation_config_of({.scene = std::move(scene)}, run, 1).scene;
}

InputErrors cell_problems(const CellsSpec& spec, const SceneSpec& base) {
  InputErrors errors;
  for (const CellGridSpec& grid : spec.grids)
    for (const auto& law : grid.laws)
      for (const auto& coupling : grid.couplings)
        for (const auto& hands : grid.hands) {
          Cell cell;
          cell.law = law.value;
          cell.coupling = coupling.value;
          cell.hands = hands.value;
          const auto problem = law_problem(scene_of(cell, base));
          if (!problem) continue;
          const bool of_coupling = coupling.value != HandCouplingKind::kEsc;
          InputError error = of_coupling ? coupling.place : law.place;
          error.message = "grid \"" + grid.name + "\", " + law_text(cell) +
                          format(" with %u hands: ", static_cast<unsigned>(hands.value)) + problem->key + " " +
                          problem->words + ". Put what fits together into a grid of its own";
          errors.push_back(std::move(error));
        }
  return errors;
}

std::string_view law_name_of(const Cell& cell) noexcept { return setup::law_name(cell.law); }

std::string_view coupling_name_of(const Cell& cell) noexcept {
  return control::row_of(setup::hand_coupling(cell.coupling)).name;
}

std::string law_text(const Cell& cell) {
  std::string text{law_name_of(cell)};
  if (cell.coupling != HandCouplingKind::kEsc) text += " + " + std::string(coupling_name_of(cell));
  return text;
}

std::string condition_text(const Cell& cell) {
  std::string text{to_text(cell.task)};
  std::ranges::replace(text, '_', ' ');
  if (cell.alpha != CellAlpha::kOne) text += ", alpha " + std::string(to_text(cell.alpha));
  if (cell.hands != 2) text += format(", %u hands", static_cast<unsigned>(cell.hands));
  if (cell.jitter_ms > 0) text += format(", jitter %.9g ms", cell.jitter_ms);
  if (cell.loss_percent > 0) text += format(", loss %.9g %%", cell.loss_percent);
  if (cell.outage_ms > 0) text += format(", outages of %.9g ms", cell.outage_ms);
  return text;
}

bool same_condition(const Cell& a, const Cell& b) noexcept {
  return a.hands == b.hands && a.delay_ms == b.delay_ms && a.jitter_ms == b.jitter_ms &&
         a.loss_percent == b.loss_percent && a.outage_ms == b.outage_ms && a.task == b.task && a.alpha == b.alpha;
}

bool has_default_law(const Cell& cell) noexcept {
  return cell.law == ChannelSpec{}.law && cell.coupling == ChannelSpec{}.coupling;
}

std::string repeat_command(const std::string& cells_file, std::size_t number) {
  return "tandem-netsim sweep --cells " + cells_file + " --cell " + std::to_string(number);
}

}  // namespace tandem::netsim
