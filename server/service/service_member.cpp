#include "server/service/service_member.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

using directory::DirectoryMark;
using directory::Notice;
using directory::OperationId;
using directory::Outcome;
using directory::Reply;
using directory::Request;

namespace {

/// First number of this class's own operations; those of Ownership count from 1.
constexpr OperationId kOwnOperations = OperationId{1} << 62;

}  // namespace

ServiceMember::ServiceMember(ServiceMemberOptions options, directory::Directory& store)
    : times_(options.times),
      store_(store),
      directory_(std::move(options.server), options.prefix, times_),
      mark_(SharedRegistry::mark_key(options.prefix), {options.agreed.mark, options.agreed.created},
            options.registry_mark),
      registry_(options.prefix, options.agreed.entries, options.agreed.spent, mark_),
      loss_(mark_, times_.ttl, options.agreed.revision, options.agreed.mark.empty() || options.agreed.waits),
      base_(directory_, options.agreed.epoch_base),
      sessions_(directory_, base_),
      beginnings_(std::move(options.configured), directory_, sessions_, loss_),
      moves_(directory_, sessions_, options.key, options.balance),
      places_(directory_, sessions_, beginnings_, loss_),
      newest_(kOwnOperations) {}

void ServiceMember::describe(const directory::ServerRecord& record) {
  record_ = record;
  record_.epoch_base = base_.value();
  directory_.ownership.describe(directory::to_text(record_));
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
  take_replies(now);
  if (leaving_) return revoke_lease();
  take_notices(now);
  if (marks_lost_ != mark_.losses()) on_directory_lost(now);
  beginnings_.step(now, record_.drains);
  moves_.step(now, record_);
  // Also while this server drains: its clients would find no other one for them.
  for (const std::string& session : moves_.poll_given_back(now))
    if (loss_.all_may_begin(now)) sessions_.want(session);
  begin_requests(now);
  take_notices(now);
}

void ServiceMember::take_replies(Time now) {
  while (const auto reply = store_.poll()) {
    note(*reply, now);
    if (loss_.went_back(*reply)) on_directory_lost(now);
    if (const auto found = loss_.on_reply(now, *reply); found != DirectoryMark::Found::kNothing) {
      if (found == DirectoryMark::Found::kOther) on_directory_lost(now);
      continue;
    }
    if (reply->operation < kOwnOperations) {
      directory_.ownership.on_reply(now, *reply);
    } else if (reply->operation == revoking_) {
      left_ = reply->outcome == Outcome::kDone || reply->outcome == Outcome::kNoLease;
      revoking_ = 0;
    } else if (!directory_.on_reply(*reply) && !registry_.on_reply(*reply)) {
      const std::string opened = sessions_.on_reply(now, *reply);
      if (!opened.empty()) beginnings_.on_open(opened);
    }
  }
}

void ServiceMember::revoke_lease() {
  const directory::LeaseId lease = directory_.ownership.keeper().lease();
  if (lease == 0) left_ = true;
  if (!left_ && revoking_ == 0) begin(revoking_ = ++newest_, directory::Revoke{lease});
}

void ServiceMember::begin_requests(Time now) {
  const Duration retry = 2 * times_.answer_limit;
  sessions_.step(now, retry, [this](const Request& request) {
    begin(++newest_, request);
    return newest_;
  });
  const auto begin_own = [this](const std::optional<Request>& request) {
    if (request) begin(++newest_, *request);
  };
  begin_own(mark_.poll_request(now, newest_ + 1, retry));
  begin_own(directory_.catalogue.poll_request(now, newest_ + 1, retry));
  begin_own(directory_.tickets.poll_request(now, newest_ + 1, retry));
  begin_own(directory_.writer.poll_request(now, newest_ + 1, retry));
  begin_own(registry_.poll_request(now, newest_ + 1, retry));
  directory_.ownership.hold_claims(!loss_.kept_may_begin(now));
  while (const auto operation = directory_.ownership.poll_operation(now)) begin(operation->id, operation->request);
}

bool ServiceMember::calm() const noexcept {
  return !leaving_ && !directory_.writer.waits() && sessions_.open() == sessions_.entries().size();
}

void ServiceMember::take_notices(Time now) {
  while (const auto notice = directory_.ownership.poll_notice()) {
    const std::string& session = notice->session;
    switch (notice->kind) {
      case Notice::Kind::kOwned:
        sessions_.on_owned(session, notice->revision);
        break;
      case Notice::Kind::kElsewhere:
        sessions_.on_elsewhere(session, notice->other);
        break;
      case Notice::Kind::kLost:
        if (sessions_.contains(session)) mark_.doubt();
        if (auto run = sessions_.on_lost(session)) beginnings_.keep(session, std::move(*run));
        break;
      case Notice::Kind::kReleased:
        moves_.on_released(now, session);
        sessions_.on_released(session);
        break;
      case Notice::Kind::kLeased:
        name_taken_ = false;
        break;
      case Notice::Kind::kNameTaken:
        name_taken_ = true;
        break;
      case Notice::Kind::kStandbyRefused:
        moves_.on_standby_refused(now, session, notice->other);
        break;
      case Notice::Kind::kLeaseLost:  // a kLost of each session follows
        mark_.doubt();
        break;
      case Notice::Kind::kStandbySet:
        break;
      case Notice::Kind::kTicketAccepted:
      case Notice::Kind::kTicketRefused:
      case Notice::Kind::kTicketUnanswered:
      case Notice::Kind::kTicketNoLease:
        directory_.tickets.on_notice(*notice);
        break;
    }
  }
}

/// Everything that this server knows of the directory is of the lost one, its ownerships too.
void ServiceMember::on_directory_lost(Time now) {
  directory_.ownership.begin_again();
  take_notices(now);
  base_.learn();
  base_.raise();
  loss_.on_loss(now);
  describe(record_);
  if (!mark_.known().text.empty()) registry_.begin_again();
  marks_lost_ = mark_.losses();
  registry_.read_again();
  directory_.catalogue.read_again();
  directory_.tickets.forget_leases();
  sessions_.on_directory_lost();
  beginnings_.begin_configured();
}

void ServiceMember::want(const std::string& session) {
  if (loss_.all_may_begin(now_) && !leaving_ && !record_.drains) sessions_.want(session);
}

bool ServiceMember::create(Time now, const std::string& session, ServiceSession spec, std::uint64_t order) {
  if (loss_.waits(now)) {
    sessions_.refuse_as_lost(session, order);
    return true;
  }
  return !leaving_ && sessions_.create(now, session, std::move(spec), order);
}

void ServiceMember::end(const std::string& session) {
  beginnings_.replace_kept(session, std::nullopt);
  sessions_.end(session);
}

void ServiceMember::replace(const std::string& session, const ServiceSession& spec) {
  beginnings_.replace_kept(session, spec);
  sessions_.replace(session, spec);
}

bool ServiceMember::ends(const std::string& session) const {
  const auto phase = sessions_.phase(session);
  return phase && (*phase == MemberSession::Phase::kEnding || *phase == MemberSession::Phase::kWriting ||
                   *phase == MemberSession::Phase::kLosing);
}

SessionPlace ServiceMember::locate(const rpc::SessionChoice& choice) {
  SessionPlace place = places_.find(now_, choice);
  if (place.kind == SessionPlace::Kind::kComing && places_.is_free(place.session)) want(place.session);
  return place;
}

std::string ServiceMember::storage_problem() const {
  const std::string& problem = directory_.writer.problem();
  if (problem.empty()) return {};
  return "the directory of the service does not store it: " + problem +
         "; check that etcd runs and has space (`etcdctl alarm list`), hands are released while it is silent";
}

bool ServiceMember::all_written() const {
  const auto pending = [this](const auto& entry) {
    const MemberSession::Phase phase = entry.second.session.phase();
    return phase == MemberSession::Phase::kEnding || phase == MemberSession::Phase::kWriting ||
           directory_.writer.pending(entry.first);
  };
  return !directory_.tickets.restoring() && std::ranges::none_of(sessions_.entries(), pending);
}

RegistryAgreement ServiceMember::agreement(Time now) const {
  RegistryAgreement agreed = registry_.agreed();
  agreed.revision = loss_.newest();
  agreed.epoch_base = base_.value();
  agreed.waits = loss_.waits_for_leases(now);
  return agreed;
}

ServiceStatus ServiceMember::status(Time now) const {
  const directory::LeaseKeeper& keeper = directory_.ownership.keeper();
  ServiceStatus status;
  status.registered = keeper.registered();
  status.name_taken = name_taken_ && !status.registered;
  status.follows = directory_.follows();
  status.answers = answered_ && now - *answered_ < 2 * times_.answer_limit;
  status.current = status.follows && answered_ && now - *answered_ <= times_.renew_every * 3 / 2;
  status.answered = answered_;
  status.holding = now >= keeper.hold_at();
  status.trouble = trouble_;
  if (keeper.lease() != 0) status.lease_age_s = seconds(now - keeper.hold_at() + times_.hold_after);
  status.owned = sessions_.open();
  status.members = directory_.ownership.view().servers().size();
  status.sessions = directory_.catalogue.entries().size();
  status.unanswered = unanswered_;
  status.moves = moves_.begun();
  status.losses = loss_.losses();
  status.recovers = loss_.waits(now);
  status.stranger = loss_.losses() == 0 && loss_.known() && !loss_.kept_may_begin(now);
  status.writes = directory_.writer.counters();
  return status;
}

}  // namespace tandem::server
