#include "server/app/service/service_ticket_uses.h"

#include <utility>

#include "common/base/hex.h"

namespace tandem::server {

void ServiceTicketUses::use(const std::string& session, const auth::Id16& ticket, std::int64_t life_s, bool again,
                            std::function<void(Outcome)> done) {
  std::uint64_t order = 0;
  {
    const std::lock_guard lock(lock_);
    order = ++newest_;
    waiting_.emplace(order, std::move(done));
  }
  thread_.with([&](ServiceMember& member, Time now) {
    member.tickets().use(now, session, tandem::to_hex(ticket), std::chrono::seconds(life_s), order, again);
  });
}

void ServiceTicketUses::restore(const std::string& session, const auth::Id16& ticket) {
  thread_.with([&](ServiceMember& member, Time) { member.tickets().restore(session, tandem::to_hex(ticket)); });
}

void ServiceTicketUses::on_result(const ServiceTickets::Result& result) {
  std::function<void(Outcome)> done;
  {
    const std::lock_guard lock(lock_);
    const auto found = waiting_.find(result.order);
    if (found == waiting_.end()) return;
    done = std::move(found->second);
    waiting_.erase(found);
  }
  const Outcome outcome = result.outcome == ServiceTickets::Outcome::kAccepted ? Outcome::kAccepted
                          : result.outcome == ServiceTickets::Outcome::kUsed   ? Outcome::kUsed
                                                                               : Outcome::kNoAnswer;
  control_.post([done = std::move(done), outcome] { done(outcome); });
}

}  // namespace tandem::server
