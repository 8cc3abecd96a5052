#pragma once

#include <algorithm>
#include <variant>

#include "server/directory/directory.h"

namespace tandem::directory {

/// Whether a server needs this request to keep its lease: grants, renewals, and reads. By reads it confirms renewals,
/// and knows that its sessions are still its own.
[[nodiscard]] inline bool keeps_lease(const Request& request) {
  const auto* const transaction = std::get_if<Transaction>(&request);
  if (transaction == nullptr) return std::holds_alternative<Grant>(request) || std::holds_alternative<Renew>(request);
  const auto reads = [](const Step& step) { return std::holds_alternative<Read>(step); };
  return transaction->conditions.empty() && std::ranges::all_of(transaction->then, reads);
}

}  // namespace tandem::directory
