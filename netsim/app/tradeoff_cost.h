#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "netsim/tradeoff/tradeoff.h"

namespace tandem::netsim {

/// Everything whose cost is measured. Callgrind's process and the one that starts it derive the same from their
/// arguments.
struct CostSubjects {
  std::optional<tradeoff::ToolTask> tool;     ///< empty: no simulated tool
  std::vector<std::uint8_t> substeps;         ///< of the tool
  std::vector<tradeoff::ModelChoice> models;  ///< tiers, and numerics of the device
};

/// Measured cost of every integrator, precision and number of substeps, of a tool that presses on the task's surface,
/// where the tick rate does not matter; and of every model.
class CostTable {
 public:
  /// @param times  measure times now; they differ between runs
  CostTable(CostSubjects subjects, bool times);

  /// Counts instructions by running this program under callgrind with --under-callgrind.
  /// @param words  of the command line, which choose the same subjects  @param stop_fd  readable: stop
  /// @return why they are not counted; empty if they are
  [[nodiscard]] std::string count_instructions(const std::vector<std::string>& words, int stop_fd);
  [[nodiscard]] bool has_instructions() const noexcept { return counted_; }

  [[nodiscard]] tradeoff::Cost of(const control::Numerics& numerics) const;
  /// In the order of the subjects.
  [[nodiscard]] const std::vector<tradeoff::ModelCost>& models() const noexcept { return model_costs_; }

 private:
  CostSubjects subjects_;
  std::vector<control::Numerics> choices_;
  std::vector<tradeoff::Cost> costs_;
  std::vector<tradeoff::ModelCost> model_costs_;
  bool counted_ = false;
};

/// Takes the steps that callgrind counts. @return exit code
int run_cost_worker(const CostSubjects& subjects);

}  // namespace tandem::netsim
