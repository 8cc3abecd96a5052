#include "proto/rpc/session_list_text.h"

#include <algorithm>

#include "common/base/format.h"

namespace tandem {
namespace {

std::size_t taken_of(const rpc::ListedSession& s) {
  return static_cast<std::size_t>(std::ranges::count(s.seats, true, &rpc::ListedSeat::taken));
}

std::string hex(const rpc::Id& id) {
  std::string text;
  for (const std::byte b : id) text += format("%02x", std::to_integer<unsigned>(b));
  return text;
}

std::string role_of(const rpc::ListedSeat& seat) { return std::string(to_text(seat.role)); }

}  // namespace

std::string session_list_text(const rpc::SessionList& list, const std::vector<std::string>& codes) {
  if (list.sessions.empty())
    return list.old ? "no session is known: this server serves none, and does not reach the directory of its service; "
                      "ask again in some seconds, or another server of the service\n"
                    : "no session is open\n";
  std::string text;
  for (std::size_t i = 0; i < list.sessions.size(); ++i) {
    const rpc::ListedSession& s = list.sessions[i];
    const std::size_t taken = taken_of(s);
    text += format("%s: %s, %zu of %zu seats free", s.name.c_str(), rpc::to_text(s.phase), s.seats.size() - taken,
                   s.seats.size());
    text += i < codes.size() ? (codes[i].empty() ? ", tickets only" : ", code " + codes[i]) : "";
    text += ", id " + hex(s.id) + (s.server.empty() ? "" : ", server " + s.server) + "\n";
    for (const rpc::ListedSeat& seat : s.seats)
      text += format("  %-16s %-10s %s%s\n", seat.name.c_str(), role_of(seat).c_str(), seat.taken ? "taken" : "free",
                     seat.required ? "" : ", optional");
  }
  if (list.old)
    text +=
        "sessions of other servers may have changed, and running ones may be held: the server does not reach the "
        "service's directory\n";
  if (list.more) text += "and more, which do not fit into one answer\n";
  return text;
}

std::string session_list_json(const rpc::SessionList& list, const std::vector<std::string>& codes) {
  // Names consist of A-Z a-z 0-9 _ -, so nothing needs escaping.
  std::string text = "{\"sessions\": [";
  for (std::size_t i = 0; i < list.sessions.size(); ++i) {
    const rpc::ListedSession& s = list.sessions[i];
    const std::size_t taken = taken_of(s);
    text += (i == 0 ? "\n  {" : ",\n  {") + std::string("\"id\": \"") + hex(s.id) + "\", \"name\": \"" + s.name +
            "\", \"phase\": \"" + rpc::to_text(s.phase) + "\"";
    if (!s.server.empty()) text += ", \"server\": \"" + s.server + "\"";
    if (i < codes.size()) text += ", \"code\": " + (codes[i].empty() ? "null" : "\"" + codes[i] + "\"");
    text += format(", \"seats_free\": %zu, \"seats_taken\": %zu, \"seats\": [", s.seats.size() - taken, taken);
    for (std::size_t k = 0; k < s.seats.size(); ++k) {
      const rpc::ListedSeat& seat = s.seats[k];
      text += (k == 0 ? "{" : ", {") + std::string("\"name\": \"") + seat.name + "\", \"role\": \"" + role_of(seat) +
              "\", \"taken\": " + (seat.taken ? "true" : "false") +
              ", \"required\": " + (seat.required ? "true" : "false") + "}";
    }
    text += "]}";
  }
  return text + "], \"more\": " + (list.more ? "true" : "false") + (list.old ? ", \"old\": true" : "") + "}\n";
}

}  // namespace tandem
