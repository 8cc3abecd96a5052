#pragma once

#include "server/session.h"
#include "server/violations.h"

namespace tandem::server {

/// Checks the server's own invariants once per tick (ARCHITECTURE.md): authority sums to 1 or is all 0, every ledger holds, received
/// energies never fall, everything is finite.
class SessionMonitor {
 public:
  void check(const Session& session, Violations& out);
};

/// Name of the mode as in product.md and reports.
[[nodiscard]] std::string_view mfs_name(MfsMode mode) noexcept;

}  // namespace tandem::server
