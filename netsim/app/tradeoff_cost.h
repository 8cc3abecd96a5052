#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "netsim/tradeoff/tradeoff.h"

namespace tandem::netsim {

/// Measured cost of every integrator, precision and number of substeps, of a tool that presses on the task's surface.
/// The tick rate does not matter.
class CostTable {
 public:
  /// @param times  measure times now; they differ between runs
  CostTable(const tradeoff::ToolTask& task, const std::vector<std::uint8_t>& substeps, bool times);

  /// Counts instructions by running this program under callgrind with --under-callgrind.
  /// @param scene, substeps  as typed  @param stop_fd  readable: stop
  /// @return why they are not counted; empty if they are
  [[nodiscard]] std::string count_instructions(const std::string& scene, const std::string& substeps, int stop_fd);
  [[nodiscard]] bool has_instructions() const noexcept { return counted_; }

  [[nodiscard]] tradeoff::Cost of(const control::Numerics& numerics) const;

 private:
  std::vector<control::Numerics> choices_;
  std::vector<tradeoff::Cost> costs_;
  bool counted_ = false;
};

/// Takes the steps that callgrind counts. @return exit code
int run_cost_worker(const tradeoff::ToolTask& task, const std::vector<std::uint8_t>& substeps);

}  // namespace tandem::netsim
