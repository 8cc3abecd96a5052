#include "common/auth/redeemed_tickets.h"

#include <charconv>

namespace tandem::auth {

std::expected<RedeemedTickets, std::string> RedeemedTickets::parse(std::string_view text) {
  RedeemedTickets book;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    Id16 id;
    std::int64_t not_after = -1;
    const bool form = line.size() > 33 && line[32] == ' ' && from_hex(line.substr(0, 32), id);
    if (form) {
      const auto [stop, error] = std::from_chars(line.data() + 33, line.data() + line.size(), not_after);
      if (error != std::errc{} || stop != line.data() + line.size()) not_after = -1;
    }
    if (not_after < 0)
      return std::unexpected("line " + std::to_string(number) +
                             ": must be 32 hex digits, a space and a time in seconds");
    book.not_after_.insert_or_assign(id, not_after);
  }
  return book;
}

std::expected<void, TicketError> RedeemedTickets::redeem(const Ticket& ticket, std::int64_t now) {
  if (contains(ticket.ticket_id)) return std::unexpected(TicketError{TicketCheck::kUsed, 0, {}});
  if (size() >= kMax) prune(now);
  if (size() >= kMax) return std::unexpected(TicketError{TicketCheck::kBookFull, 0, {}});
  not_after_.emplace(ticket.ticket_id, ticket.not_after);
  return {};
}

std::size_t RedeemedTickets::prune(std::int64_t now) {
  return std::erase_if(not_after_, [now](const auto& entry) { return entry.second < now; });
}

std::string RedeemedTickets::line(const Id16& ticket, std::int64_t not_after) {
  return to_hex(ticket) + ' ' + std::to_string(not_after) + '\n';
}

std::string RedeemedTickets::to_text() const {
  std::string text;
  for (const auto& [id, not_after] : not_after_) text += line(id, not_after);
  return text;
}

}  // namespace tandem::auth
