#include "server/service/directory_loss.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

using directory::Outcome;

void DirectoryLoss::on_begin(directory::OperationId operation, const directory::Request& request) {
  // Only the revision of a transaction with a step is that of the whole store. A member of etcd that lags answers the
  // other requests with its own.
  const auto* const transaction = std::get_if<directory::Transaction>(&request);
  if (transaction == nullptr || transaction->then.empty() || newest_ == 0) return;
  if (sent_.size() >= kSentMax) sent_.erase(sent_.begin());
  sent_[operation] = newest_;
}

bool DirectoryLoss::went_back(const directory::Reply& reply) {
  const auto sent = sent_.find(reply.operation);
  const directory::Revision known = sent == sent_.end() ? 0 : sent->second;
  if (sent != sent_.end()) sent_.erase(sent);
  if (reply.outcome != Outcome::kDone) return false;
  newest_ = std::max(newest_, reply.revision);
  return reply.revision < known;
}

std::optional<directory::Request> DirectoryLoss::poll_request(Time now, directory::OperationId operation,
                                                              Duration retry_after, const RegistryAgreement& agreed) {
  if (known_ || (asked_ && now - *asked_ < (operation_ != 0 ? retry_after : kAskAgain))) return std::nullopt;
  operation_ = operation;
  asked_ = now;
  expected_ = agreed.mark;
  expected_created_ = agreed.created;
  return directory::Transaction{{}, {directory::Read{mark_}}, {}};
}

DirectoryLoss::Found DirectoryLoss::on_reply(Time now, const directory::Reply& reply) {
  if (operation_ == 0 || reply.operation != operation_) return Found::kNothing;
  operation_ = 0;
  if (reply.outcome != Outcome::kDone || reply.found.empty()) return Found::kSame;  // it is asked again
  known_ = true;
  if (std::exchange(stranger_, false)) wait_until_ = now + ttl_;
  if (expected_.empty()) return Found::kSame;
  const auto& mark = reply.found[0];
  const bool same =
      !mark.empty() && mark[0].value == expected_ && (expected_created_ == 0 || expected_created_ == mark[0].created);
  return same ? Found::kSame : Found::kOther;
}

void DirectoryLoss::on_loss(Time now) {
  ++losses_;
  newest_ = 0;
  sent_.clear();
  wait_until_ = now + ttl_;
}

}  // namespace tandem::server
