#include "server/directory/model_store.h"

#include <algorithm>

namespace tandem::directory {

namespace {

template <class... Visitors>
struct Visit : Visitors... {
  using Visitors::operator()...;
};

/// Returns whether etcd accepts the steps of a branch: every key has a name, and no Put meets another write of its key.
bool valid(const std::vector<Step>& steps) {
  std::set<std::string> put, erased;
  for (const Step& step : steps) {
    if (const auto* one = std::get_if<Put>(&step)) {
      if (one->key.empty() || !put.insert(one->key).second) return false;
    } else if (const auto* other = std::get_if<Erase>(&step)) {
      if (other->key.empty()) return false;
      erased.insert(other->key);
    } else if (const auto& read = std::get<Read>(step); read.key.empty() && !read.prefix) {
      return false;
    }
  }
  return std::ranges::none_of(put, [&](const std::string& key) { return erased.contains(key); });
}

}  // namespace

void ModelStore::advance(Time now) {
  now_ = std::max(now_, now);
  while (true) {
    const auto next = std::ranges::min_element(leases_, {}, [](const auto& lease) { return lease.second.end; });
    if (next == leases_.end() || next->second.end > now_) return;
    end_lease(next);
  }
}

Reply ModelStore::execute(OperationId operation, const Request& request) {
  return std::visit(Visit{[&](const Grant& wanted) { return grant(operation, wanted); },
                          [&](const Renew& wanted) { return renew(operation, wanted.lease); },
                          [&](const Remaining& wanted) { return remaining(operation, wanted.lease); },
                          [&](const Revoke& wanted) {
                            const auto lease = leases_.find(wanted.lease);
                            if (lease == leases_.end()) return answer(operation, Outcome::kNoLease);
                            end_lease(lease);
                            return answer(operation);
                          },
                          [&](const Transaction& wanted) { return run(operation, wanted); },
                          [&](const Watch& wanted) { return watch(operation, wanted); },
                          [&](const Compact& wanted) { return compact(operation, wanted.until); }},
                    request);
}

Reply ModelStore::answer(OperationId operation, Outcome outcome) const {
  Reply reply;
  reply.operation = operation;
  reply.outcome = outcome;
  reply.revision = revision_;
  reply.term = term_;
  return reply;
}

Reply ModelStore::grant(OperationId operation, const Grant& wanted) {
  if (wanted.ttl <= Duration{}) return answer(operation, Outcome::kRefused);
  Lease& lease = leases_[++newest_lease_];
  lease.ttl = std::max(wanted.ttl, kTtlMin);
  lease.end = now_ + lease.ttl;
  Reply reply = answer(operation);
  reply.lease = newest_lease_;
  reply.ttl = lease.ttl;
  return reply;
}

Reply ModelStore::renew(OperationId operation, LeaseId id) {
  const auto lease = leases_.find(id);
  if (lease == leases_.end()) return answer(operation, Outcome::kNoLease);
  lease->second.end = now_ + lease->second.ttl;
  Reply reply = answer(operation);
  reply.ttl = lease->second.ttl;
  return reply;
}

Reply ModelStore::remaining(OperationId operation, LeaseId id) const {
  const auto lease = leases_.find(id);
  if (lease == leases_.end()) return answer(operation, Outcome::kNoLease);
  Reply reply = answer(operation);
  reply.ttl = std::chrono::floor<std::chrono::seconds>(lease->second.end - now_);
  return reply;
}

bool ModelStore::holds(const Condition& condition) const {
  const auto found = entries_.find(condition.key);
  const KeyValue entry = found == entries_.end() ? KeyValue{} : found->second;
  switch (condition.of) {
    case Condition::Of::kCreated:
      return entry.created == condition.equals;
    case Condition::Of::kModified:
      return entry.modified == condition.equals;
    case Condition::Of::kLease:
      return entry.lease == condition.equals;
  }
  return false;
}

Outcome ModelStore::problem(const std::vector<Step>& steps) const {
  for (const Step& step : steps) {
    if (const auto* one = std::get_if<Put>(&step); one && one->lease != 0 && !leases_.contains(one->lease))
      return Outcome::kNoLease;
  }
  return Outcome::kDone;
}

Reply ModelStore::run(OperationId operation, const Transaction& transaction) {
  const bool named = std::ranges::none_of(transaction.conditions, [](const Condition& c) { return c.key.empty(); });
  if (!named || !valid(transaction.then) || !valid(transaction.otherwise)) return answer(operation, Outcome::kRefused);
  const bool held = std::ranges::all_of(transaction.conditions, [this](const Condition& c) { return holds(c); });
  const std::vector<Step>& steps = held ? transaction.then : transaction.otherwise;
  if (const Outcome outcome = problem(steps); outcome != Outcome::kDone) return answer(operation, outcome);
  bool wrote = false;
  std::vector<std::vector<KeyValue>> found;
  for (const Step& step : steps)
    std::visit(Visit{[&](const Put& one) {
                       put(one, revision_ + 1);
                       wrote = true;
                     },
                     [&](const Erase& one) { wrote |= erase(one.key, revision_ + 1); },
                     [&](const Read& one) { found.push_back(read(one)); }},
               step);
  if (wrote) {
    ++revision_;
    ++writes_;
  }
  Reply reply = answer(operation);
  reply.held = held;
  reply.found = std::move(found);
  return reply;
}

void ModelStore::put(const Put& step, Revision at) {
  KeyValue& entry = entries_[step.key];
  if (entry.lease != 0) leases_[entry.lease].keys.erase(step.key);
  if (step.lease != 0) leases_[step.lease].keys.insert(step.key);
  entry = {step.key, step.value, entry.created == 0 ? at : entry.created, at, step.lease};
  record({entry, false});
}

bool ModelStore::erase(const std::string& key, Revision at) {
  const auto entry = entries_.find(key);
  if (entry == entries_.end()) return false;
  if (const LeaseId lease = entry->second.lease; lease != 0) leases_[lease].keys.erase(key);
  entries_.erase(entry);
  record({{key, {}, 0, at, 0}, true});
  return true;
}

void ModelStore::end_lease(std::map<LeaseId, Lease>::iterator lease) {
  const std::set<std::string> keys = lease->second.keys;
  for (const std::string& key : keys) erase(key, revision_ + 1);
  leases_.erase(lease);
  ++writes_;
  if (!keys.empty()) ++revision_;
}

std::vector<KeyValue> ModelStore::read(const Read& step) const {
  std::vector<KeyValue> found;
  for (auto entry = entries_.lower_bound(step.key); entry != entries_.end(); ++entry) {
    if (step.prefix ? !entry->first.starts_with(step.key) : entry->first != step.key) break;
    found.push_back(entry->second);
  }
  return found;
}

void ModelStore::record(Change change) {
  history_.push_back(std::move(change));
  if (history_.size() > kHistoryMax) forget(history_.front().entry.modified);
}

void ModelStore::forget(Revision until) {
  compacted_ = std::max(compacted_, until);
  while (!history_.empty() && history_.front().entry.modified <= until) history_.pop_front();
}

Reply ModelStore::watch(OperationId operation, const Watch& wanted) {
  if (wanted.from != 0 && wanted.from <= compacted_) return answer(operation, Outcome::kCompacted);
  watches_[operation] = {wanted.prefix, wanted.from == 0 ? revision_ + 1 : wanted.from};
  return answer(operation);
}

Reply ModelStore::compact(OperationId operation, Revision until) {
  if (until <= compact_revision_) return answer(operation, Outcome::kCompacted);
  if (until > revision_) return answer(operation, Outcome::kRefused);
  compact_revision_ = until;
  forget(until - 1);  // as in etcd, a watch may still begin at the compacted revision itself
  return answer(operation);
}

std::optional<Reply> ModelStore::take_changes(OperationId id) {
  const auto found = watches_.find(id);
  if (found == watches_.end()) return std::nullopt;
  OpenWatch& open = found->second;
  if (open.next <= compacted_) {
    watches_.erase(found);
    return answer(id, Outcome::kCompacted);
  }
  Reply reply = answer(id);
  const auto first =
      std::ranges::lower_bound(history_, open.next, {}, [](const Change& c) { return c.entry.modified; });
  for (auto change = first; change != history_.end(); ++change)
    if (change->entry.key.starts_with(open.prefix)) reply.changes.push_back(*change);
  open.next = std::max(open.next, revision_ + 1);
  if (reply.changes.empty()) return std::nullopt;
  return reply;
}

void ModelStore::elect() {
  ++term_;
  leases_before_election_.clear();
  for (auto& [id, lease] : leases_) {
    leases_before_election_[id] = lease.ttl;
    lease.end = now_ + lease.ttl;
  }
}

void ModelStore::resume(Time now, LeaseId leases_from) {
  now_ = now;
  newest_lease_ = std::max(newest_lease_, leases_from);
  elect();
}

std::optional<Reply> ModelStore::execute_deposed(OperationId operation, const Request& request) const {
  const auto* renew = std::get_if<Renew>(&request);
  if (renew == nullptr) return std::nullopt;
  const auto lease = leases_before_election_.find(renew->lease);
  Reply reply = answer(operation, lease == leases_before_election_.end() ? Outcome::kNoLease : Outcome::kDone);
  reply.term = term_ - 1;
  if (lease != leases_before_election_.end()) reply.ttl = lease->second;
  return reply;
}

void ModelDirectory::begin(OperationId operation, const Request& request) {
  replies_.push_back(store_.execute(connection_ + operation, request));
  replies_.back().operation = operation;
  if (std::holds_alternative<Watch>(request) && replies_.back().outcome == Outcome::kDone)
    watches_.push_back(operation);
}

std::optional<Reply> ModelDirectory::poll() {
  for (std::size_t n = 0; n < watches_.size() && replies_.empty(); ++n) {
    auto changes = store_.take_changes(connection_ + watches_[n]);
    if (!changes) continue;
    changes->operation = watches_[n];
    if (changes->outcome != Outcome::kDone) watches_.erase(watches_.begin() + static_cast<std::ptrdiff_t>(n));
    replies_.push_back(std::move(*changes));
  }
  if (replies_.empty()) return std::nullopt;
  Reply reply = std::move(replies_.front());
  replies_.pop_front();
  return reply;
}

}  // namespace tandem::directory
