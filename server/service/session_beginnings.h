#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "server/directory/directory_loss.h"
#include "server/service/member_sessions.h"
#include "server/service/service_directory.h"

namespace tandem::server {

/// Claims the sessions that this server begins without a request of a client: those of its configuration that the
/// service does not have, and, in a directory that was begun from nothing, those that it served before.
class SessionBeginnings {
 public:
  using Configured = std::map<std::string, ServiceSession>;

  /// @param configured  with the id and code that they get if this server begins them
  /// @param directory, sessions, loss  must outlive this
  SessionBeginnings(Configured configured, ServiceDirectory& directory, MemberSessions& sessions,
                    const directory::DirectoryLoss& loss)
      : configured_(std::move(configured)), directory_(directory), sessions_(sessions), loss_(loss) {
    begin_configured();
  }

  /// Takes the run of a session whose ownership is lost. It begins here again if the directory is lost.
  void keep(const std::string& session, MemberSession::Run run);
  /// The run that was kept is over; its next one begins in its place, or none.
  void replace_kept(const std::string& session, std::optional<ServiceSession> next);
  /// The session is being opened here: the service has it.
  void on_open(const std::string& session) { to_begin_.erase(session); }
  /// The sessions of the configuration may be missing in this directory.
  void begin_configured();
  /// @param drains  this server begins no session, but those that it has served
  void step(Time now, bool drains);
  /// It has the run of a session that may begin here again.
  [[nodiscard]] bool keeps() const noexcept { return !kept_.empty(); }
  /// Name of a session that begins here again after the loss of the directory; empty: none fits.
  [[nodiscard]] std::string kept_name(const rpc::SessionChoice& choice) const;

 private:
  void claim_kept(Time now);
  void claim_configured(Time now);

  Configured configured_;
  ServiceDirectory& directory_;
  MemberSessions& sessions_;
  const directory::DirectoryLoss& loss_;
  std::set<std::string, std::less<>> to_begin_;  ///< of the configuration, not seen in the service yet
  std::map<std::string, MemberSession::Run, std::less<>> kept_;
  std::uint64_t losses_before_ = 0;  ///< when the first one was kept
};

}  // namespace tandem::server
