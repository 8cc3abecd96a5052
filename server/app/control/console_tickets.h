#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "common/auth/ticket.h"
#include "common/base/secret.h"

namespace tandem::server {

/// Redeemed tickets of a session's consoles, each until the console's connection ends. The resume secret of its Welcome
/// identifies a console, because consoles have no seat and no datagrams.
class ConsoleTickets {
 public:
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }
  void add(const Secret<32>& console, const auth::Id16& ticket) { rows_.emplace_back(console, ticket); }
  [[nodiscard]] bool contains(const Secret<32>& console) const noexcept {
    return std::ranges::find(rows_, console, &Row::first) != rows_.end();
  }
  /// Removes all consoles. @return their tickets
  std::vector<auth::Id16> take_all() {
    std::vector<auth::Id16> tickets;
    for (const Row& row : std::exchange(rows_, {})) tickets.push_back(row.second);
    return tickets;
  }
  /// Removes a console. @return its ticket; nullopt if there is no such console
  std::optional<auth::Id16> take(const Secret<32>& console) {
    const auto row = std::ranges::find(rows_, console, &Row::first);
    if (row == rows_.end()) return std::nullopt;
    const auth::Id16 ticket = row->second;
    rows_.erase(row);
    return ticket;
  }

 private:
  using Row = std::pair<Secret<32>, auth::Id16>;
  std::vector<Row> rows_;
};

}  // namespace tandem::server
