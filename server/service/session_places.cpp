#include "server/service/session_places.h"

#include <utility>

namespace tandem::server {

SessionPlace SessionPlaces::find(Time now, const rpc::SessionChoice& choice) const {
  SessionPlace place;
  place.session = directory_.catalogue.name_of(choice);
  if (place.session.empty()) {
    const bool recovers = loss_.waits(now);
    if (recovers) place.session = beginnings_.kept_name(choice);
    const bool all_known = directory_.known() && directory_.follows() && !recovers;
    place.kind = !place.session.empty() ? Kind::kComing : all_known ? Kind::kNone : Kind::kUnknown;
    return place;
  }
  const auto own = sessions_.entries().find(place.session);
  if (own != sessions_.entries().end())
    place.kind = kind_here(own->second.session);
  else
    find_owner(place);
  return place;
}

SessionPlace::Kind SessionPlaces::kind_here(const MemberSession& own) const {
  if (own.is_open()) return Kind::kHere;
  return own.ends() ? Kind::kNone : Kind::kComing;
}

void SessionPlaces::find_owner(SessionPlace& place) const {
  const directory::DirectoryView& view = directory_.ownership.view();
  place.kind = Kind::kComing;
  const auto* const seen = view.session(place.session);
  if (seen == nullptr || !seen->owner) {
    if (!directory_.ready()) place.kind = Kind::kUnknown;
    return;
  }
  place.server = seen->owner->name;
  const ServiceSession* const spec = directory_.catalogue.find(place.session);
  place.revision = seen->owner->created + (spec != nullptr ? spec->epoch_base : 0);
  const auto* const server = view.server(place.server);
  if (server != nullptr && place.server != directory_.server())
    place.record = directory::parse_server_record(server->text);
  if (place.record) place.kind = Kind::kElsewhere;
}

bool SessionPlaces::is_free(std::string_view session) const {
  const auto* const seen = directory_.ownership.view().session(session);
  return seen == nullptr || (!seen->owner && !seen->standby);
}

std::map<std::string, std::string> SessionPlaces::away() const {
  std::map<std::string, std::string> away;
  for (const auto& [session, seen] : directory_.catalogue.entries()) {
    if (!seen.spec) continue;
    const auto own = sessions_.entries().find(session);
    if (own != sessions_.entries().end() && (own->second.session.is_open() || own->second.session.ends())) continue;
    std::string owner = directory_.owner_of(session);
    if (owner == directory_.server()) owner.clear();
    away.emplace(session, std::move(owner));
  }
  return away;
}

}  // namespace tandem::server
