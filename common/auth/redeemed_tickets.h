#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <map>
#include <string>
#include <string_view>

#include "common/auth/ticket.h"

namespace tandem::auth {

/// Replay list: stores redeemed tickets until they expire, so that each is valid once. It is bounded. When it is full,
/// tickets are rejected, because a dropped entry would make its ticket valid again. As text it has one line `HEX32
/// NOT_AFTER` per ticket, appended on redemption.
class RedeemedTickets {
 public:
  static constexpr std::size_t kMax = 65536;

  /// Parses the content of a file. A last line without line feed was cut by a crash during the write; it is ignored,
  /// because its ticket admitted no client yet. Any other malformed line is an error: `line N`.
  [[nodiscard]] static std::expected<RedeemedTickets, std::string> parse(std::string_view text);

  [[nodiscard]] bool contains(const Id16& ticket) const { return not_after_.contains(ticket); }
  /// Redeems a ticket. @return no error: it was unused and is now stored; else kUsed or kBookFull
  [[nodiscard]] std::expected<void, TicketError> redeem(const Ticket& ticket, std::int64_t now);
  /// Makes a ticket valid again after an unsuccessful use. In a file this is a later line of time 0, which the next
  /// `prune` removes.
  void forget(const Id16& ticket) { not_after_.erase(ticket); }
  /// Removes expired tickets. @return how many
  std::size_t prune(std::int64_t now);

  [[nodiscard]] static std::string line(const Id16& ticket, std::int64_t not_after);
  [[nodiscard]] std::string to_text() const;
  [[nodiscard]] std::size_t size() const noexcept { return not_after_.size(); }

 private:
  std::map<Id16, std::int64_t> not_after_;
};

}  // namespace tandem::auth
