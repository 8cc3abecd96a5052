#include "server/service/service_tickets.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

using directory::Condition;
using directory::Notice;

void ServiceTickets::use(Time now, const std::string& session, const std::string& ticket, Duration life,
                         std::uint64_t order, bool again) {
  if (uses_.size() >= kWaitingMax || uses_.contains(ticket) || ownership_.revision(session) == 0) {
    results_.push_back({order, Outcome::kNoAnswer});
    return;
  }
  const Time end = now + std::clamp(life, Duration::zero(), kLifeMax);
  uses_[ticket] = {session, order, end.time_since_epoch() / kPeriod + 1, false, again, now + kAnswerLimit};
}

void ServiceTickets::restore(const std::string& session, const std::string& ticket) {
  const auto accepted = accepted_.extract(ticket);
  if (!accepted) return;
  const directory::Revision owner = ownership_.revision(session);
  if (owner == 0 || restores_.size() >= kWaitingMax) return;  // it stays used
  restores_.push_back({session, ticket, owner, accepted.mapped().revision});
}

bool ServiceTickets::restoring(std::string_view session) const noexcept {
  return std::ranges::find(restores_, session, &Restore::session) != restores_.end();
}

bool ServiceTickets::uses_wait(std::string_view session) const noexcept {
  return std::ranges::any_of(uses_, [&](const auto& use) { return use.second.session == session; });
}

void ServiceTickets::on_notice(const Notice& notice) {
  const auto found = uses_.find(notice.other);
  if (found == uses_.end()) return;
  const Use use = std::move(found->second);
  uses_.erase(found);
  const bool accepted = notice.kind == Notice::Kind::kTicketAccepted;
  if (accepted && accepted_.size() < kAcceptedMax) accepted_[notice.other] = {use.period, notice.revision};
  // It is gone with a directory that was restored from an older copy.
  if (notice.kind == Notice::Kind::kTicketNoLease) leases_.erase(use.period);
  const bool used = notice.kind == Notice::Kind::kTicketRefused;
  if (use.order != 0)
    results_.push_back({use.order, accepted ? Outcome::kAccepted : used ? Outcome::kUsed : Outcome::kNoAnswer});
  else if (accepted)
    restore(use.session, notice.other);  // its client was refused meanwhile
}

void ServiceTickets::pass_on(Time now) {
  for (auto use = uses_.begin(); use != uses_.end();) {
    auto& [ticket, it] = *use;
    if (it.order != 0 && now >= it.ends) {
      results_.push_back({std::exchange(it.order, 0), Outcome::kNoAnswer});
      if (!it.asked) {
        use = uses_.erase(use);
        continue;
      }
    }
    // A ticket that is being restored is used when that is done, because its restore would erase the use.
    const bool restored = !it.asked && std::ranges::find(restores_, ticket, &Restore::ticket) != restores_.end();
    if (const auto lease = leases_.find(it.period); !it.asked && !restored && lease != leases_.end()) {
      it.asked = ownership_.use_ticket(it.session, ticket, lease->second, it.again);
      if (!it.asked) {
        results_.push_back({it.order, Outcome::kNoAnswer});
        use = uses_.erase(use);
        continue;
      }
    }
    ++use;
  }
}

std::optional<directory::Request> ServiceTickets::poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after) {
  pass_on(now);
  if (now - sent_ < (operation_ != 0 ? retry_after : pause_)) return std::nullopt;
  operation_ = 0;
  const auto past = [&](std::int64_t period) { return Time{period * kPeriod} < now; };
  if (std::erase_if(leases_, [&](const auto& lease) { return past(lease.first); }) > 0)
    std::erase_if(accepted_, [&](const auto& ticket) { return past(ticket.second.period); });
  const auto waits = [&](const auto& use) { return !use.second.asked && !leases_.contains(use.second.period); };
  if (const auto use = std::ranges::find_if(uses_, waits); use != uses_.end()) {
    operation_ = operation;
    granting_ = use->second.period;
    sent_ = now;
    const Duration left = Time{(use->second.period + 1) * kPeriod} - now;
    return directory::Grant{std::chrono::ceil<std::chrono::seconds>(left)};
  }
  if (restores_.empty()) return std::nullopt;
  operation_ = operation;
  granting_.reset();
  sent_ = now;
  const Restore& next = restores_.front();
  // Of this use: a copy that is executed late must not erase a later one.
  return directory::Transaction{{{keys_.owner(next.session), Condition::Of::kCreated, next.owner},
                                 {keys_.ticket(next.ticket), Condition::Of::kModified, next.use}},
                                {directory::Erase{keys_.ticket(next.ticket)}},
                                {}};
}

bool ServiceTickets::on_reply(const directory::Reply& reply) {
  if (operation_ == 0 || reply.operation != operation_) return false;
  operation_ = 0;
  const bool done = reply.outcome == directory::Outcome::kDone;
  pause_ = done ? Duration::zero() : kAskAgain;
  if (!done) return true;
  if (granting_)
    leases_[*granting_] = reply.lease;
  else
    restores_.pop_front();
  return true;
}

std::optional<ServiceTickets::Result> ServiceTickets::poll_result() {
  if (results_.empty()) return std::nullopt;
  const Result result = results_.front();
  results_.pop_front();
  return result;
}

}  // namespace tandem::server
