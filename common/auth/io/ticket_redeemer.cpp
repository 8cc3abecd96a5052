#include "common/auth/io/ticket_redeemer.h"

#include <utility>

#include "common/auth/io/append_file.h"
#include "common/base/raw_bytes.h"

namespace tandem::auth {

std::expected<RedeemedTickets, std::string> TicketRedeemer::read(const StateDirectory& folder) {
  const auto bytes = folder.read(kFile);
  if (!bytes) return std::unexpected(bytes.error());
  auto used = RedeemedTickets::parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{});
  if (used) return used;
  return std::unexpected(folder.path_of(kFile) + ": " + used.error() +
                         "; delete that line (its ticket is then valid again), or the file once 12 h have passed");
}

std::string TicketRedeemer::begin(std::int64_t now) {
  auto used = read(*folder_);
  if (!used) return used.error();
  used_ = std::move(*used);
  begun_ = true;
  return rewrite(now);
}

std::string TicketRedeemer::rewrite(std::int64_t now) {
  used_.prune(now);
  appended_ = 0;
  std::string problem = folder_->replace(kFile, std::string_view(used_.to_text()));
  unsure_ = !problem.empty();
  return problem;
}

std::string TicketRedeemer::write(const Id16& ticket, std::int64_t not_after, std::int64_t now) {
  if (!folder_) return {};
  // Lines are appended until enough have expired to rewrite the file, or until its content is uncertain.
  if (unsure_ || ++appended_ > RedeemedTickets::kMax) return rewrite(now);
  std::string problem = AppendFile(*folder_, kFile).append(RedeemedTickets::line(ticket, not_after));
  unsure_ = !problem.empty();
  return problem;
}

std::expected<Ticket, TicketRedeemer::Failure> TicketRedeemer::redeem(std::span<const std::byte> bytes,
                                                                      const TicketUse& use) {
  const auto broken = [](TicketError fault) {
    std::string text = to_text(fault);
    return std::unexpected(Failure{std::move(fault), std::move(text)});
  };
  if (folder_ && !begun_)
    return std::unexpected(Failure{std::nullopt, "this server has not begun to serve from its folder"});
  auto ticket = check_ticket(bytes, verifier_, use);
  if (!ticket) return broken(ticket.error());
  if (auto once = used_.redeem(*ticket, use.now); !once) return broken(once.error());
  if (std::string problem = write(ticket->ticket_id, ticket->not_after, use.now); !problem.empty()) {
    used_.forget(ticket->ticket_id);  // no client is admitted, so the ticket is not used
    return std::unexpected(Failure{std::nullopt, std::move(problem)});
  }
  return std::move(*ticket);
}

bool TicketRedeemer::was_redeemed(std::span<const std::byte> bytes, const TicketUse& use) const {
  const auto ticket = check_ticket(bytes, verifier_, use);
  return ticket && used_.contains(ticket->ticket_id);
}

std::string TicketRedeemer::restore(const Id16& ticket) {
  used_.forget(ticket);
  return write(ticket, 0, 0);
}

}  // namespace tandem::auth
