#include "server/directory/prefix_follower.h"

#include <algorithm>

namespace tandem::directory {

std::optional<Request> PrefixFollower::poll_request(Time now, OperationId operation, Duration retry_after) {
  if (state_ == State::kReading && now - began_ >= retry_after) state_ = State::kStale;
  if (state_ == State::kStale) {
    state_ = State::kReading;
    operation_ = operation;
    began_ = now;
    return Transaction{{}, {Read{prefix_, true}}, {}};
  }
  if (state_ == State::kRead) {
    state_ = State::kFollowing;
    operation_ = operation;
    return Watch{prefix_, next_};
  }
  return std::nullopt;
}

std::optional<PrefixFollower::News> PrefixFollower::on_reply(const Reply& reply) {
  if (reply.operation != operation_ || (state_ != State::kReading && state_ != State::kFollowing)) return std::nullopt;
  News news;
  if (reply.outcome != Outcome::kDone) {
    state_ = State::kStale;
  } else if (state_ == State::kReading) {
    news.all = true;
    if (!reply.found.empty())
      for (const KeyValue& entry : reply.found.front()) news.changes.push_back({entry, false});
    next_ = reply.revision + 1;
    ++readings_;
    state_ = State::kRead;
  } else {
    // A stream that was built again may repeat changes.
    for (const Change& change : reply.changes)
      if (change.entry.modified >= next_) news.changes.push_back(change);
    if (!reply.changes.empty()) next_ = std::max(next_, reply.changes.back().entry.modified + 1);
  }
  return news;
}

}  // namespace tandem::directory
