#include "server/directory/directory_loss.h"

#include <algorithm>
#include <utility>

namespace tandem::directory {

void DirectoryLoss::on_begin(OperationId operation, const Request& request) {
  // Only the revision of a transaction with a step is that of the whole store. A member of etcd that lags answers the
  // other requests with its own.
  const auto* const transaction = std::get_if<Transaction>(&request);
  if (transaction == nullptr || transaction->then.empty() || newest_ == 0) return;
  if (sent_.size() >= kSentMax) sent_.erase(sent_.begin());
  sent_[operation] = newest_;
}

bool DirectoryLoss::went_back(const Reply& reply) {
  const auto sent = sent_.find(reply.operation);
  const Revision known = sent == sent_.end() ? 0 : sent->second;
  if (sent != sent_.end()) sent_.erase(sent);
  if (reply.outcome != Outcome::kDone) return false;
  newest_ = std::max(newest_, reply.revision);
  return reply.revision < known;
}

DirectoryMark::Found DirectoryLoss::on_reply(Time now, const Reply& reply) {
  const DirectoryMark::Found found = mark_.on_reply(reply);
  if (found != DirectoryMark::Found::kNothing && mark_.answered() && std::exchange(stranger_, false))
    wait_until_ = now + ttl_;
  return found;
}

void DirectoryLoss::on_loss(Time now) {
  ++losses_;
  newest_ = 0;
  sent_.clear();
  wait_until_ = now + ttl_;
}

}  // namespace tandem::directory
