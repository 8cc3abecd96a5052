#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "server/directory/directory_loss.h"
#include "server/service/member_sessions.h"
#include "server/service/service_directory.h"
#include "server/service/session_beginnings.h"

namespace tandem::server {

/// Where a session is.
struct SessionPlace {
  enum class Kind : std::uint8_t {
    kNone,       ///< the service has no such session
    kHere,       ///< this server serves it
    kElsewhere,  ///< `server` serves it
    kComing,     ///< a server is about to own it
    kUnknown,    ///< the directory does not answer
  };
  Kind kind = Kind::kNone;
  std::string session, server;
  std::optional<directory::ServerRecord> record{};  ///< kElsewhere
  std::int64_t revision = 0;                        ///< kElsewhere: of its ownership, with the epoch_base
};

/// Tells where the sessions of a service are, as one of its servers knows it. Changes nothing.
class SessionPlaces {
 public:
  /// @param directory, sessions, beginnings, loss  must outlive this
  SessionPlaces(const ServiceDirectory& directory, const MemberSessions& sessions, const SessionBeginnings& beginnings,
                const directory::DirectoryLoss& loss)
      : directory_(directory), sessions_(sessions), beginnings_(beginnings), loss_(loss) {}

  /// Finds a session by id, code or name; without any, the only one.
  [[nodiscard]] SessionPlace find(Time now, const rpc::SessionChoice& choice) const;
  /// No server owns the session or is its standby, as far as known.
  [[nodiscard]] bool is_free(std::string_view session) const;
  /// Sessions of the service that this server does not serve, with the names of their servers. The name is empty while
  /// no server serves the session: this one hands it over or opens it, or another one is about to.
  [[nodiscard]] std::map<std::string, std::string> away() const;

 private:
  using Kind = SessionPlace::Kind;

  [[nodiscard]] Kind kind_here(const MemberSession& own) const;
  void find_owner(SessionPlace& place) const;

  const ServiceDirectory& directory_;
  const MemberSessions& sessions_;
  const SessionBeginnings& beginnings_;
  const directory::DirectoryLoss& loss_;
};

}  // namespace tandem::server
