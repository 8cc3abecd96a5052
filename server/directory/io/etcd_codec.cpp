#include "server/directory/io/etcd_codec.h"

namespace tandem::directory {

namespace {

using namespace etcdserverpb;

/// Sets the range of all keys that begin with `prefix`: up to the first key after them. etcd writes "all keys" as the
/// range from "\0" to "\0".
void set_prefix(const std::string& prefix, std::string* key, std::string* end) {
  *key = prefix;
  *end = prefix;
  while (!end->empty() && static_cast<unsigned char>(end->back()) == 0xff) end->pop_back();
  if (!end->empty()) {
    end->back() = static_cast<char>(static_cast<unsigned char>(end->back()) + 1);
    return;
  }
  *end = std::string(1, '\0');
  if (key->empty()) *key = *end;
}

void add_step(const Step& step, RequestOp* into) {
  if (const auto* put = std::get_if<Put>(&step)) {
    into->mutable_request_put()->set_key(put->key);
    into->mutable_request_put()->set_value(put->value);
    into->mutable_request_put()->set_lease(put->lease);
  } else if (const auto* erase = std::get_if<Erase>(&step)) {
    into->mutable_request_delete_range()->set_key(erase->key);
  } else if (const auto* read = std::get_if<Read>(&step)) {
    auto* range = into->mutable_request_range();
    if (read->prefix)
      set_prefix(read->key, range->mutable_key(), range->mutable_range_end());
    else
      range->set_key(read->key);
  }
}

directory::KeyValue entry_of(const etcdserverpb::KeyValue& entry) {
  return {entry.key(), entry.value(), entry.create_revision(), entry.mod_revision(), entry.lease()};
}

}  // namespace

TxnRequest to_etcd(const Transaction& transaction) {
  TxnRequest out;
  for (const Condition& condition : transaction.conditions) {
    Compare* compare = out.add_compare();
    compare->set_key(condition.key);
    if (condition.of == Condition::Of::kCreated) {
      compare->set_target(Compare::CREATE);
      compare->set_create_revision(condition.equals);
    } else if (condition.of == Condition::Of::kModified) {
      compare->set_target(Compare::MOD);
      compare->set_mod_revision(condition.equals);
    } else {
      compare->set_target(Compare::LEASE);
      compare->set_lease(condition.equals);
    }
  }
  for (const Step& step : transaction.then) add_step(step, out.add_success());
  for (const Step& step : transaction.otherwise) add_step(step, out.add_failure());
  return out;
}

WatchRequest to_etcd(const directory::Watch& watch) {
  WatchRequest out;
  auto* create = out.mutable_create_request();
  set_prefix(watch.prefix, create->mutable_key(), create->mutable_range_end());
  create->set_start_revision(watch.from);
  return out;
}

Outcome outcome_of(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::OK:
      return Outcome::kDone;
    case grpc::StatusCode::NOT_FOUND:
      return Outcome::kNoLease;
    case grpc::StatusCode::OUT_OF_RANGE:
      return status.error_message().find("compacted") != std::string::npos ? Outcome::kCompacted : Outcome::kRefused;
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::PERMISSION_DENIED:
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::FAILED_PRECONDITION:
    case grpc::StatusCode::UNIMPLEMENTED:
      return Outcome::kRefused;
    default:
      return Outcome::kUnknown;
  }
}

Reply failed(OperationId operation, const grpc::Status& status) {
  Reply reply;
  reply.operation = operation;
  reply.outcome = outcome_of(status);
  const bool late = status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED;
  reply.reason = late ? "no answer in time" : status.error_message();
  // etcd itself gives this code too, with its own words, while it has no leader.
  reply.unreachable = status.error_code() == grpc::StatusCode::UNAVAILABLE && !reply.reason.starts_with("etcdserver:");
  return reply;
}

Reply from_header(OperationId operation, const ResponseHeader& header) {
  Reply reply;
  reply.operation = operation;
  reply.revision = header.revision();
  reply.term = header.raft_term();
  return reply;
}

Reply from_etcd(OperationId operation, const TxnResponse& answer) {
  Reply reply = from_header(operation, answer.header());
  reply.held = answer.succeeded();
  for (const ResponseOp& op : answer.responses()) {
    if (!op.has_response_range()) continue;
    auto& found = reply.found.emplace_back();
    for (const auto& entry : op.response_range().kvs()) found.push_back(entry_of(entry));
  }
  return reply;
}

Reply from_etcd(OperationId operation, const LeaseGrantResponse& answer) {
  Reply reply = from_header(operation, answer.header());
  reply.lease = answer.id();
  reply.ttl = std::chrono::seconds(answer.ttl());
  return reply;
}

Reply from_etcd(OperationId operation, const LeaseKeepAliveResponse& answer) {
  Reply reply = from_header(operation, answer.header());
  reply.ttl = std::chrono::seconds(answer.ttl());
  // etcd says so of a lease that it does not have.
  if (answer.ttl() <= 0) reply.outcome = Outcome::kNoLease;
  return reply;
}

Reply from_etcd(OperationId operation, const LeaseTimeToLiveResponse& answer) {
  Reply reply = from_header(operation, answer.header());
  reply.ttl = std::chrono::seconds(answer.ttl());
  if (answer.ttl() < 0) {  // etcd says so of a lease that it does not have
    reply.outcome = Outcome::kNoLease;
    reply.ttl = {};
  }
  return reply;
}

Reply from_etcd(OperationId operation, const WatchResponse& answer) {
  Reply reply = from_header(operation, answer.header());
  if (answer.canceled()) {
    reply.outcome = answer.compact_revision() > 0 ? Outcome::kCompacted : Outcome::kUnknown;
    reply.reason = answer.cancel_reason();
  }
  for (const WatchEvent& event : answer.events())
    reply.changes.push_back({entry_of(event.kv()), event.type() == WatchEvent::DELETE});
  return reply;
}

}  // namespace tandem::directory
