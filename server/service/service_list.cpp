#include "server/service/service_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/auth/base32.h"
#include "common/auth/key_fingerprint.h"
#include "common/base/format.h"
#include "common/base/hex.h"
#include "proto/rpc/rpc_limits.h"

namespace tandem::server {

namespace {

using ListJson = nlohmann::json;

constexpr std::size_t kSeatTextsMax = std::size_t{4} << 20;  // [bytes]
constexpr std::int64_t kAnsweredMaxS = 4'000'000'000;
constexpr std::array kKnownWords{"nothing", "old", "now"};  // by ServiceList::Known

ListJson json_of(const std::vector<rpc::ListedSeat>& seats) {
  ListJson out = ListJson::array();
  for (const rpc::ListedSeat& seat : seats)
    out.push_back({{"name", seat.name}, {"role", std::string(to_text(seat.role))}, {"required", seat.required}});
  return out;
}

std::string text_at(const ListJson& in, const char* key, std::size_t longest) {
  const auto found = in.find(key);
  if (found == in.end() || !found->is_string()) return {};
  auto text = found->get<std::string>();
  return text.size() <= longest ? text : std::string{};
}

std::optional<rpc::ListedSeat> seat_from(const ListJson& in) {
  if (!in.is_object()) return std::nullopt;
  const auto role = access_role_named(text_at(in, "role", rpc::kNameMax));
  rpc::ListedSeat seat{.name = text_at(in, "name", rpc::kNameMax)};
  const auto required = in.find("required");
  if (!role || seat.name.empty() || required == in.end() || !required->is_boolean()) return std::nullopt;
  seat.role = *role;
  seat.required = required->get<bool>();
  return seat;
}

std::optional<ServiceList::Session> session_from(const ListJson& in) {
  constexpr std::size_t kWordMax = 64;
  if (!in.is_object()) return std::nullopt;
  ServiceList::Session session;
  session.listed.name = text_at(in, "name", kWordMax);
  session.code = text_at(in, "code", kWordMax);
  session.listed.server = text_at(in, "server", kWordMax);
  session.phase = rpc::session_phase_named(text_at(in, "phase", kWordMax));
  const auto seats = in.find("seats");
  if (session.listed.name.empty() || !auth::from_hex(text_at(in, "id", kWordMax), session.listed.id))
    return std::nullopt;
  if (seats == in.end() || !seats->is_array() || seats->size() > rpc::kListedSeatsMax) return std::nullopt;
  for (const ListJson& entry : *seats) {
    auto seat = seat_from(entry);
    if (!seat) return std::nullopt;
    session.listed.seats.push_back(std::move(*seat));
  }
  return session;
}

ListJson json_of(const ServiceList& list) {
  ListJson sessions = ListJson::array();
  std::size_t seat_bytes = 0;
  for (const ServiceList::Session& session : list.sessions) {
    ListJson seats = json_of(session.listed.seats);
    seat_bytes += seats.dump(-1, ' ', false, ListJson::error_handler_t::replace).size();
    if (seat_bytes > kSeatTextsMax) seats = ListJson::array();
    sessions.push_back({{"id", to_hex(session.listed.id)},
                        {"name", session.listed.name},
                        {"code", session.code},
                        {"server", session.listed.server},
                        {"seats", std::move(seats)}});
    if (session.phase) sessions.back()["phase"] = rpc::to_text(*session.phase);
  }
  return {{"directory", kKnownWords[static_cast<std::size_t>(list.known)]}, {"sessions", std::move(sessions)}};
}

std::string dumped_list(const ListJson& json) { return json.dump(-1, ' ', false, ListJson::error_handler_t::replace); }

/// Time since the newest answer of the directory [s].
double silence_of(const ServiceList& list, Time now) {
  return list.answered ? std::max(0.0, seconds(now - *list.answered)) : 0;
}

/// The phase of a session, and whether it is of before the directory fell silent. A server whose directory is silent
/// too holds all its sessions, and can tell none of the others.
std::string phase_words(const ServiceList::Session& session, ServiceList::Known known) {
  if (!session.phase) return {};
  return (known == ServiceList::Known::kOld ? "was " : "") + std::string(rpc::to_text(*session.phase)) + ", ";
}

}  // namespace

std::string to_text(const ServiceList& list) {
  ListJson out = json_of(list);
  if (list.answered) out["answered_s"] = static_cast<std::int64_t>(seconds(*list.answered));
  return dumped_list(out) + "\n";
}

std::string service_json(const ServiceList& others, Time now) {
  ListJson out = json_of(others);
  if (others.answered) out["silent_s"] = std::round(silence_of(others, now));
  return dumped_list(out);
}

std::string service_text(const ServiceList& others, Time now) {
  std::string text;
  if (others.known == ServiceList::Known::kNothing)
    return "the directory of the service has not answered this server yet: sessions of other servers are not known\n";
  if (!others.sessions.empty()) text = "other sessions of the service:\n";
  for (const ServiceList::Session& session : others.sessions) {
    const rpc::ListedSession& listed = session.listed;
    text += listed.name + ": " + phase_words(session, others.known) +
            (session.code.empty() ? "tickets only" : "code " + auth::grouped(session.code, 5)) + ", id " +
            to_hex(listed.id) +
            (listed.server.empty() ? ", no server now: one serves it when a client asks for it"
                                   : ", server " + listed.server) +
            "\n";
  }
  if (others.sessions.empty()) text = "the service has no other session\n";
  if (others.known == ServiceList::Known::kOld)
    text += "these may have changed, and running ones may be held: the directory of the service does not answer now" +
            (others.answered ? format(" (last answer %.0f s ago)", silence_of(others, now)) : std::string{}) + "\n";
  return text;
}

std::optional<ServiceList> parse_service_list(std::string_view text) {
  if (text.size() > kServiceListMax) return std::nullopt;
  const ListJson in = ListJson::parse(text, nullptr, false);
  if (!in.is_object()) return std::nullopt;
  const auto known = std::ranges::find(kKnownWords, text_at(in, "directory", rpc::kNameMax));
  const auto sessions = in.find("sessions");
  if (known == kKnownWords.end() || sessions == in.end() || !sessions->is_array()) return std::nullopt;
  ServiceList list{.known = static_cast<ServiceList::Known>(known - kKnownWords.begin()), .sessions = {}};
  if (const auto answered = in.find("answered_s"); answered != in.end()) {
    if (!answered->is_number_integer()) return std::nullopt;
    const auto at = answered->get<std::int64_t>();
    if (at < 0 || at > kAnsweredMaxS) return std::nullopt;
    list.answered = Time{std::chrono::seconds(at)};
  }
  for (const ListJson& entry : *sessions) {
    auto session = session_from(entry);
    if (!session) return std::nullopt;
    list.sessions.push_back(std::move(*session));
  }
  return list;
}

bool ServiceListReader::look_at_directory(const ServiceMember& member, Time now) {
  const ServiceStatus status = member.status(now);
  const auto known = status.current                                ? ServiceList::Known::kNow
                     : member.directory().catalogue.readings() > 0 ? ServiceList::Known::kOld
                                                                   : ServiceList::Known::kNothing;
  // In whole seconds, and only while it is old: the file of a list that is current does not change.
  std::optional<Time> answered;
  if (known == ServiceList::Known::kOld && status.answered)
    answered = Time{std::chrono::floor<std::chrono::seconds>(status.answered->time_since_epoch())};
  const bool changed = known != known_ || answered != answered_;
  known_ = known;
  answered_ = answered;
  return changed;
}

bool ServiceListReader::look(const ServiceMember& member, Time now) {
  bool changed = look_at_directory(member, now);
  std::erase_if(seen_, [&](const auto& session) {
    const bool gone = member.directory().catalogue.find(session.first) == nullptr;
    changed = changed || gone;
    return gone;
  });
  for (const auto& [name, entry] : member.directory().catalogue.entries()) {
    if (!entry.spec) continue;
    std::string server = member.directory().owner_of(name);
    Seen& seen = seen_[name];
    if (seen.id == entry.spec->id && seen.server == server && seen.listed_text == entry.listed_text &&
        seen.code == entry.spec->code)
      continue;
    seen = {entry.spec->id, entry.spec->code, std::move(server), entry.listed_text};
    changed = true;
  }
  return changed;
}

const ServiceList& ServiceListReader::list() {
  list_ = {.known = known_, .sessions = {}, .answered = answered_};
  std::erase_if(parsed_, [this](const auto& parsed) { return !seen_.contains(parsed.first); });
  for (const auto& [name, seen] : seen_) {
    Parsed& parsed = parsed_[name];
    if (parsed.text != seen.listed_text) {
      rpc::ListedSession listed;
      parsed.text = seen.listed_text;
      const bool readable = read_listed(seen.listed_text, listed);
      parsed.seats = readable ? std::move(listed.seats) : std::vector<rpc::ListedSeat>{};
      parsed.phase = readable ? std::optional(listed.phase) : std::nullopt;
      for (rpc::ListedSeat& seat : parsed.seats) seat.taken = false;  // it changes too often for a file
    }
    // Without a server, the phase is that of the last one.
    list_.sessions.push_back(
        {{seen.id, name, {}, parsed.seats, seen.server}, seen.code, seen.server.empty() ? std::nullopt : parsed.phase});
  }
  return list_;
}

}  // namespace tandem::server
