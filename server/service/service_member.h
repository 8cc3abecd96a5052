#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "server/directory/directory_loss.h"
#include "server/directory/directory_mark.h"
#include "server/directory/placement/server_record.h"
#include "server/service/epoch_base.h"
#include "server/service/member_sessions.h"
#include "server/service/service_directory.h"
#include "server/service/service_status.h"
#include "server/service/session_beginnings.h"
#include "server/service/session_moves.h"
#include "server/service/session_places.h"
#include "server/service/shared_registry.h"

namespace tandem::server {

/// Options of a member, validated.
struct ServiceMemberOptions {
  std::string server;  ///< name of this server
  std::string prefix = "/tandem/v1/";
  directory::LeaseTimes times{};
  RandomKey key{0};  ///< for the draws of placement
  /// Sessions of the configuration, with the id and code that they get if this server begins them.
  std::map<std::string, ServiceSession> configured{};
  RegistryAgreement agreed{};   ///< of the registry, from before a restart
  std::string registry_mark{};  ///< random, for a directory without one
  bool balance = true;          ///< sessions move to less used servers by themselves
};

/// One server's part of a service: which sessions it serves, from which state, and where the others are. It runs the
/// ownership protocol over a directory. Pure: no clock, socket or thread; times are of CLOCK_BOOTTIME.
///
/// This class carries requests, replies and notices between the directory and the parts of the member, which have the
/// rules: MemberSessions, SessionBeginnings, SessionMoves, SessionPlaces, SharedRegistry and ServiceTickets. It decides
/// itself when the directory is another one (with DirectoryLoss), and when the server leaves its service.
class ServiceMember {
 public:
  /// @param store  must outlive this
  /// @pre `options.times.problem()` is empty, and all names are valid
  ServiceMember(ServiceMemberOptions options, directory::Directory& store);

  /// Takes replies, begins operations. Call it at least each 50 ms, and each 20 ms unless `calm`.
  void step(Time now);
  /// No session begins, moves or ends, and no value waits for its write.
  [[nodiscard]] bool calm() const noexcept;

  /// Sets what this server publishes about itself; its name is that of the options.
  void describe(const directory::ServerRecord& record);
  /// Asks for a session that no server owns. Without effect if this server cannot serve it now.
  void want(const std::string& session);
  /// Creates a session whose name is free in the service. kOpen or kRefused follows.
  /// @return false: this server knows a session of this name, or too many
  [[nodiscard]] bool create(Time now, const std::string& session, ServiceSession spec, std::uint64_t order);
  /// A run that this server served is over, and the session with it: nothing of it stays in the directory.
  void end(const std::string& session);
  /// The same, and its next run replaces it. kOpen follows.
  void replace(const std::string& session, const ServiceSession& spec);
  /// The end of a run is not in the directory yet.
  [[nodiscard]] bool ends(const std::string& session) const;
  /// It has no session, nor the state of one that a lost directory does not have, and none may come back.
  [[nodiscard]] bool empty() const noexcept {
    return sessions_.empty() && !beginnings_.keeps() && !moves_.may_come_back();
  }
  /// Finds a session by id, code or name; without any, the only one. Asks for it if no server owns it.
  [[nodiscard]] SessionPlace locate(const rpc::SessionChoice& choice);
  /// Ends the lease and with it all ownerships, so that other servers begin at once. No session may have effort.
  /// The member does nothing afterwards but this.
  void leave() { leaving_ = true; }
  /// The store has answered to `leave`.
  [[nodiscard]] bool left() const noexcept { return left_; }

  /// Returns the mark of a snapshot that the directory has now, each once.
  [[nodiscard]] std::optional<std::uint64_t> poll_stored() { return directory_.writer.poll_written(); }
  /// Why snapshots do not reach the directory, with the remedy; empty: they do.
  [[nodiscard]] std::string storage_problem() const;
  /// Whether all snapshots and consoles that were set, all restored tickets, and the ends of runs are in the directory,
  /// or will never be.
  [[nodiscard]] bool all_written() const;

  /// Sessions of this server, and orders about them.
  [[nodiscard]] MemberSessions& sessions() noexcept { return sessions_; }
  [[nodiscard]] const MemberSessions& sessions() const noexcept { return sessions_; }
  [[nodiscard]] SessionMoves& moves() noexcept { return moves_; }
  [[nodiscard]] const SessionPlaces& places() const noexcept { return places_; }
  [[nodiscard]] const ServiceDirectory& directory() const noexcept { return directory_; }
  /// Uses of tickets for sessions of this server.
  [[nodiscard]] ServiceTickets& tickets() noexcept { return directory_.tickets; }
  /// Workstations and codes of the service.
  [[nodiscard]] SharedRegistry& registry() noexcept { return registry_; }

  [[nodiscard]] ServiceStatus status(Time now) const;
  /// By what the directory is known after a restart.
  [[nodiscard]] RegistryAgreement agreement(Time now) const;
  /// Time from which no hand of any session of this server may be engaged.
  [[nodiscard]] Time act_until() const noexcept { return directory_.ownership.keeper().hold_at(); }
  /// The same for the sessions that this server serves now; nullopt until it has given up each one that it has lost:
  /// hands of that session must not act by the time of a newer lease.
  [[nodiscard]] std::optional<Time> served_until() const noexcept {
    return sessions_.loses() ? std::nullopt : std::optional(act_until());
  }

 private:
  void take_replies(Time now);
  void note(const directory::Reply& reply, Time now);
  void take_notices(Time now);
  void revoke_lease();
  void begin_requests(Time now);
  void on_directory_lost(Time now);
  void begin(directory::OperationId operation, const directory::Request& request);

  directory::LeaseTimes times_;
  directory::Directory& store_;
  ServiceDirectory directory_;
  directory::DirectoryMark mark_;
  SharedRegistry registry_;
  directory::DirectoryLoss loss_;
  EpochBase base_;
  MemberSessions sessions_;
  SessionBeginnings beginnings_;
  SessionMoves moves_;
  SessionPlaces places_;
  directory::ServerRecord record_;
  std::uint64_t marks_lost_ = 0;  ///< of which this class knows
  directory::OperationId newest_;
  bool leaving_ = false, left_ = false, name_taken_ = false;
  directory::OperationId revoking_ = 0;
  Time now_{};  ///< of the newest step
  std::optional<Time> answered_;
  std::string trouble_;
  std::uint64_t unanswered_ = 0;
};

}  // namespace tandem::server
