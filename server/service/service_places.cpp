// Where the sessions of a service are, and who takes over from whom.
#include <algorithm>

#include "server/service/service_member.h"

namespace tandem::server {

namespace {

constexpr Duration kStandbyCheck = std::chrono::seconds(1);

}  // namespace

std::optional<ServiceEvent> ServiceMember::poll_event() {
  if (events_.empty()) return std::nullopt;
  ServiceEvent event = std::move(events_.front());
  events_.pop_front();
  return event;
}

std::map<std::string, directory::ServerRecord> ServiceMember::members() const {
  std::map<std::string, directory::ServerRecord> members;
  for (const auto& [name, server] : ownership_.view().servers())
    if (auto record = directory::parse_server_record(server.text)) members.emplace(name, std::move(*record));
  return members;
}

std::string ServiceMember::owner_of(std::string_view session) const {
  const auto* const seen = ownership_.view().session(session);
  return seen != nullptr && seen->owner ? seen->owner->name : "";
}

SessionPlace ServiceMember::locate(const rpc::SessionChoice& choice) {
  SessionPlace place;
  place.session = catalogue_.name_of(choice);
  const bool known = ownership_.view().readings() > 0 && catalogue_.readings() > 0;
  const bool follows = ownership_.view().follows() && catalogue_.follows();
  const bool recovers = loss_.waits(now_);
  if (place.session.empty()) {
    if (recovers) place.session = kept_name(choice);
    if (!place.session.empty()) {
      place.kind = SessionPlace::Kind::kComing;
      return place;
    }
    place.kind = known && follows && !recovers ? SessionPlace::Kind::kNone : SessionPlace::Kind::kUnknown;
    return place;
  }
  if (const auto own = entries_.find(place.session); own != entries_.end()) {
    const bool ends = own->second.phase == Phase::kEnding || own->second.phase == Phase::kReleasing;
    place.kind = own->second.phase == Phase::kOpen ? SessionPlace::Kind::kHere
                 : ends                            ? SessionPlace::Kind::kNone
                                                   : SessionPlace::Kind::kComing;
    return place;
  }
  place.kind = SessionPlace::Kind::kComing;
  const auto* const seen = ownership_.view().session(place.session);
  if (seen != nullptr && seen->owner) {
    place.server = seen->owner->name;
    const ServiceSession* const spec = catalogue_.find(place.session);
    place.revision = seen->owner->created + (spec != nullptr ? spec->epoch_base : 0);
    const auto* const server = ownership_.view().server(place.server);
    if (server != nullptr && place.server != options_.server)
      place.record = directory::parse_server_record(server->text);
    if (place.record) place.kind = SessionPlace::Kind::kElsewhere;
    return place;
  }
  if (!follows || !ownership_.keeper().registered()) {
    place.kind = SessionPlace::Kind::kUnknown;
  } else if (seen == nullptr || !seen->standby) {
    want(place.session);
  }
  return place;
}

std::map<std::string, std::string> ServiceMember::away() const {
  std::map<std::string, std::string> away;
  for (const auto& [session, seen] : catalogue_.entries()) {
    if (!seen.spec) continue;
    const auto own = entries_.find(session);
    if (own != entries_.end() && (own->second.phase == Phase::kOpen || own->second.phase == Phase::kEnding ||
                                  own->second.phase == Phase::kReleasing))
      continue;
    std::string owner = owner_of(session);
    if (owner == options_.server) owner.clear();
    away.emplace(session, std::move(owner));
  }
  return away;
}

std::vector<directory::Candidate> ServiceMember::candidates() const {
  std::vector<directory::Candidate> candidates;
  for (const auto& [name, published] : members()) {
    const directory::ServerRecord& record = name == options_.server ? record_ : published;
    candidates.push_back({name, record.zone, record.capacity, record.used, record.drains, record.expected});
  }
  return candidates;
}

void ServiceMember::choose_standby(Time now, const std::string& session, Entry& entry) {
  if (now < entry.next_standby) return;
  entry.next_standby = now + kStandbyCheck;
  const auto* const seen = ownership_.view().session(session);
  if (seen == nullptr || !seen->owner || seen->standby) return;
  std::size_t open = 0;
  for (const auto& [name, other] : entries_) open += other.phase == Phase::kOpen ? 1 : 0;
  const double cost = record_.used / static_cast<double>(std::max<std::size_t>(open, 1));
  if (const auto chosen = placement_.place_standby(candidates(), cost, options_.server))
    static_cast<void>(ownership_.set_standby(session, *chosen));
}

void ServiceMember::set_snapshot(const std::string& session, std::string bytes, std::uint64_t mark, bool order) {
  set_state(session, keys_.snapshot(session), std::move(bytes), mark);
  if (order) writer_.hurry(keys_.snapshot(session));
}

std::string ServiceMember::storage_problem() const {
  if (writer_.problem().empty()) return {};
  return "the directory of the service does not store it: " + writer_.problem() +
         "; check that etcd runs and has space, hands are released while it is silent";
}

void ServiceMember::set_consoles(const std::string& session, std::string text) {
  set_state(session, keys_.consoles(session), std::move(text));
}

void ServiceMember::set_state(const std::string& session, const std::string& key, std::string value,
                              std::uint64_t mark) {
  const auto found = entries_.find(session);
  if (found == entries_.end()) return;
  const Phase phase = found->second.phase;
  if (phase != Phase::kOpen && phase != Phase::kOpening && phase != Phase::kMoving) return;
  (key == keys_.consoles(session) ? found->second.consoles : found->second.snapshot) = value;
  writer_.set(session, key, std::move(value), found->second.revision, mark);
}

void ServiceMember::set_listed(const std::string& session, std::string text) {
  const auto found = entries_.find(session);
  if (found == entries_.end() || found->second.phase != Phase::kOpen) return;
  writer_.set(session, keys_.listed(session), std::move(text), found->second.revision);
}

bool ServiceMember::all_written() const {
  return !tickets_.restoring() &&
         std::ranges::none_of(entries_, [&](const auto& entry) { return writer_.pending(entry.first); });
}

RegistryAgreement ServiceMember::agreement(Time now) const {
  RegistryAgreement agreed = registry_.agreed();
  agreed.revision = loss_.newest();
  agreed.epoch_base = loss_.epoch_base();
  agreed.waits = loss_.waits_for_leases(now);
  return agreed;
}

ServiceStatus ServiceMember::status(Time now) const {
  const directory::LeaseKeeper& keeper = ownership_.keeper();
  ServiceStatus status;
  status.registered = keeper.registered();
  status.name_taken = name_taken_ && !status.registered;
  status.follows = ownership_.view().follows() && catalogue_.follows();
  status.answers = answered_ && now - *answered_ < 2 * options_.times.answer_limit;
  status.current = status.follows && answered_ && now - *answered_ <= options_.times.renew_every * 3 / 2;
  status.answered = answered_;
  status.holding = now >= keeper.hold_at();
  status.trouble = trouble_;
  if (keeper.lease() != 0) status.lease_age_s = seconds(now - keeper.hold_at() + options_.times.hold_after);
  status.owned = static_cast<std::size_t>(
      std::ranges::count_if(entries_, [](const auto& entry) { return entry.second.phase == Phase::kOpen; }));
  status.members = ownership_.view().servers().size();
  status.sessions = catalogue_.entries().size();
  status.unanswered = unanswered_;
  status.moves = moves_;
  status.losses = loss_.losses();
  status.recovers = loss_.waits(now);
  status.stranger = loss_.losses() == 0 && loss_.known() && !loss_.kept_may_begin(now);
  status.writes = writer_.counters();
  return status;
}

}  // namespace tandem::server
