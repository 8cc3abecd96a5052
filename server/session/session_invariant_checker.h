#pragma once

#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::server {

/// Checks the server's own invariants once per tick (ARCHITECTURE.md): the authority over a tool sums to 1, or to 0
/// while the tool is braked. Every ledger holds, received energies never fall, and all values are finite.
class SessionInvariantChecker {
 public:
  void check(const Session& session, Violations& out);
};

/// Name of the mode, as in options and reports.
[[nodiscard]] std::string_view mfs_name(MfsMode mode) noexcept;

}  // namespace tandem::server
