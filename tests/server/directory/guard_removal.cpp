#include "tests/server/directory/guard_removal.h"

namespace tandem::directory::test {

void weaken(Guard removed, LeaseId immortal, Request& request) {
  auto* transaction = std::get_if<Transaction>(&request);
  if (!transaction || transaction->then.empty()) return;
  auto* put = std::get_if<Put>(&transaction->then[0]);
  const auto* erase = std::get_if<Erase>(&transaction->then[0]);
  const bool owner_put = put && put->key.ends_with("/owner"), standby_put = put && put->key.ends_with("/standby");
  const bool ticket = put && put->key.contains("/tickets/");
  if (removed == Guard::kClaimCondition && owner_put) transaction->conditions.clear();
  if (removed == Guard::kReleaseCondition && erase) transaction->conditions.clear();
  if (removed == Guard::kTicketCondition && ticket) transaction->conditions.pop_back();
  if (removed == Guard::kKeyUnderLease && owner_put) put->lease = 0;
  if (removed == Guard::kStandbyUnderLease && standby_put) put->lease = immortal;
}

void weaken(Guard removed, const std::string& server, LeaseId own, Reply& reply) {
  if (removed == Guard::kConfirmedRenewal || removed == Guard::kSameTerm) reply.term = 1;
  for (auto& found : reply.found)
    for (KeyValue& entry : found) {
      const bool owner = entry.key.ends_with("/owner") && entry.value == server;
      const bool ours = owner || entry.key.ends_with("/" + server);
      if (removed == Guard::kLeaseIdentity && ours) entry.lease = own;
      if (removed == Guard::kAdoption && owner) entry.lease = -1;
    }
}

std::optional<Reply> answer_without_store(Guard removed, const std::string& server, LeaseId own, OperationId operation,
                                          const Request& request) {
  const auto* transaction = std::get_if<Transaction>(&request);
  if (removed != Guard::kConfirmedRenewal || !transaction || !transaction->conditions.empty()) return std::nullopt;
  const auto* read = transaction->then.size() == 1 ? std::get_if<Read>(&transaction->then[0]) : nullptr;
  if (!read || !read->key.ends_with("/" + server)) return std::nullopt;
  Reply reply;
  reply.operation = operation;
  reply.term = 1;
  reply.held = true;
  reply.found = {{{read->key, "text", 1, 1, own}}};
  return reply;
}

}  // namespace tandem::directory::test
