#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/spec/cells_spec.h"

/// Cells of a comparison: one law, one coupling, one network, one task each.
namespace tandem::netsim {

/// One combination of values of a grid. It is run with all seeds of its file.
struct Cell {
  std::size_t number = 1;  ///< in its file, from 1, in the order of the grids
  std::size_t grid = 0;    ///< index of its grid
  LawKind law = LawKind::kReplica;
  HandCouplingKind coupling = HandCouplingKind::kEsc;
  std::uint32_t hands = 2;
  double delay_ms = 0, jitter_ms = 0, loss_percent = 0;  ///< each direction
  double outage_ms = 0;                                  ///< length of an outage in every kOutagePeriod; 0: none
  CellTask task = CellTask::kFree;
  CellAlpha alpha = CellAlpha::kOne;
};

/// Returns all cells of a file. Innermost is the delay, then loss, jitter, outage, hands, alpha, task, coupling, law,
/// grid.
[[nodiscard]] std::vector<Cell> cells_of(const CellsSpec& spec);

/// Returns the errors of all pairs of law and coupling that make no sense, and of couplings for another number of
/// hands (law_problem of proto/text/scene_text.h), one for each combination of a grid.
/// @param base  scene of the file
[[nodiscard]] InputErrors cell_problems(const CellsSpec& spec, const SceneSpec& base);

/// Returns the scene of a cell: law and coupling replaced, and as many MASTER seats as the cell has hands.
[[nodiscard]] SceneSpec scene_of(const Cell& cell, const SceneSpec& base);

/// Returns the names of law and coupling as users type them: `replica`, `pd + clc`; ESC is left out.
[[nodiscard]] std::string law_text(const Cell& cell);
[[nodiscard]] std::string_view law_name_of(const Cell& cell) noexcept;
[[nodiscard]] std::string_view coupling_name_of(const Cell& cell) noexcept;
/// Returns the task and what differs from a perfect network with two hands: `free, alpha 1/2, loss 5 %`; no delay.
[[nodiscard]] std::string condition_text(const Cell& cell);
/// Returns whether both cells have the same task, hands, authority and network, delay included.
[[nodiscard]] bool same_condition(const Cell& a, const Cell& b) noexcept;
/// Returns whether a cell has the law and the coupling of scenes that name none.
[[nodiscard]] bool has_default_law(const Cell& cell) noexcept;

/// Returns the command that repeats a cell alone.
/// @param cells_file  as typed: the name of a shipped file, or a path
[[nodiscard]] std::string repeat_command(const std::string& cells_file, std::size_t number);

}  // namespace tandem::netsim
