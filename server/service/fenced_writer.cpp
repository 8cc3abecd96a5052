#include "server/service/fenced_writer.h"

#include <algorithm>

namespace tandem::server {

using directory::Outcome;

namespace {

directory::Revision found_order(const directory::Reply& reply) {
  return reply.found.empty() || reply.found[0].empty() ? 0 : reply.found[0][0].modified;
}

}  // namespace

void FencedWriter::set(const std::string& session, const std::string& key, std::string value,
                       directory::Revision revision, std::uint64_t mark) {
  if (value.size() > kValueMax || (waiting_.size() >= kKeysMax && !waiting_.contains(key))) {
    ++counters_.overflowed;
    return;
  }
  Value& entry = waiting_[key];
  entry = {session, std::move(value), revision, entry.alone && entry.revision == revision, mark, entry.first};
}

void FencedWriter::hurry(const std::string& key) {
  const auto found = waiting_.find(key);
  if (found == waiting_.end()) return;
  found->second.first = true;
  next_ = {};
}

void FencedWriter::drop(const std::string& session) {
  std::erase_if(waiting_, [&](const auto& entry) { return entry.second.session == session; });
  std::erase_if(sent_, [&](const auto& entry) { return entry.second.session == session; });
  forget_solved_problem();
}

/// A directory that is full accepts nothing, so a problem ends with the values that it concerned.
void FencedWriter::forget_solved_problem() {
  if (waiting_.empty() && sent_.empty()) problem_.clear();
}

bool FencedWriter::pending(const std::string& session) const {
  const auto its = [&](const auto& entry) { return entry.second.session == session; };
  return std::ranges::any_of(waiting_, its) || std::ranges::any_of(sent_, its);
}

void FencedWriter::again(bool alone) {
  for (auto& [key, value] : sent_) {
    value.alone = value.alone || alone;
    waiting_.try_emplace(key, std::move(value));  // a newer value stays
  }
  sent_.clear();
}

/// Begins behind the last key of before. A value that does not fit ends the transaction, and begins the next one.
void FencedWriter::collect(bool first, directory::Transaction& transaction, std::size_t& bytes) {
  std::string& last = first ? last_first_ : last_;
  auto entry = waiting_.upper_bound(last);
  for (std::size_t left = waiting_.size(); left > 0 && sent_.size() < kBatchMax; --left) {
    if (entry == waiting_.end()) entry = waiting_.begin();
    const auto& [key, value] = *entry;
    if (value.first != first) {
      ++entry;
      continue;
    }
    const bool alone = value.alone || (!sent_.empty() && sent_.begin()->second.alone);
    if (!sent_.empty() && (alone || bytes + value.value.size() > kBatchBytesMax)) return;
    const directory::Condition owned{keys_.owner(value.session), directory::Condition::Of::kCreated, value.revision};
    const auto same = [&](const directory::Condition& c) { return c.key == owned.key && c.equals == owned.equals; };
    if (std::ranges::none_of(transaction.conditions, same)) transaction.conditions.push_back(owned);
    transaction.then.push_back(directory::Put{key, value.value, 0});
    bytes += value.value.size();
    last = key;
    sent_.insert(waiting_.extract(entry++));
  }
}

std::optional<directory::Request> FencedWriter::poll_request(Time now, directory::OperationId operation,
                                                             Duration retry_after) {
  if (operation_ != 0) {
    if (now - sent_at_ < retry_after) return std::nullopt;
    operation_ = 0;  // a later answer is ignored
    ++counters_.unknown;
    problem_ = "no answer in time";
    again(false);
  }
  if (waiting_.empty() || now < next_) return std::nullopt;
  directory::Transaction transaction;
  transaction.conditions.push_back({order_key_, directory::Condition::Of::kModified, order_});
  transaction.then.push_back(directory::Put{order_key_, "", 0});
  transaction.otherwise.push_back(directory::Read{order_key_});
  std::size_t bytes = 0;
  collect(true, transaction, bytes);
  collect(false, transaction, bytes);
  operation_ = operation;
  sent_at_ = now;
  next_ = now + pause_;
  return transaction;
}

bool FencedWriter::on_reply(const directory::Reply& reply) {
  if (operation_ == 0 || reply.operation != operation_) return false;
  operation_ = 0;
  ++counters_.batches;
  if (reply.outcome != Outcome::kDone) {
    ++counters_.unknown;
    if (reply.unreachable) {
      problem_ = "no server of it can be reached";  // participants read this; the log has the network's words
    } else {
      problem_ = reply.reason.empty() ? "no answer in time" : reply.reason;
    }
    again(false);
  } else if (reply.held) {
    counters_.written += sent_.size();
    order_ = reply.revision;
    problem_.clear();
    for (const auto& [key, value] : sent_)
      if (value.mark != 0) marks_.push_back(value.mark);
    if (marks_.size() > kBatchMax) marks_.erase(marks_.begin(), marks_.end() - kBatchMax);
    sent_.clear();
  } else if (const directory::Revision order = found_order(reply); order != order_) {
    order_ = order;
    ++counters_.reordered;
    again(false);
  } else if (sent_.size() > 1) {
    again(true);
  } else {
    counters_.refused += sent_.size();  // another server owns the session, or it has ended
    sent_.clear();
  }
  forget_solved_problem();
  return true;
}

std::optional<std::uint64_t> FencedWriter::poll_written() {
  if (marks_.empty()) return std::nullopt;
  const std::uint64_t mark = marks_.front();
  marks_.pop_front();
  return mark;
}

}  // namespace tandem::server
