#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <map>
#include <string>
#include <string_view>

#include "common/trust/ticket.h"

namespace tandem::trust {

/// Remembers tickets that were used until they expire, so that each is good once. Bounded; full: nobody new gets in, since forgetting a
/// used ticket would let it in twice. As text: one line `HEX32 NOT_AFTER` per ticket, appended as it is used.
class UsedTickets {
 public:
  static constexpr std::size_t kMax = 65536;

  /// What a file holds. A last line without its line feed was cut by a crash while it was written: it is left out, because its ticket
  /// let nobody in yet. Every other line that is not of the form is an error: `line N`.
  [[nodiscard]] static std::expected<UsedTickets, std::string> parse(std::string_view text);

  [[nodiscard]] bool used(const Id16& ticket) const { return not_after_.contains(ticket); }
  /// @return nothing: it may be used now and is remembered; else kUsed or kBookFull
  [[nodiscard]] std::expected<void, TicketFault> use(const Ticket& ticket, std::int64_t now);
  /// It is good again: nothing came of its use. In a file: a line of time 0 behind the other, which the next `prune` takes away.
  void forget(const Id16& ticket) { not_after_.erase(ticket); }
  /// Forgets those that have expired. @return how many
  std::size_t prune(std::int64_t now);

  [[nodiscard]] static std::string line(const Id16& ticket, std::int64_t not_after);
  [[nodiscard]] std::string to_text() const;
  [[nodiscard]] std::size_t size() const noexcept { return not_after_.size(); }

 private:
  std::map<Id16, std::int64_t> not_after_;
};

}  // namespace tandem::trust
