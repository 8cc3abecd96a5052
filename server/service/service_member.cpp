#include "server/service/service_member.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

using directory::Notice;
using directory::OperationId;
using directory::Outcome;
using directory::Reply;
using directory::Request;

namespace {

/// First number of this class's own operations; those of Ownership count from 1.
constexpr OperationId kOwnOperations = OperationId{1} << 62;
constexpr Duration kWritePause = std::chrono::milliseconds(50);  // 32 values each: 256 sessions, twice a second
constexpr Duration kStandbyPause = std::chrono::seconds(2);      // between two attempts to name a standby

}  // namespace

ServiceMember::ServiceMember(ServiceMemberOptions options, directory::Directory& store)
    : options_(std::move(options)),
      store_(store),
      names_(options_.prefix),
      keys_(options_.prefix),
      ownership_(options_.server, "", options_.times, names_),
      catalogue_(keys_),
      tickets_(ownership_, names_),
      writer_(names_, keys_.writes(options_.server), kWritePause),
      registry_(options_.prefix, options_.agreed, options_.registry_mark),
      loss_(options_.prefix, options_.times.ttl, options_.agreed),
      placement_(options_.key),
      planner_(options_.key),
      newest_(kOwnOperations) {
  begin_configured();
}

void ServiceMember::begin_configured() {
  for (const auto& [session, spec] : options_.configured) to_begin_.insert(session);
}

void ServiceMember::describe(const directory::ServerRecord& record) {
  record_ = record;
  record_.epoch_base = loss_.epoch_base();
  ownership_.describe(directory::to_text(record_));
}

void ServiceMember::begin(OperationId operation, const Request& request) {
  loss_.on_begin(operation, request);
  store_.begin(operation, request);
}

void ServiceMember::note(const Reply& reply, Time now) {
  if (reply.outcome == Outcome::kUnknown || reply.outcome == Outcome::kRefused) {
    ++unanswered_;
    if (!reply.reason.empty()) trouble_ = reply.reason;
  } else {
    answered_ = now;
    trouble_.clear();
  }
}

void ServiceMember::step(Time now) {
  now_ = now;
  while (const auto reply = store_.poll()) {
    note(*reply, now);
    if (loss_.went_back(*reply)) on_directory_lost(now);
    if (const auto found = loss_.on_reply(now, *reply); found != DirectoryLoss::Found::kNothing) {
      if (found == DirectoryLoss::Found::kOther) on_directory_lost(now);
      continue;
    }
    if (reply->operation < kOwnOperations) {
      ownership_.on_reply(now, *reply);
    } else if (reply->operation == revoking_) {
      left_ = reply->outcome == Outcome::kDone || reply->outcome == Outcome::kNoLease;
      revoking_ = 0;
    } else if (!catalogue_.on_reply(*reply) && !tickets_.on_reply(*reply) && !writer_.on_reply(*reply) &&
               !registry_.on_reply(*reply)) {
      on_session_reply(now, *reply);
    }
  }
  if (leaving_) {
    if (ownership_.keeper().lease() == 0) left_ = true;
    if (!left_ && revoking_ == 0) begin(revoking_ = ++newest_, directory::Revoke{ownership_.keeper().lease()});
    return;
  }
  take_notices(now);
  follow_losses(now);
  if (!to_begin_.empty()) claim_configured(now);
  begin_moves();
  balance(now);
  advance_sessions(now);
  const Duration retry = 2 * options_.times.answer_limit;
  if (const auto request = loss_.poll_request(now, newest_ + 1, retry, registry_.agreed())) begin(++newest_, *request);
  if (const auto request = catalogue_.poll_request(now, newest_ + 1, retry)) begin(++newest_, *request);
  if (const auto request = tickets_.poll_request(now, newest_ + 1, retry)) begin(++newest_, *request);
  if (const auto request = writer_.poll_request(now, newest_ + 1, retry)) begin(++newest_, *request);
  if (const auto request = registry_.poll_request(now, newest_ + 1, retry)) begin(++newest_, *request);
  ownership_.hold_claims(!loss_.kept_may_begin(now));
  while (const auto operation = ownership_.poll_operation(now)) begin(operation->id, operation->request);
  take_notices(now);
}

bool ServiceMember::calm() const noexcept {
  const auto is_open = [](const auto& entry) { return entry.second.phase == Phase::kOpen; };
  return !leaving_ && !writer_.waits() && std::ranges::all_of(entries_, is_open);
}

void ServiceMember::take_notices(Time now) {
  while (const auto notice = ownership_.poll_notice()) {
    switch (notice->kind) {
      case Notice::Kind::kOwned:
        on_owned(notice->session, notice->revision);
        break;
      case Notice::Kind::kElsewhere:
        on_elsewhere(notice->session, notice->other);
        break;
      case Notice::Kind::kLost:
        on_lost(notice->session);
        break;
      case Notice::Kind::kReleased:
        entries_.erase(notice->session);
        break;
      case Notice::Kind::kLeased:
        name_taken_ = false;
        break;
      case Notice::Kind::kNameTaken:
        name_taken_ = true;
        break;
      case Notice::Kind::kStandbyRefused:
        if (const auto found = entries_.find(notice->session); found != entries_.end()) {
          found->second.next_standby = now + kStandbyPause;
          if (found->second.phase == Phase::kMoving) found->second.phase = Phase::kLoading;  // opened here again
        }
        break;
      case Notice::Kind::kLeaseLost:  // a kLost of each session follows
        loss_.doubt();
        break;
      case Notice::Kind::kStandbySet:
        break;
      case Notice::Kind::kTicketAccepted:
      case Notice::Kind::kTicketRefused:
        tickets_.on_notice(*notice);
        break;
    }
  }
}

/// The server that runs first begins the sessions of the configuration. The others wait until they have seen that, as
/// it may end before a session has begun.
void ServiceMember::claim_configured(Time now) {
  if (!loss_.all_may_begin(now) || !ownership_.keeper().registered() || !ownership_.view().follows() ||
      !catalogue_.follows())
    return;
  std::erase_if(to_begin_, [&](const std::string& session) {
    if (entries_.contains(session)) return false;
    const auto* const seen = ownership_.view().session(session);
    if (seen != nullptr && (seen->owner || seen->standby)) return catalogue_.find(session) != nullptr;
    if (!ownership_.claim(session)) return false;
    Entry entry;
    entry.spec = based(options_.configured.at(session));
    entry.first = true;
    entries_[session] = std::move(entry);
    return false;
  });
}

void ServiceMember::on_owned(const std::string& session, directory::Revision revision) {
  Entry& entry = entries_[session];  // a standby's claim made none
  entry.revision = revision;
  entry.operation = 0;
  entry.next_attempt = {};
  entry.phase = entry.fresh ? Phase::kWriting : Phase::kLoading;
}

void ServiceMember::on_elsewhere(const std::string& session, const std::string& other) {
  const auto found = entries_.find(session);
  if (found == entries_.end()) return;
  refuse(found->second, session, "a session " + session + " exists already, on server " + other);
  entries_.erase(found);
}

void ServiceMember::on_lost(const std::string& session) {
  ownership_.forget(session);
  writer_.drop(session);
  const auto found = entries_.find(session);
  if (found == entries_.end()) return;
  Entry& entry = found->second;
  refuse(entry, session, "this server has lost the session to another one");
  keep(session, entry);
  if (entry.phase != Phase::kOpening && entry.phase != Phase::kOpen) {
    if (entry.phase != Phase::kLosing) entries_.erase(found);
    return;
  }
  entry.phase = Phase::kLosing;
  events_.push_back({.kind = ServiceEvent::Kind::kGiveUp, .session = session, .revision = entry.revision});
}

void ServiceMember::refuse(Entry& entry, const std::string& session, std::string why) {
  if (entry.order == 0) return;
  events_.push_back({.kind = ServiceEvent::Kind::kRefused,
                     .session = session,
                     .order = std::exchange(entry.order, 0),
                     .text = std::move(why)});
}

void ServiceMember::want(const std::string& session) {
  if (!loss_.all_may_begin(now_) || entries_.contains(session) || leaving_ || record_.drains) return;
  if (const auto refused = refused_until_.find(session); refused != refused_until_.end()) {
    if (now_ < refused->second) return;
    refused_until_.erase(refused);
  }
  if (!ownership_.keeper().registered() || !ownership_.claim(session)) return;
  entries_[session] = {};
}

bool ServiceMember::create(Time now, const std::string& session, ServiceSession spec, std::uint64_t order) {
  Entry entry;
  entry.order = order;
  if (loss_.waits(now)) {
    refuse(entry, session, "the directory of the service was begun from nothing; try again in some seconds");
    return true;
  }
  if (entries_.contains(session) || leaving_ || !ownership_.claim(session)) return false;
  entry.spec = based(std::move(spec));
  entry.fresh = true;
  entry.order_ends = now + kCreationLimit;
  entries_[session] = std::move(entry);
  return true;
}

void ServiceMember::on_opened(const std::string& session) {
  const auto found = entries_.find(session);
  if (found == entries_.end() || found->second.phase != Phase::kOpening) return;
  found->second.phase = Phase::kOpen;
  found->second.opened = now_;
}

void ServiceMember::on_open_failed(Time now, const std::string& session) {
  const auto found = entries_.find(session);
  refused_until_[session] = now + kRefusalPause;
  if (found == entries_.end()) return;
  if (found->second.phase == Phase::kLosing)
    entries_.erase(found);
  else if (found->second.phase == Phase::kOpening)
    release(now, session);
}

void ServiceMember::on_given_up(const std::string& session) {
  const auto found = entries_.find(session);
  if (found != entries_.end() && found->second.phase == Phase::kLosing) entries_.erase(found);
}

void ServiceMember::release(Time now, const std::string& session) {
  writer_.drop(session);
  if (ownership_.release(now, session))
    entries_[session].phase = Phase::kReleasing;
  else
    entries_.erase(session);
}

void ServiceMember::end(const std::string& session) {
  const auto found = entries_.find(session);
  if (found == entries_.end() || found->second.phase != Phase::kOpen) return;
  writer_.drop(session);
  found->second.phase = Phase::kEnding;
  found->second.operation = 0;
  found->second.next_attempt = {};
}

void ServiceMember::replace(const std::string& session, ServiceSession spec) {
  const auto found = entries_.find(session);
  if (found == entries_.end() || found->second.phase != Phase::kOpen) return;
  writer_.drop(session);
  found->second.phase = Phase::kWriting;
  found->second.spec = std::move(spec);
  found->second.snapshot.clear();
  found->second.consoles.clear();
  found->second.operation = 0;
  found->second.next_attempt = {};
}

void ServiceMember::leave() { leaving_ = true; }

}  // namespace tandem::server
