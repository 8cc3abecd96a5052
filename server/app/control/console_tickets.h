#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/auth/ticket.h"
#include "common/base/secret.h"
#include "common/base/time.h"
#include "proto/spec/registry_spec.h"

namespace tandem::server {

/// Right of a console, from its ticket.
struct ConsoleRight {
  auth::Id16 ticket{};
  AccessRole role = AccessRole::kObserver;
  std::string person{};
  WorkstationRow workstation{};  ///< with the enrolment at which the ticket was redeemed
};

/// Redeemed tickets of a session's consoles. The resume secret of its Welcome identifies a console, because consoles
/// have no seat; `cid` is the connection id of that Welcome.
///
/// A console *comes back* with its secret and without its ticket: within kAway after its connection ended, or while the
/// server has not noticed the end. It keeps the secret, and its new connection has the right alone.
///
/// A ticket *returns* if its console was joined at a former owner of the session, in a service, and has not come back
/// yet: it is valid once more, for the workstation to which it was issued and with its role, as a resume secret is for
/// a seat. Times are those of one monotonic clock.
class ConsoleTickets {
 public:
  static constexpr Duration kAway = std::chrono::seconds(60);
  static constexpr std::size_t kAwayMax = 64;  ///< beyond it, the console that came first is forgotten

  ConsoleTickets() = default;
  /// @param returning  tickets of the consoles at the former owner  @param until  end of their right to come back
  ConsoleTickets(std::vector<auth::Id16> returning, Time until) : returning_(std::move(returning)), until_(until) {}

  /// No console is joined.
  [[nodiscard]] bool empty() const noexcept {
    return std::ranges::all_of(rows_, [](const Row& row) { return row.away_until.has_value(); });
  }
  [[nodiscard]] bool returns(const auth::Id16& ticket, Time now) const noexcept {
    return now < until_ && std::ranges::find(returning_, ticket) != returning_.end();
  }
  /// Adds a console whose ticket was redeemed. The ticket does not return any more.
  void add(const Secret<32>& console, std::uint32_t cid, ConsoleRight right) {
    const bool returned = std::erase(returning_, right.ticket) > 0;
    rows_.push_back({.console = console, .cid = cid, .right = std::move(right), .returned = returned});
  }
  /// Returns the right of a console that may come back; null: there is none with this secret, from this workstation.
  [[nodiscard]] const ConsoleRight* may_come_back(const Secret<32>& console, const WorkstationRow& workstation,
                                                  Time now) const noexcept {
    const Row* const row = find(console);
    const bool may = row != nullptr && row->joined && row->right.workstation == workstation &&
                     (!row->away_until || now < *row->away_until);
    return may ? &row->right : nullptr;
  }
  /// The console has got its Welcome, also if it came back.
  void join(const Secret<32>& console, std::uint32_t cid) noexcept {
    for (Row& row : rows_) {
      if (row.console != console) continue;
      row.came_back = row.joined;
      row.joined = true;
      row.away_until.reset();
      row.cid = cid;
    }
  }
  /// Whether the console has this connection.
  [[nodiscard]] bool contains(const Secret<32>& console, std::uint32_t cid) const noexcept {
    const Row* const row = find(console);
    return row != nullptr && row->cid == cid && !row->away_until;
  }
  /// Whether the console came back over another connection than this one.
  [[nodiscard]] bool replaced(const Secret<32>& console, std::uint32_t cid) const noexcept {
    const Row* const row = find(console);
    return row != nullptr && row->cid != cid;
  }
  /// Whether the console came by a ticket that returned.
  [[nodiscard]] bool returned(const Secret<32>& console) const noexcept {
    const Row* const row = find(console);
    return row != nullptr && row->returned;
  }
  /// Whether the console came back.
  [[nodiscard]] bool came_back(const Secret<32>& console) const noexcept {
    const Row* const row = find(console);
    return row != nullptr && row->came_back;
  }
  /// The connection of a joined console has ended. Another one of the console changes nothing.
  void leave(const Secret<32>& console, std::uint32_t cid, Time now) {
    std::erase_if(rows_, [now](const Row& row) { return row.away_until && *row.away_until <= now; });
    for (Row& row : rows_)
      if (row.console == console && row.cid == cid) row.away_until = now + kAway;
    const auto away = [](const Row& row) { return row.away_until.has_value(); };
    if (std::ranges::count_if(rows_, away) > static_cast<std::ptrdiff_t>(kAwayMax))
      rows_.erase(std::ranges::find_if(rows_, away));
  }
  /// Removes a console. The ticket of one that has got no Welcome returns again, if it did before.
  /// @return its ticket; nullopt if there is no such console, or it has another connection
  std::optional<auth::Id16> take(const Secret<32>& console, std::uint32_t cid) {
    const Row* const row = find(console);
    if (row == nullptr || row->cid != cid) return std::nullopt;
    const auth::Id16 ticket = row->right.ticket;
    if (row->returned && !row->joined) returning_.push_back(ticket);
    rows_.erase(rows_.begin() + (row - rows_.data()));
    return ticket;
  }
  /// Removes all consoles, for another owner of the session. Their tickets return there. @return these tickets
  std::vector<auth::Id16> release_all() {
    std::vector<auth::Id16> released;
    for (const Row& row : std::exchange(rows_, {}))
      if (!row.away_until) released.push_back(row.right.ticket);
    returning_.insert(returning_.end(), released.begin(), released.end());
    return released;
  }
  /// Tickets that return at the next owner if this one dies: those of joined consoles, then those that return here.
  [[nodiscard]] std::vector<auth::Id16> returning_next() const {
    std::vector<auth::Id16> tickets;
    for (const Row& row : rows_)
      if ((row.joined || row.returned) && !row.away_until) tickets.push_back(row.right.ticket);
    tickets.insert(tickets.end(), returning_.begin(), returning_.end());
    return tickets;
  }

 private:
  struct Row {
    Secret<32> console;
    std::uint32_t cid = 0;
    ConsoleRight right;
    bool returned = false;                   ///< the ticket returned
    bool joined = false, came_back = false;  ///< a Welcome was sent; more than one
    std::optional<Time> away_until{};        ///< end of its right to come back; nullopt: it has its connection
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
