// Reads and writes of a server until a session is open, and when it ends.
#include <algorithm>
#include <utility>

#include "server/service/service_member.h"

namespace tandem::server {

using directory::Condition;
using directory::Erase;
using directory::Outcome;
using directory::Put;
using directory::Read;
using directory::Reply;
using directory::Request;
using directory::Transaction;

namespace {

constexpr Duration kAgain = std::chrono::milliseconds(50);

const std::string* found_text(const Reply& reply, std::size_t n) {
  return n < reply.found.size() && !reply.found[n].empty() ? &reply.found[n][0].value : nullptr;
}

}  // namespace

std::optional<Request> ServiceMember::request_of(const std::string& session, const Entry& entry) const {
  const Condition owned{names_.owner(session), Condition::Of::kCreated, entry.revision};
  const std::string spec = keys_.spec(session);
  switch (entry.phase) {
    case Phase::kLoading:
      return Transaction{{owned}, {Read{spec}, Read{keys_.snapshot(session)}, Read{keys_.consoles(session)}}, {}};
    case Phase::kWriting: {
      Transaction write{{owned},
                        {Put{spec, to_text(*entry.spec), 0}, Erase{keys_.listed(session)}},
                        {Read{spec}, Read{names_.owner(session)}}};
      const auto put = [&](const std::string& key, const std::string& value) {
        write.then.push_back(value.empty() ? directory::Step{Erase{key}} : Put{key, value, 0});
      };
      put(keys_.snapshot(session), entry.snapshot);
      put(keys_.consoles(session), entry.consoles);
      if (entry.fresh) write.conditions.push_back({spec, Condition::Of::kCreated, 0});
      return write;
    }
    case Phase::kEnding:
      return Transaction{{owned},
                         {Erase{spec}, Erase{keys_.listed(session)}, Erase{keys_.move(session)},
                          Erase{keys_.home(session)}, Erase{keys_.snapshot(session)}, Erase{keys_.consoles(session)}},
                         {}};
    default:
      return std::nullopt;
  }
}

void ServiceMember::advance_sessions(Time now) {
  std::vector<std::string> abandoned;
  for (auto& [session, entry] : entries_) {
    if (entry.order != 0 && entry.phase != Phase::kOpening && now >= entry.order_ends) {
      refuse(entry, session, "the directory of the service does not answer");
      abandoned.push_back(session);
      continue;
    }
    if (entry.phase == Phase::kOpen) choose_standby(now, session, entry);
    if (entry.phase == Phase::kMoving) advance_move(session, entry);
    if (entry.operation != 0 && now - entry.sent >= 2 * options_.times.answer_limit) entry.operation = 0;
    if (entry.operation != 0 || now < entry.next_attempt) continue;
    if (const auto request = request_of(session, entry)) {
      entry.operation = ++newest_;
      entry.sent = now;
      begin(entry.operation, *request);
    }
  }
  for (const std::string& session : abandoned) {
    Entry& entry = entries_[session];
    if (entry.phase != Phase::kWriting) {
      entries_.erase(session);  // a later success of the claim finds no spec and ends it
    } else {
      entry.phase = Phase::kLoading;
      entry.abandoned = true;
      entry.operation = 0;
    }
  }
}

void ServiceMember::on_session_reply(Time now, const Reply& reply) {
  const auto found =
      std::ranges::find_if(entries_, [&](const auto& e) { return e.second.operation == reply.operation; });
  if (found == entries_.end()) return;
  const std::string session = found->first;
  Entry& entry = found->second;
  entry.operation = 0;
  if (reply.outcome != Outcome::kDone) {
    entry.next_attempt = now + kAgain;
    return;
  }
  switch (entry.phase) {
    case Phase::kLoading:
      if (reply.held) return on_loaded(now, session, entry, reply);
      entry.next_attempt = now + kAgain;  // not ours any more: the ownership reports it
      return;
    case Phase::kWriting:
      return on_written(now, session, entry, reply);
    case Phase::kEnding:
      if (reply.held) return release(now, session);
      entry.next_attempt = now + kAgain;
      return;
    default:
      return;
  }
}

void ServiceMember::on_loaded(Time now, const std::string& session, Entry& entry, const Reply& reply) {
  const std::string* const spec_text = found_text(reply, 0);
  if (entry.abandoned) {
    // The write whose answer is missing made the spec, or found one that belongs to the session without owner.
    const bool ours = spec_text != nullptr && *spec_text == to_text(*entry.spec);
    if (!ours) return release(now, session);
    entry.phase = Phase::kEnding;
    return;
  }
  if (entry.kept) {
    entry.phase = Phase::kWriting;
    return;
  }
  const std::string *const snapshot = found_text(reply, 1), *const consoles = found_text(reply, 2);
  auto spec = spec_text != nullptr ? parse_service_session(*spec_text) : std::nullopt;
  const bool changed = entry.first && spec && entry.spec &&
                       (spec->scene != entry.spec->scene || spec->duration_s != entry.spec->duration_s ||
                        spec->tickets_only != entry.spec->tickets_only || spec->restart != entry.spec->restart);
  if (spec && !changed) {
    ServiceSession wanted = based(*spec);
    entry.snapshot = snapshot != nullptr ? *snapshot : "";
    entry.consoles = consoles != nullptr ? *consoles : "";
    if (wanted == *spec) return open(session, entry, std::move(*spec), entry.snapshot, entry.consoles);
    entry.spec = std::move(wanted);
    entry.phase = Phase::kWriting;
    return;
  }
  if (spec && entry.spec) entry.spec->epoch_base = std::max(entry.spec->epoch_base, spec->epoch_base);
  // A configured session without owner begins; any other without a spec has ended.
  entry.phase = entry.spec ? Phase::kWriting : Phase::kEnding;
}

void ServiceMember::on_written(Time now, const std::string& session, Entry& entry, const Reply& reply) {
  if (reply.held) return open(session, entry, *entry.spec, entry.snapshot, entry.consoles);
  const std::string* const written = found_text(reply, 0);
  if (written != nullptr && entry.spec && *written == to_text(*entry.spec))  // by a write whose answer was lost
    return open(session, entry, *entry.spec, entry.snapshot, entry.consoles);
  if (written != nullptr && entry.fresh) {
    refuse(entry, session, "a session " + session + " exists already, and no server serves it now");
    return release(now, session);
  }
  entry.next_attempt = now + kAgain;
}

void ServiceMember::open(const std::string& session, Entry& entry, ServiceSession spec, std::string snapshot,
                         std::string consoles) {
  entry.phase = Phase::kOpening;
  to_begin_.erase(session);
  loss_.on_base(spec.epoch_base);
  entry.served = spec;
  entry.snapshot = snapshot;
  entry.consoles = consoles;
  events_.push_back({.kind = ServiceEvent::Kind::kOpen,
                     .session = session,
                     .spec = std::move(spec),
                     .snapshot = std::move(snapshot),
                     .consoles = std::move(consoles),
                     .revision = entry.revision + entry.served->epoch_base,
                     .order = std::exchange(entry.order, 0)});
  entry.spec.reset();
  entry.fresh = entry.first = entry.kept = false;
}

}  // namespace tandem::server
