#include "server/service/member_sessions.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tandem::server {

namespace {

constexpr const char* kLostText = "the directory of the service has lost its data; try again in some seconds";

}  // namespace

std::optional<ServiceEvent> MemberSessions::poll_event() {
  if (events_.empty()) return std::nullopt;
  ServiceEvent event = std::move(events_.front());
  events_.pop_front();
  return event;
}

std::optional<MemberSession::Phase> MemberSessions::phase(std::string_view session) const {
  const auto found = entries_.find(session);
  return found == entries_.end() ? std::nullopt : std::optional(found->second.session.phase());
}

std::size_t MemberSessions::open() const noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(entries_, [](const auto& entry) { return entry.second.session.is_open(); }));
}

MemberSession* MemberSessions::in(Phase phase, const std::string& session) {
  const auto found = entries_.find(session);
  return found == entries_.end() || found->second.session.phase() != phase ? nullptr : &found->second.session;
}

MemberSession* MemberSessions::served(const std::string& session) {
  const auto found = entries_.find(session);
  if (found == entries_.end()) return nullptr;
  Entry& entry = found->second;
  const bool moves = entry.session.phase() == Phase::kMoving && !entry.move.handed_over;
  return entry.session.is_open() || moves ? &entry.session : nullptr;
}

void MemberSessions::refuse(const std::string& session, Entry& entry, std::string why) {
  if (entry.order == 0) return;
  events_.push_back({.kind = ServiceEvent::Kind::kRefused,
                     .session = session,
                     .order = std::exchange(entry.order, 0),
                     .text = std::move(why)});
}

void MemberSessions::refuse_as_lost(const std::string& session, std::uint64_t order) {
  Entry refused{.session = MemberSession(session), .order = order};
  refuse(session, refused, kLostText);
}

bool MemberSessions::refused(const std::string& session) const {
  const auto found = refused_until_.find(session);
  return found != refused_until_.end() && now_ < found->second;
}

void MemberSessions::want(const std::string& session) {
  if (entries_.contains(session) || refused(session)) return;
  if (!directory_.ownership.keeper().registered() || !directory_.ownership.claim(session)) return;
  entries_.insert_or_assign(session, Entry{.session = MemberSession(session)});
}

bool MemberSessions::claim(const std::string& session, MemberSession::Origin origin, MemberSession::Run from) {
  if (!directory_.ownership.claim(session)) return false;
  from.spec = base_.on(std::move(from.spec));
  entries_.insert_or_assign(session, Entry{.session = MemberSession(session, origin, std::move(from))});
  return true;
}

bool MemberSessions::create(Time now, const std::string& session, ServiceSession spec, std::uint64_t order) {
  if (entries_.contains(session) || !claim(session, MemberSession::Origin::kCreated, {.spec = std::move(spec)}))
    return false;
  Entry& entry = entries_.find(session)->second;
  entry.order = order;
  entry.order_ends = now + kCreationLimit;
  return true;
}

void MemberSessions::on_opened(const std::string& session) {
  const auto found = entries_.find(session);
  if (found == entries_.end() || found->second.session.phase() != Phase::kOpening) return;
  found->second.session.set_phase(Phase::kOpen);
  found->second.opened = now_;
}

void MemberSessions::on_open_failed(Time now, const std::string& session) {
  refused_until_[session] = now + kRefusalPause;
  const auto before = phase(session);
  if (before == Phase::kLosing)
    entries_.erase(session);
  else if (before == Phase::kOpening)
    release(now, session);
}

void MemberSessions::on_given_up(const std::string& session) {
  --given_up_;
  if (phase(session) == Phase::kLosing) entries_.erase(session);
}

void MemberSessions::release(Time now, const std::string& session) {
  directory_.writer.drop(session);
  if (directory_.ownership.release(now, session))
    entries_.find(session)->second.session.set_phase(Phase::kReleasing);
  else
    entries_.erase(session);
}

void MemberSessions::end(const std::string& session) {
  MemberSession* const over = served(session);
  if (over == nullptr) return;
  directory_.writer.drop(session);
  over->end();
}

void MemberSessions::replace(const std::string& session, ServiceSession spec) {
  MemberSession* const over = served(session);
  if (over == nullptr) return;
  directory_.writer.drop(session);
  over->replace(std::move(spec));
}

void MemberSessions::set_snapshot(const std::string& session, std::string bytes, std::uint64_t mark, bool order) {
  const std::string key = directory_.keys.snapshot(session);
  if (const auto found = entries_.find(session); found != entries_.end() && found->second.session.has_state()) {
    found->second.session.set_snapshot(bytes);
    directory_.writer.set(session, key, std::move(bytes), found->second.session.revision(), mark);
  }
  if (order) directory_.writer.hurry(key);
}

void MemberSessions::set_consoles(const std::string& session, std::string text) {
  const auto found = entries_.find(session);
  if (found == entries_.end() || !found->second.session.has_state()) return;
  found->second.session.set_consoles(text);
  directory_.writer.set(session, directory_.keys.consoles(session), std::move(text), found->second.session.revision());
}

void MemberSessions::set_listed(const std::string& session, std::string text) {
  const MemberSession* const open = in(Phase::kOpen, session);
  if (open != nullptr)
    directory_.writer.set(session, directory_.keys.listed(session), std::move(text), open->revision());
}

void MemberSessions::hand_over(const std::string& session, Entry& entry, std::string why, bool waits) {
  entry.session.set_phase(Phase::kMoving);
  events_.push_back({.kind = ServiceEvent::Kind::kHandOver,
                     .session = session,
                     .revision = entry.session.revision(),
                     .text = std::move(why),
                     .waits = waits});
}

void MemberSessions::on_owned(const std::string& session, directory::Revision revision) {
  // A standby's claim made no entry.
  entries_.try_emplace(session, Entry{.session = MemberSession(session)}).first->second.session.on_owned(revision);
}

void MemberSessions::on_elsewhere(const std::string& session, const std::string& other) {
  const auto found = entries_.find(session);
  if (found == entries_.end()) return;
  refuse(session, found->second, "a session " + session + " exists already, on server " + other);
  entries_.erase(found);
}

std::optional<MemberSession::Run> MemberSessions::on_lost(const std::string& session) {
  directory_.ownership.forget(session);
  directory_.writer.drop(session);
  const auto found = entries_.find(session);
  if (found == entries_.end()) return std::nullopt;
  Entry& entry = found->second;
  refuse(session, entry, "this server has lost the session to another one");
  auto run = entry.session.take_run();
  const Phase before = entry.session.phase();
  if (before == Phase::kOpening || before == Phase::kOpen || (before == Phase::kMoving && !entry.move.handed_over)) {
    entry.session.set_phase(Phase::kLosing);
    events_.push_back({.kind = ServiceEvent::Kind::kGiveUp, .session = session, .revision = entry.session.revision()});
    ++given_up_;
  } else if (before != Phase::kLosing) {
    entries_.erase(found);
  }
  return run;
}

void MemberSessions::on_directory_lost() {
  for (auto at = entries_.begin(); at != entries_.end();) {
    auto& [session, entry] = *at;
    if (entry.session.phase() == Phase::kLosing) {
      ++at;
      continue;
    }
    refuse(session, entry, kLostText);  // a claim, or a session that was being written or erased: it has no run here
    at = entries_.erase(at);
  }
  refused_until_.clear();
}

void MemberSessions::step(Time now, Duration retry_after, const BeginRequest& begin) {
  now_ = now;
  std::vector<std::string> abandoned;
  for (auto& [session, entry] : entries_) {
    if (entry.order != 0 && entry.session.phase() != Phase::kOpening && now >= entry.order_ends) {
      refuse(session, entry, "the directory of the service does not answer");
      abandoned.push_back(session);
      continue;
    }
    if (const auto request = entry.session.poll_request(now, retry_after, directory_))
      entry.session.begun(now, begin(*request));
  }
  for (const std::string& session : abandoned) {
    MemberSession* const writing = in(Phase::kWriting, session);
    if (writing != nullptr)
      writing->abandon();
    else
      entries_.erase(session);  // a later success of the claim finds no spec and ends it
  }
}

std::string MemberSessions::on_reply(Time now, const directory::Reply& reply) {
  const auto found =
      std::ranges::find_if(entries_, [&](const auto& e) { return e.second.session.waits_for(reply.operation); });
  if (found == entries_.end()) return {};
  std::string session = found->first;
  Entry& entry = found->second;
  switch (entry.session.on_reply(now, reply, base_)) {
    case MemberSession::Next::kNothing:
      return {};
    case MemberSession::Next::kOpen:
      report_open(session, entry);
      return session;
    case MemberSession::Next::kTaken:
      refuse(session, entry, "a session " + session + " exists already, and no server serves it now");
      release(now, session);
      return {};
    case MemberSession::Next::kUnreadable:
      refused_until_[session] = now + kRefusalPause;
      events_.push_back({.kind = ServiceEvent::Kind::kUnreadable, .session = session});
      [[fallthrough]];
    case MemberSession::Next::kRelease:
      release(now, session);
      return {};
  }
  return {};
}

void MemberSessions::report_open(const std::string& session, Entry& entry) {
  MemberSession::Run run = entry.session.run();
  const std::int64_t revision = entry.session.revision() + run.spec.epoch_base;
  events_.push_back({.kind = ServiceEvent::Kind::kOpen,
                     .session = session,
                     .spec = std::move(run.spec),
                     .snapshot = std::move(run.snapshot),
                     .consoles = std::move(run.consoles),
                     .revision = revision,
                     .order = std::exchange(entry.order, 0)});
}

}  // namespace tandem::server
