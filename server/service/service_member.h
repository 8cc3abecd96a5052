#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/directory/ownership.h"
#include "server/directory/placement/move_planner.h"
#include "server/directory/placement/placement.h"
#include "server/directory/placement/server_record.h"
#include "server/service/directory_loss.h"
#include "server/service/fenced_writer.h"
#include "server/service/service_catalogue.h"
#include "server/service/service_session.h"
#include "server/service/service_tickets.h"
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

/// An order of the member to its server; orders are carried out in sequence.
struct ServiceEvent {
  enum class Kind : std::uint8_t {
    kOpen,      ///< serve the session; answer with `on_opened` or `on_open_failed`
    kGiveUp,    ///< end it here, its state stays; answer with `on_given_up`
    kHandOver,  ///< the same, because it moves, `text` says why; answer with `on_handed_over` when it is over
    kRefused,   ///< a creation is refused: `text` says why
  };
  Kind kind{};
  std::string session;
  ServiceSession spec{};      ///< kOpen
  std::string snapshot{};     ///< kOpen: bytes of `encode_snapshot`; empty: a new session
  std::string consoles{};     ///< kOpen: text of ServiceConsoles, as the former owner wrote it; empty: none
  std::int64_t revision = 0;  ///< kOpen: of the ownership, with the session's epoch_base: its epoch
  std::uint64_t order = 0;    ///< kOpen, kRefused: number of the creation; 0: none
  std::string text{};
};

/// Load of a session of this server.
struct SessionLoad {
  std::string session;
  double cost = 0;       ///< measured processor time [cores]
  double expected = 0;   ///< when all its seats are taken [cores]
  bool waiting = false;  ///< no seat is taken, and no console is joined
};

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

/// State of a member for operators.
struct ServiceStatus {
  bool registered = false;  ///< under its name, with a lease
  bool name_taken = false;  ///< another server is registered under this name
  bool follows = false;     ///< the copies of the directory follow the store
  bool answers = false;     ///< the store has answered within twice the limit of an answer
  /// The copies follow the store, and its newest answer is no older than one and a half periods of renewal: a watch
  /// alone notices the silence of the store seconds later.
  bool current = false;
  std::optional<Time> answered{};  ///< time of the store's newest answer; nullopt: none yet
  bool holding = true;             ///< no hand may be engaged
  std::string trouble;             ///< the store's newest error since its last answer
  /// Time since the sending of the newest renewal that counts [s]; nullopt: no lease.
  std::optional<double> lease_age_s{};
  std::size_t owned = 0, members = 0, sessions = 0;
  std::uint64_t unanswered = 0;  ///< requests without an answer
  std::uint64_t moves = 0;       ///< sessions that this server has begun to move to others
  std::uint64_t losses = 0;      ///< times at which the directory was begun from nothing, or put back
  bool recovers = false;         ///< after that: sessions are not claimed yet
  bool stranger = false;         ///< it does not know the directory from before, and claims no session yet
  FencedWriter::Counters writes{};
  std::int64_t voucher_ends = 0;  ///< last second of this server's voucher, since 1970, UTC; 0: unknown

  /// Sessions of this server are HELD by the directory.
  [[nodiscard]] bool held() const noexcept { return holding && owned > 0; }
};

/// One server's part of a service: which sessions it serves, from which state, and where the others are. It runs the
/// ownership protocol over a directory. Pure: no clock, socket or thread; times are of CLOCK_BOOTTIME.
///
/// - A configured session is claimed at start if no server owns it. A session without owner is claimed when a client
///   asks for it, or by its standby.
/// - An owned session is opened from its spec and its newest snapshot in the directory.
/// - A session that ends takes its keys with it: spec, snapshot, then the owner key.
/// - In a directory that was begun from nothing, a server begins its sessions again from what it has (DirectoryLoss).
class ServiceMember {
 public:
  static constexpr Duration kCreationLimit = std::chrono::seconds(4);  ///< then a creation is refused
  static constexpr Duration kRefusalPause = std::chrono::seconds(10);  ///< after a session could not be opened here

  /// @param store  must outlive this
  /// @pre `options.times.problem()` is empty, and all names are valid
  ServiceMember(ServiceMemberOptions options, directory::Directory& store);

  /// Takes replies, begins operations. Call it at least each 50 ms, and each 20 ms unless `calm`.
  void step(Time now);
  /// No session begins, moves or ends, and no value waits for its write.
  [[nodiscard]] bool calm() const noexcept;
  [[nodiscard]] std::optional<ServiceEvent> poll_event();
  [[nodiscard]] bool has_event() const noexcept { return !events_.empty(); }

  /// Sets what this server publishes about itself; its name is that of the options.
  void describe(const directory::ServerRecord& record);
  /// Sets the loads of the sessions of this server. A session moves by itself only after its load was set.
  void set_loads(const std::vector<SessionLoad>& loads);
  /// Asks for a session that no server owns. Without effect if this server cannot serve it now.
  void want(const std::string& session);
  /// Creates a session whose name is free in the service. kOpen or kRefused follows.
  /// @return false: this server knows a session of this name, or too many
  [[nodiscard]] bool create(Time now, const std::string& session, ServiceSession spec, std::uint64_t order);
  void on_opened(const std::string& session);
  void on_open_failed(Time now, const std::string& session);
  void on_given_up(const std::string& session);
  /// A session that moves is over here, and its last snapshot is published.
  void on_handed_over(const std::string& session);
  /// The session is over: erases its keys, then its ownership.
  void end(const std::string& session);
  /// Another run replaces the session under the same ownership. kOpen follows.
  void replace(const std::string& session, ServiceSession spec);
  /// @param mark   for `poll_stored` once the snapshot is in the directory; 0: none
  /// @param order  has it written before other values, without a pause
  void set_snapshot(const std::string& session, std::string bytes, std::uint64_t mark = 0, bool order = false);
  /// Returns the mark of a snapshot that the directory has now, each once.
  [[nodiscard]] std::optional<std::uint64_t> poll_stored() { return writer_.poll_written(); }
  /// Why snapshots do not reach the directory, with the remedy; empty: they do.
  [[nodiscard]] std::string storage_problem() const;
  /// Sets the text of ServiceConsoles.
  void set_consoles(const std::string& session, std::string text);
  void set_listed(const std::string& session, std::string text);
  /// Whether all snapshots and consoles that were set, and all restored tickets, are in the directory, or will never
  /// be.
  [[nodiscard]] bool all_written() const;
  /// Ends the lease and with it all ownerships, so that other servers begin at once. No session may have effort.
  /// The member does nothing afterwards but this.
  void leave();
  /// The store has answered to `leave`.
  [[nodiscard]] bool left() const noexcept { return left_; }

  /// Uses of tickets for sessions of this server.
  [[nodiscard]] ServiceTickets& tickets() noexcept { return tickets_; }

  /// Finds a session by id, code or name; without any, the only one. Asks for it if no server owns it.
  [[nodiscard]] SessionPlace locate(const rpc::SessionChoice& choice);
  /// Records of all members by name, those that cannot be read left out.
  [[nodiscard]] std::map<std::string, directory::ServerRecord> members() const;
  /// Name of a session's owner, as far as known; empty: none.
  [[nodiscard]] std::string owner_of(std::string_view session) const;
  /// Sessions of the service that this server does not serve, with the names of their servers. The name is empty while
  /// no server serves the session: this one hands it over or opens it, or another one is about to.
  [[nodiscard]] std::map<std::string, std::string> away() const;
  /// Workstations and codes of the service.
  [[nodiscard]] SharedRegistry& registry() noexcept { return registry_; }
  [[nodiscard]] const ServiceCatalogue& catalogue() const noexcept { return catalogue_; }
  [[nodiscard]] ServiceStatus status(Time now) const;
  /// By what the directory is known after a restart.
  [[nodiscard]] RegistryAgreement agreement(Time now) const;
  /// This server has no session, not even one that moves or ends.
  [[nodiscard]] bool empty() const noexcept { return entries_.empty(); }
  /// Time from which no hand of any session of this server may be engaged.
  [[nodiscard]] Time act_until() const noexcept { return ownership_.keeper().hold_at(); }
  /// The same for the sessions that this server serves now; nullopt while an order waits: it may be to give a session
  /// up, and hands of that session must not act by the time of a newer lease.
  [[nodiscard]] std::optional<Time> served_until() const noexcept {
    return has_event() ? std::nullopt : std::optional(act_until());
  }

 private:
  enum class Phase : std::uint8_t {
    kClaiming,
    kLoading,  ///< spec and snapshot are being read
    kWriting,  ///< the spec is being written
    kOpening,  ///< kOpen was reported
    kOpen,
    kMoving,     ///< kHandOver was reported
    kLosing,     ///< kGiveUp was reported
    kEnding,     ///< the keys are being erased
    kReleasing,  ///< the owner key is being erased
  };
  struct Entry {
    Phase phase = Phase::kClaiming;
    directory::Revision revision = 0;
    std::optional<ServiceSession> spec{};    ///< to be written
    std::optional<ServiceSession> served{};  ///< as opened
    std::string snapshot{}, consoles{};      ///< newest
    bool fresh = false;                      ///< the spec may not exist before
    bool abandoned = false;                  ///< its creation was refused while the spec was being written
    bool first = false;                      ///< claimed at start: a changed configuration replaces the spec
    bool kept = false;                       ///< begins again from the state that this server has
    std::string target{};                    ///< kMoving
    int steps_until_move = -1;               ///< kMoving: after the hand-over; -1: not handed over, or moving
    std::uint64_t order = 0;
    Time order_ends{}, next_attempt{}, next_standby{};
    Time opened{};
    std::optional<SessionLoad> load{};
    directory::OperationId operation = 0;  ///< under way; 0: none
    Time sent{};
  };

  void take_notices(Time now);
  void on_owned(const std::string& session, directory::Revision revision);
  void on_lost(const std::string& session);
  void on_elsewhere(const std::string& session, const std::string& other);
  void on_session_reply(Time now, const directory::Reply& reply);
  void on_loaded(Time now, const std::string& session, Entry& entry, const directory::Reply& reply);
  void on_written(Time now, const std::string& session, Entry& entry, const directory::Reply& reply);
  void open(const std::string& session, Entry& entry, ServiceSession spec, std::string snapshot = {},
            std::string consoles = {});
  /// Sets a value of a session that is served here, or was until it moves; any other keeps its value.
  void set_state(const std::string& session, const std::string& key, std::string value, std::uint64_t mark = 0);
  void release(Time now, const std::string& session);
  void refuse(Entry& entry, const std::string& session, std::string why);
  [[nodiscard]] std::optional<directory::Request> request_of(const std::string& session, const Entry& entry) const;
  void begin_configured();
  void claim_configured(Time now);
  void on_directory_lost(Time now);
  void follow_losses(Time now);
  void keep(const std::string& session, Entry& entry);
  void learn_bases();
  /// Returns the spec with an epoch that clients have not seen.
  [[nodiscard]] ServiceSession based(ServiceSession spec);
  /// Name of a session that begins here again after the loss of the directory; empty: none fits.
  [[nodiscard]] std::string kept_name(const rpc::SessionChoice& choice) const;
  void advance_sessions(Time now);
  void begin_moves();
  void balance(Time now);
  void begin_move(const std::string& session, Entry& entry, const std::string& server, std::string why);
  void advance_move(const std::string& session, Entry& entry);
  void choose_standby(Time now, const std::string& session, Entry& entry);
  /// All servers as their records have them; this one as it is now.
  [[nodiscard]] std::vector<directory::Candidate> candidates() const;
  void begin(directory::OperationId operation, const directory::Request& request);
  void note(const directory::Reply& reply, Time now);

  ServiceMemberOptions options_;
  directory::Directory& store_;
  directory::DirectoryKeys names_;
  ServiceKeys keys_;
  directory::Ownership ownership_;
  ServiceCatalogue catalogue_;
  ServiceTickets tickets_;
  FencedWriter writer_;
  SharedRegistry registry_;
  DirectoryLoss loss_;
  std::uint64_t registry_losses_ = 0, kept_since_losses_ = 0;
  directory::Placement placement_;
  directory::MovePlanner planner_;
  directory::ServerRecord record_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::map<std::string, Time> refused_until_;  ///< sessions that this server could not open
  std::deque<ServiceEvent> events_;
  directory::OperationId newest_;
  std::set<std::string, std::less<>> to_begin_;  ///< of the configuration, not seen in the service yet
  bool leaving_ = false, left_ = false, name_taken_ = false;
  directory::OperationId revoking_ = 0;
  Time now_{};  ///< of the newest step
  std::optional<Time> answered_;
  std::string trouble_;
  std::uint64_t unanswered_ = 0, moves_seen_ = 0, moves_ = 0;
  Time next_balance_{};
};

}  // namespace tandem::server
