#include "server/service/directory_loss.h"

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
                                                              Duration retry_after) {
  if (known_ || (asked_ && now - *asked_ < (operation_ != 0 ? retry_after : kAskAgain))) return std::nullopt;
  operation_ = operation;
  asked_ = now;
  return directory::Transaction{{}, {directory::Read{mark_}}, {}};
}

DirectoryLoss::Found DirectoryLoss::on_reply(const directory::Reply& reply, const RegistryAgreement& agreed) {
  if (operation_ == 0 || reply.operation != operation_) return Found::kNothing;
  operation_ = 0;
  if (reply.outcome != Outcome::kDone || reply.found.empty()) return Found::kSame;  // it is asked again
  known_ = true;
  if (agreed.mark.empty()) return Found::kSame;
  const auto& mark = reply.found[0];
  const bool same =
      !mark.empty() && mark[0].value == agreed.mark && (agreed.created == 0 || agreed.created == mark[0].created);
  return same ? Found::kSame : Found::kOther;
}

void DirectoryLoss::on_loss(Time now) {
  ++losses_;
  constexpr std::int64_t kBaseMax = std::int64_t{1} << 61;
  base_ = std::min(std::max(base_, highest_base_) + std::min(newest_, kBaseMax), kBaseMax);
  newest_ = 0;
  sent_.clear();
  wait_until_ = now + ttl_;
}

}  // namespace tandem::server
