#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "common/auth/ticket.h"
#include "common/base/secret.h"
#include "common/base/time.h"

namespace tandem::server {

/// Redeemed tickets of a session's consoles, each until the console's connection ends. The resume secret of its Welcome
/// identifies a console, because consoles have no seat and no datagrams.
///
/// A ticket *returns* if its console was joined at a former owner of the session, in a service, and has not come back
/// yet: it is valid once more, for the workstation to which it was issued and with its role, as a resume secret is for
/// a seat. Times are those of one monotonic clock.
class ConsoleTickets {
 public:
  ConsoleTickets() = default;
  /// @param returning  tickets of the consoles at the former owner  @param until  end of their right to come back
  ConsoleTickets(std::vector<auth::Id16> returning, Time until) : returning_(std::move(returning)), until_(until) {}

  /// No console is joined.
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }
  [[nodiscard]] bool returns(const auth::Id16& ticket, Time now) const noexcept {
    return now < until_ && std::ranges::find(returning_, ticket) != returning_.end();
  }
  /// Adds a console whose ticket was redeemed. The ticket does not return any more.
  void add(const Secret<32>& console, const auth::Id16& ticket) {
    rows_.push_back({console, ticket, std::erase(returning_, ticket) > 0});
  }
  /// The console has got its Welcome.
  void join(const Secret<32>& console) {
    for (Row& row : rows_)
      if (row.console == console) row.joined = true;
  }
  [[nodiscard]] bool contains(const Secret<32>& console) const noexcept { return find(console) != nullptr; }
  /// Whether the console came by a ticket that returned.
  [[nodiscard]] bool returned(const Secret<32>& console) const noexcept {
    const Row* const row = find(console);
    return row != nullptr && row->returned;
  }
  /// Removes a console. The ticket of one that has got no Welcome returns again, if it did before.
  /// @return its ticket; nullopt if there is no such console
  std::optional<auth::Id16> take(const Secret<32>& console) {
    const Row* const row = find(console);
    if (row == nullptr) return std::nullopt;
    const auth::Id16 ticket = row->ticket;
    if (row->returned && !row->joined) returning_.push_back(ticket);
    rows_.erase(rows_.begin() + (row - rows_.data()));
    return ticket;
  }
  /// Removes all consoles, for another owner of the session. Their tickets return there. @return these tickets
  std::vector<auth::Id16> release_all() {
    std::vector<auth::Id16> released;
    for (const Row& row : std::exchange(rows_, {})) released.push_back(row.ticket);
    returning_.insert(returning_.end(), released.begin(), released.end());
    return released;
  }
  /// Tickets that return at the next owner if this one dies: those of joined consoles, then those that return here.
  [[nodiscard]] std::vector<auth::Id16> returning_next() const {
    std::vector<auth::Id16> tickets;
    for (const Row& row : rows_)
      if (row.joined || row.returned) tickets.push_back(row.ticket);
    tickets.insert(tickets.end(), returning_.begin(), returning_.end());
    return tickets;
  }

 private:
  struct Row {
    Secret<32> console;
    auth::Id16 ticket{};
    bool returned = false;  ///< the ticket returned
    bool joined = false;    ///< the Welcome was sent
  };
  [[nodiscard]] const Row* find(const Secret<32>& console) const noexcept {
    const auto row = std::ranges::find(rows_, console, &Row::console);
    return row == rows_.end() ? nullptr : &*row;
  }

  std::vector<Row> rows_;
  std::vector<auth::Id16> returning_;
  Time until_{};
};

}  // namespace tandem::server
