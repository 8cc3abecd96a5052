#include "server/directory/directory_view.h"

#include <algorithm>

namespace tandem::directory {

std::optional<Request> DirectoryView::poll_request(Time now, OperationId operation, Duration retry_after) {
  if (state_ == State::kReading && now - began_ >= retry_after) state_ = State::kStale;
  if (state_ == State::kStale) {
    state_ = State::kReading;
    operation_ = operation;
    began_ = now;
    return Transaction{{}, {Read{keys_.live(), true}}, {}};
  }
  if (state_ == State::kRead) {
    state_ = State::kFollowing;
    operation_ = operation;
    return Watch{keys_.live(), next_};
  }
  return std::nullopt;
}

bool DirectoryView::on_reply(const Reply& reply) {
  if (reply.operation != operation_ || (state_ != State::kReading && state_ != State::kFollowing)) return false;
  if (reply.outcome != Outcome::kDone) {
    state_ = State::kStale;
  } else if (state_ == State::kReading) {
    replace(reply.found.empty() ? std::vector<KeyValue>{} : reply.found.front());
    next_ = reply.revision + 1;
    ++readings_;
    state_ = State::kRead;
  } else {
    for (const Change& change : reply.changes) {
      // A stream that was built again may repeat changes.
      if (change.entry.modified < next_) continue;
      apply(change);
    }
    if (!reply.changes.empty()) next_ = std::max(next_, reply.changes.back().entry.modified + 1);
  }
  return true;
}

void DirectoryView::apply(const Change& change) {
  const auto key = keys_.parse(change.entry.key);
  if (!key) {
    ++foreign_keys_;
    return;
  }
  if (key->kind == DirectoryKeys::Parsed::Kind::kServer) {
    if (change.erased)
      servers_.erase(key->name);
    else
      servers_[key->name] = {change.entry.value, change.entry.lease};
    return;
  }
  SessionEntry& session = sessions_[key->name];
  std::optional<Named>& named = key->kind == DirectoryKeys::Parsed::Kind::kOwner ? session.owner : session.standby;
  if (change.erased)
    named.reset();
  else
    named = Named{change.entry.value, change.entry.created, change.entry.lease};
  changed_.insert(key->name);
  if (!session.owner && !session.standby) sessions_.erase(key->name);
}

void DirectoryView::replace(const std::vector<KeyValue>& entries) {
  for (const auto& [name, entry] : sessions_) changed_.insert(name);
  sessions_.clear();
  servers_.clear();
  for (const KeyValue& entry : entries) apply({entry, false});
}

std::optional<std::string> DirectoryView::poll_changed() {
  if (changed_.empty()) return std::nullopt;
  std::string name = std::move(changed_.extract(changed_.begin()).value());
  return name;
}

const DirectoryView::SessionEntry* DirectoryView::session(std::string_view name) const {
  const auto found = sessions_.find(name);
  return found == sessions_.end() ? nullptr : &found->second;
}

const DirectoryView::ServerEntry* DirectoryView::server(std::string_view name) const {
  const auto found = servers_.find(name);
  return found == servers_.end() ? nullptr : &found->second;
}

}  // namespace tandem::directory
