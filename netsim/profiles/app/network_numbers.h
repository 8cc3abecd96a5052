#pragma once

#include <optional>
#include <string>

#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Numbers that replace parameters of a network. A missing number leaves its parameter unchanged.
struct NetworkNumbers {
  std::optional<double> delay_ms, jitter_ms;                               ///< [ms]
  std::optional<double> loss_percent, duplicate_percent, reorder_percent;  ///< [%]

  /// Returns whether any number is given.
  [[nodiscard]] bool any() const noexcept {
    return delay_ms || jitter_ms || loss_percent || duplicate_percent || reorder_percent;
  }
  /// Replaces the parameters of one direction.
  void apply(PathSpec& path) const;
  /// Replaces the parameters in both directions of a link.
  void apply(LinkSpec& link) const;
  /// Returns the given numbers as text: `delay 20 ms, jitter 0 to 5 ms`; empty if none is given.
  [[nodiscard]] std::string text() const;
};

/// Returns the first problem of a link as `DIRECTION: KEY: MESSAGE`; empty if there is none.
[[nodiscard]] std::string first_problem(const LinkSpec& link);

}  // namespace tandem::netsim
