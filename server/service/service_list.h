#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "server/service/service_member.h"

namespace tandem::server {

/// The sessions of a service as one of its servers knows them, for commands in the state folder of that server: they
/// issue tickets for a session wherever it is.
struct ServiceList {
  /// Answers of the directory to this server so far.
  enum class Known : std::uint8_t {
    kNothing,  ///< it has not answered since the start
    kOld,      ///< it does not answer now, or has told of changes that this server has not read yet
    kNow,      ///< its newest answer is at most one and a half periods of renewal old (ServiceStatus::current)
  };
  struct Session {
    rpc::ListedSession listed;  ///< with its server, none if it has none now; without phase; no seats: not known
    std::string code;           ///< empty: tickets only
    /// As its server has published it. A server whose sessions are HELD because it does not reach the directory cannot.
    std::optional<rpc::SessionPhase> phase{};
    friend bool operator==(const Session&, const Session&) = default;
  };
  Known known = Known::kNothing;
  std::vector<Session> sessions;   ///< of all servers, and those without a server, by name
  std::optional<Time> answered{};  ///< kOld: time of the newest answer, of CLOCK_BOOTTIME, to a second
  friend bool operator==(const ServiceList&, const ServiceList&) = default;
};

/// Longest text that is written and read [bytes]; seats beyond 4 MiB of text are left out.
inline constexpr std::size_t kServiceListMax = std::size_t{8} << 20;

/// As one text for a file, and back. Reads any bytes; nullopt: they are no such text.
[[nodiscard]] std::string to_text(const ServiceList& list);
[[nodiscard]] std::optional<ServiceList> parse_service_list(std::string_view text);

/// For users: a line per session with phase, code, id and server, or why there is none. Ends with a line break.
/// @param now  of CLOCK_BOOTTIME
[[nodiscard]] std::string service_text(const ServiceList& others, Time now);
/// As an object of JSON for machines: `directory` (now, old or nothing), `silent_s` if that is old, and `sessions`.
[[nodiscard]] std::string service_json(const ServiceList& others, Time now);

/// Makes the list of a member. Reads only the entries again that have changed.
class ServiceListReader {
 public:
  /// Takes what the member knows. @return whether `list` may have changed
  [[nodiscard]] bool look(const ServiceMember& member, Time now);
  /// Takes only whether the directory answers, and since when not, which costs less. @return whether that has changed
  [[nodiscard]] bool look_at_directory(const ServiceMember& member, Time now);
  /// The list as of the last look; takes longer than a look, and needs no member.
  [[nodiscard]] const ServiceList& list();

 private:
  struct Seen {
    rpc::Id id{};
    std::string code, server, listed_text;
  };
  struct Parsed {
    std::string text;
    std::vector<rpc::ListedSeat> seats;
    std::optional<rpc::SessionPhase> phase{};
  };
  ServiceList::Known known_ = ServiceList::Known::kNothing;
  std::optional<Time> answered_;  ///< unless the list is current
  std::map<std::string, Seen> seen_;
  std::map<std::string, Parsed> parsed_;
  ServiceList list_;
};

}  // namespace tandem::server
