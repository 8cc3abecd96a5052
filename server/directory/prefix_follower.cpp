#include "server/directory/prefix_follower.h"

#include <algorithm>
#include <limits>

namespace tandem::directory {

namespace {

/// The next revision; the store may send any number.
Revision after(Revision revision) { return std::min(revision, std::numeric_limits<Revision>::max() - 1) + 1; }

}  // namespace

std::optional<Request> PrefixFollower::poll_request(Time now, OperationId operation, Duration retry_after) {
  if (state_ == State::kReading && now - began_ >= retry_after) state_ = State::kStale;
  if (state_ == State::kStale) {
    if (now < next_read_) return std::nullopt;
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
  const bool watch_went_back = state_ == State::kFollowing && reply.revision > 0 && reply.revision < revision();
  if (reply.outcome != Outcome::kDone || watch_went_back) {
    if (state_ == State::kReading) next_read_ = began_ + kAskAgain;
    state_ = State::kStale;
  } else if (state_ == State::kReading) {
    news.all = true;
    news.back = reply.revision < revision();
    if (!reply.found.empty())
      for (const KeyValue& entry : reply.found.front()) news.changes.push_back({entry, false});
    next_ = after(reply.revision);
    ++readings_;
    state_ = State::kRead;
  } else {
    // A stream that was built again may repeat changes.
    for (const Change& change : reply.changes)
      if (change.entry.modified >= next_) news.changes.push_back(change);
    if (!reply.changes.empty()) next_ = std::max(next_, after(reply.changes.back().entry.modified));
  }
  return news;
}

}  // namespace tandem::directory
