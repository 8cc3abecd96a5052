#include "server/directory/ownership.h"

#include <algorithm>

namespace tandem::directory {

namespace {

/// Returns the entry that the n-th Read of a reply found, or an empty one.
KeyValue found_at(const Reply& reply, std::size_t n) {
  return n < reply.found.size() && !reply.found[n].empty() ? reply.found[n][0] : KeyValue{};
}

}  // namespace

Ownership::Ownership(std::string server, std::string text, LeaseTimes times, DirectoryKeys keys)
    : server_(std::move(server)),
      times_(times),
      keys_(std::move(keys)),
      keeper_(server_, std::move(text), times, keys_),
      view_(keys_) {}

std::optional<Ownership::Operation> Ownership::poll_operation(Time now) {
  follow_view();
  expire_requests(now);
  begin_releases(now);
  const OperationId id = newest_operation_ + 1;
  const auto begin = [&](std::optional<Request> request) -> std::optional<Operation> {
    if (!request) return std::nullopt;
    newest_operation_ = id;
    return Operation{id, std::move(*request)};
  };
  if (auto operation = begin(keeper_.poll_request(now, id))) return operation;
  if (auto operation = begin(view_.poll_request(now, id, times_.answer_limit))) return operation;
  if (!keeper_.registered()) return std::nullopt;
  for (std::size_t n = waiting_.size(); n > 0; --n) {
    Work work = std::move(waiting_.front());
    waiting_.pop_front();
    if (work.begin > now || (claims_held_ && work.kind == Work::Kind::kClaim)) {
      waiting_.push_back(std::move(work));
      continue;
    }
    work.sent = now;
    work.lease = keeper_.lease();
    if (auto request = request_of(work)) {
      sent_.emplace(id, std::move(work));
      return begin(std::move(request));
    }
  }
  return std::nullopt;
}

std::optional<Request> Ownership::claim_request(Work& work) const {
  const auto entry = entries_.find(work.session);
  if (entry == entries_.end() || entry->second.phase != Phase::kClaiming) return std::nullopt;
  const DirectoryView::SessionEntry* seen = view_.session(work.session);
  // The store's own answer counts for more than the view, which may be old.
  if (!work.as_standby) work.as_standby = seen && seen->standby && seen->standby->lease == work.lease;
  const bool standby = *work.as_standby;
  return Transaction{{{keys_.owner(work.session), Condition::Of::kCreated, 0},
                      {keys_.standby(work.session), Condition::Of::kLease, standby ? work.lease : 0}},
                     {Put{keys_.owner(work.session), server_, work.lease}, Erase{keys_.standby(work.session)}},
                     {Read{keys_.owner(work.session)}, Read{keys_.standby(work.session)}}};
}

std::optional<Request> Ownership::request_of(Work& work) {
  if (work.kind == Work::Kind::kClaim) return claim_request(work);
  const auto found = entries_.find(work.session);
  Entry* entry = found == entries_.end() ? nullptr : &found->second;
  const bool of_former = entry && work.kind == Work::Kind::kStandby && work.revision != entry->revision;
  const bool fits =
      entry && !of_former && entry->phase == (work.kind == Work::Kind::kRelease ? Phase::kReleasing : Phase::kOwned);
  if (!fits) {
    if (work.kind == Work::Kind::kTicket) {
      --tickets_;
      notify(Notice::Kind::kTicketUnanswered, work.session, work.other);
    }
    return std::nullopt;
  }
  work.revision = entry->revision;
  const Condition still_owner{keys_.owner(work.session), Condition::Of::kCreated, entry->revision};
  if (work.kind == Work::Kind::kRelease) {
    Transaction release{{still_owner}, {Erase{keys_.owner(work.session)}}, {}};
    if (entry->ends) release.then.push_back(Erase{keys_.standby(work.session)});
    return release;
  }
  if (work.kind == Work::Kind::kStandby) {
    work.other = entry->standby;
    const DirectoryView::ServerEntry* target = view_.server(work.other);
    if (target == nullptr) {
      entry->standby_asked = false;
      refuse_standby(work, *entry);
      return std::nullopt;
    }
    return Transaction{{still_owner},
                       {Put{keys_.standby(work.session), work.other, target->lease}},
                       {Read{keys_.owner(work.session)}}};
  }
  return Transaction{{still_owner, {keys_.ticket(work.other), Condition::Of::kModified, work.former_use}},
                     {Put{keys_.ticket(work.other), work.token, work.ticket_lease}},
                     {Read{keys_.owner(work.session)}, Read{keys_.ticket(work.other)}}};
}

void Ownership::on_reply(Time now, const Reply& reply) {
  if (keeper_.on_reply(now, reply)) return take_keeper_events();
  if (view_.on_reply(reply)) return follow_view();
  const auto found = sent_.find(reply.operation);
  if (found == sent_.end()) return;
  Work work = std::move(found->second);
  sent_.erase(found);
  if (reply.outcome == Outcome::kNoLease && work.kind == Work::Kind::kClaim) {
    keeper_.on_no_lease(work.lease);
    take_keeper_events();
    return again(now, std::move(work));
  }
  const Entry* ours = owned(work.session);
  const bool hurries = work.kind != Work::Kind::kStandby || (ours && ours->moves);
  if (reply.outcome == Outcome::kRefused || (reply.outcome == Outcome::kUnknown && !hurries))
    return again(now + times_.answer_limit, std::move(work));
  if (reply.outcome == Outcome::kUnknown || reply.outcome == Outcome::kCompacted) return again(now, std::move(work));
  switch (work.kind) {
    case Work::Kind::kClaim:
      return on_claim(now, std::move(work), reply);
    case Work::Kind::kStandby:
      return on_standby(now, work, reply);
    case Work::Kind::kTicket:
      return on_ticket(now, std::move(work), reply);
    case Work::Kind::kRelease:
      if (const auto entry = entries_.find(work.session);
          entry != entries_.end() && entry->second.phase == Phase::kReleasing) {
        released_[work.session] = entry->second.revision;
        entries_.erase(entry);
        notify(Notice::Kind::kReleased, work.session);
      }
  }
}

void Ownership::on_claim(Time now, Work work, const Reply& reply) {
  const auto found = entries_.find(work.session);
  if (found == entries_.end() || found->second.phase != Phase::kClaiming) return;
  if (work.lease != keeper_.lease()) return again(now, std::move(work));  // a claim under an older lease
  const KeyValue owner = found_at(reply, 0), standby = found_at(reply, 1);
  if (reply.held || owner.lease == work.lease) {
    // The second case: an earlier claim of ours succeeded, and its answer was lost.
    found->second.phase = Phase::kOwned;
    found->second.revision = reply.held ? reply.revision : owner.created;
    return notify(Notice::Kind::kOwned, work.session, {}, found->second.revision);
  }
  if (owner.created == 0 && standby.lease == work.lease && work.as_standby != true) {
    work.as_standby = true;  // the view did not know it yet
    return again(now, std::move(work));
  }
  if (owner.created == 0 && standby.created == 0) {
    work.as_standby = false;  // the standby has gone since
    return again(now, std::move(work));
  }
  entries_.erase(found);
  notify(Notice::Kind::kElsewhere, work.session, owner.created != 0 ? owner.value : standby.value, owner.created);
  // The view may have told meanwhile that the owner has gone, while this claim was under way.
  if (view_.revision() > reply.revision && given_to_us(work.session)) claim(work.session);
}

void Ownership::on_standby(Time now, const Work& work, const Reply& reply) {
  Entry* entry = owned(work.session);
  if (entry == nullptr || entry->revision != work.revision) return;
  const bool refused = reply.outcome == Outcome::kNoLease;
  if (!refused && !reply.held) return lose(work.session, *entry);
  entry->standby_asked = false;
  if (entry->standby != work.other) ask_standby(work.session, entry->standby);
  if (refused) return refuse_standby(work, *entry);
  notify(Notice::Kind::kStandbySet, work.session, work.other);
  if (entry->moves && entry->standby == work.other) ramp(now, *entry);
}

void Ownership::refuse_standby(const Work& work, Entry& entry) {
  if (entry.standby == work.other) entry.moves = false;
  notify(Notice::Kind::kStandbyRefused, work.session, work.other);
}

void Ownership::on_ticket(Time now, Work work, const Reply& reply) {
  const KeyValue use = found_at(reply, 1);
  const bool ours = found_at(reply, 0).created == work.revision;
  // An earlier attempt of ours may have succeeded while its answer was lost.
  const bool accepted = reply.held || (use.value == work.token && ours);
  if (!accepted && ours && work.use_again && use.modified != work.former_use) {
    work.former_use = use.modified;
    return again(now, std::move(work));
  }
  --tickets_;
  if (accepted)
    return notify(Notice::Kind::kTicketAccepted, work.session, work.other, reply.held ? reply.revision : use.modified);
  if (reply.outcome == Outcome::kNoLease) return notify(Notice::Kind::kTicketNoLease, work.session, work.other);
  notify(ours ? Notice::Kind::kTicketRefused : Notice::Kind::kTicketUnanswered, work.session, work.other);
}

void Ownership::again(Time now, Work work) {
  constexpr Duration kPause = std::chrono::milliseconds(50);
  work.begin = now + kPause;
  waiting_.push_back(std::move(work));
}

void Ownership::expire_requests(Time now) {
  for (auto work = sent_.begin(); work != sent_.end();) {
    if (now - work->second.sent >= times_.answer_limit) {
      waiting_.push_back(std::move(work->second));
      work = sent_.erase(work);
    } else {
      ++work;
    }
  }
}

void Ownership::ramp(Time now, Entry& entry) {
  entry.phase = Phase::kRamping;
  entry.ramped = now + times_.ramp;
  ++ramping_;
}

void Ownership::begin_releases(Time now) {
  if (ramping_ == 0) return;
  for (auto& [session, entry] : entries_) {
    if (entry.phase != Phase::kRamping || now < entry.ramped) continue;
    entry.phase = Phase::kReleasing;
    --ramping_;
    waiting_.push_back({Work::Kind::kRelease, session});
  }
}

void Ownership::take_keeper_events() {
  while (const auto event = keeper_.poll_event()) {
    if (*event == LeaseKeeper::Event::kGranted) {
      notify(Notice::Kind::kLeased);
    } else if (*event == LeaseKeeper::Event::kNameTaken) {
      notify(Notice::Kind::kNameTaken);
    } else {
      notify(Notice::Kind::kLeaseLost);
      for (auto& [session, entry] : entries_)
        if (entry.phase != Phase::kClaiming && entry.phase != Phase::kLost) lose(session, entry);
    }
  }
}

void Ownership::follow_view() {
  while (const auto session = view_.poll_changed()) {
    const DirectoryView::SessionEntry* seen = view_.session(*session);
    const auto found = entries_.find(*session);
    if (found != entries_.end() && found->second.phase != Phase::kClaiming && found->second.phase != Phase::kLost) {
      Entry& entry = found->second;
      // Older views do not have our key. One that should have it and has an older one is of a store that was put back.
      const Revision created = seen && seen->owner ? seen->owner->created : 0;
      const bool gone = created != entry.revision && view_.revision() >= entry.revision;
      if (created > entry.revision || (gone && entry.phase != Phase::kReleasing)) lose(*session, entry);
      continue;
    }
    const auto released = released_.find(*session);
    if (released != released_.end() && (!seen || !seen->owner || seen->owner->created > released->second))
      released_.erase(released);
    if (given_to_us(*session)) claim(*session);
  }
}

bool Ownership::given_to_us(const std::string& session) const {
  const DirectoryView::SessionEntry* seen = view_.session(session);
  if (seen == nullptr || keeper_.lease() == 0) return false;
  const bool takes_over = !seen->owner && seen->standby && seen->standby->lease == keeper_.lease();
  // A late copy of an earlier claim has created the key. A claim finds it and makes the session ours.
  const bool unknown_to_us = seen->owner && seen->owner->lease == keeper_.lease() && !released_.contains(session);
  return takes_over || unknown_to_us;
}

void Ownership::lose(const std::string& session, Entry& entry) {
  if (entry.phase == Phase::kRamping) --ramping_;
  entry = {};
  entry.phase = Phase::kLost;
  notify(Notice::Kind::kLost, session);
}

void Ownership::begin_again() {
  for (auto& [session, entry] : entries_)
    if (entry.phase != Phase::kClaiming && entry.phase != Phase::kLost) lose(session, entry);
  std::erase_if(entries_, [](const auto& entry) { return entry.second.phase == Phase::kClaiming; });
  released_.clear();
  view_.read_again();
}

bool Ownership::claim(const std::string& session) {
  if (!DirectoryKeys::valid_name(session)) return false;
  const auto found = entries_.find(session);
  if (found == entries_.end() && entries_.size() >= kSessionsMax) return false;
  if (found != entries_.end() && found->second.phase != Phase::kLost) return true;
  entries_[session] = {};
  waiting_.push_back({Work::Kind::kClaim, session});
  return true;
}

Ownership::Entry* Ownership::owned(const std::string& session) {
  const auto found = entries_.find(session);
  return found != entries_.end() && found->second.phase == Phase::kOwned ? &found->second : nullptr;
}

/// One request at a time: a full store stores none, and requests for all sessions would pile up.
bool Ownership::ask_standby(const std::string& session, const std::string& server) {
  Entry* entry = owned(session);
  if (entry == nullptr || server == server_ || !DirectoryKeys::valid_name(server)) return false;
  entry->standby = server;
  if (!std::exchange(entry->standby_asked, true))
    waiting_.push_back({.kind = Work::Kind::kStandby, .session = session, .revision = entry->revision});
  return true;
}

bool Ownership::set_standby(const std::string& session, const std::string& server) {
  const Entry* entry = owned(session);
  return entry != nullptr && !entry->moves && ask_standby(session, server);
}

bool Ownership::move(const std::string& session, const std::string& server) {
  if (!ask_standby(session, server)) return false;
  owned(session)->moves = true;
  return true;
}

bool Ownership::release(Time now, const std::string& session) {
  Entry* entry = owned(session);
  if (entry == nullptr) return false;
  entry->ends = true;
  ramp(now, *entry);
  return true;
}

bool Ownership::use_ticket(const std::string& session, const std::string& ticket, LeaseId lease, bool again) {
  if (owned(session) == nullptr || !DirectoryKeys::valid_name(ticket) || tickets_ >= kTicketsMax) return false;
  ++tickets_;
  Work work{Work::Kind::kTicket, session, ticket};
  // No other attempt of any server has this text: the store gives a lease id once.
  work.ticket_lease = lease;
  work.use_again = again;
  work.token = server_ + "/" + std::to_string(keeper_.lease()) + "/" + std::to_string(++attempts_);
  waiting_.push_back(std::move(work));
  return true;
}

void Ownership::forget(const std::string& session) {
  const auto found = entries_.find(session);
  if (found != entries_.end() && found->second.phase == Phase::kLost) entries_.erase(found);
}

SessionState Ownership::state(std::string_view session, Time now) const {
  const auto found = entries_.find(session);
  if (found == entries_.end()) return SessionState::kNone;
  switch (found->second.phase) {
    case Phase::kClaiming:
      return SessionState::kClaiming;
    case Phase::kOwned:
      return now < keeper_.hold_at() ? SessionState::kServing : SessionState::kHolding;
    case Phase::kRamping:
      return SessionState::kHolding;
    case Phase::kReleasing:
      return SessionState::kReleasing;
    case Phase::kLost:
      return SessionState::kLost;
  }
  return SessionState::kNone;
}

bool Ownership::may_act(std::string_view session, Time now) const {
  const auto found = entries_.find(session);
  if (found == entries_.end() || now >= keeper_.quiet_at()) return false;
  return found->second.phase == Phase::kOwned || (found->second.phase == Phase::kRamping && now < found->second.ramped);
}

Revision Ownership::revision(std::string_view session) const {
  const auto found = entries_.find(session);
  return found == entries_.end() ? 0 : found->second.revision;
}

std::vector<std::string> Ownership::sessions() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

std::optional<Notice> Ownership::poll_notice() {
  if (notices_.empty()) return std::nullopt;
  Notice notice = std::move(notices_.front());
  notices_.pop_front();
  return notice;
}

void Ownership::notify(Notice::Kind kind, const std::string& session, const std::string& other, Revision revision) {
  notices_.push_back({kind, session, other, revision});
}

}  // namespace tandem::directory
