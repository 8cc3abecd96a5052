#pragma once

#include <cstdint>
#include <deque>
#include <map>

#include "server/directory/directory_view.h"
#include "server/directory/lease_keeper.h"

namespace tandem::directory {

enum class SessionState : std::uint8_t {
  kNone,       ///< this server has nothing to do with the session
  kClaiming,   ///< asked for; not owned yet
  kServing,    ///< owned, and the lease is fresh
  kHolding,    ///< owned as far as this server knows, but no hand may be engaged: ramp out, keep the seats
  kReleasing,  ///< ramped out; the key is being erased
  kLost,       ///< another server may own it: end it here
};

struct Notice {
  enum class Kind : std::uint8_t {
    kLeased,            ///< the server has a lease
    kLeaseLost,         ///< every session of the old lease is kLost
    kNameTaken,         ///< another server is registered under this name
    kOwned,             ///< `revision` is the fencing token
    kElsewhere,         ///< `other` owns the session, or takes it over
    kLost,              ///< the session is another server's, or unowned
    kReleased,          ///< the session may be another server's now
    kStandbySet,        ///< `other` takes over when this server is gone
    kStandbyRefused,    ///< `other` is not registered
    kTicketAccepted,    ///< `other` is the ticket, `revision` that of its use
    kTicketRefused,     ///< `other` was used before
    kTicketUnanswered,  ///< this server owns the session no more, and does not know whether `other` was used
    kTicketNoLease,     ///< the lease for the use of `other` does not exist, so it is not used
  };
  Kind kind{};
  std::string session, other;
  Revision revision = 0;
};

/// One server's part of the ownership protocol. Pure: no clock, socket or thread; for the control thread, not for
/// ticks.
///
/// - A session belongs to the server whose transaction created its owner key; the key is under that server's lease. The
///   revision of that write is the session's fencing token. Clients obey the highest one that they have seen.
/// - The server relies on its lease only as long as `LeaseKeeper` permits. It ramps out before another may begin.
/// - A server claims a session when a client asks for it, or when it is the session's standby; never because a key is
///   missing. A standby goes first: its key is under its own lease, so that a dead standby delays no claim.
/// - A move names the target as standby, ramps out, then erases the owner key. The target claims.
/// - A request without an answer is sent again until its result is known. Each transaction compares revisions, so that
/// a
///   late or doubled one changes nothing that came after it.
class Ownership {
 public:
  static constexpr std::size_t kSessionsMax = 4096;
  static constexpr std::size_t kTicketsMax = 1024;  ///< that wait for an answer

  struct Operation {
    OperationId id = 0;
    Request request;
  };

  /// @param text  text of the registration: address, key, version, free capacity
  /// @pre `times.problem()` is empty and `server` is a valid name
  Ownership(std::string server, std::string text, LeaseTimes times, DirectoryKeys keys = DirectoryKeys());

  /// Returns the next operation to begin. The caller begins it after this call: `now` counts as its sending time.
  [[nodiscard]] std::optional<Operation> poll_operation(Time now);
  void on_reply(Time now, const Reply& reply);
  [[nodiscard]] std::optional<Notice> poll_notice();

  /// Asks for a session. Returns false if the name is not valid or kSessionsMax sessions are known.
  bool claim(const std::string& session);
  /// Names the server that takes over when this one is gone, instead of one that was named and is not set yet. Returns
  /// false if the session is not owned, or moves.
  bool set_standby(const std::string& session, const std::string& server);
  /// Hands the session to another server. Returns false if the session is not owned or `server` is this one.
  bool move(const std::string& session, const std::string& server);
  /// Ends the session everywhere: ramps out, then erases its keys. Returns false if the session is not owned.
  bool release(Time now, const std::string& session);
  /// Uses a ticket for a session of this server, exactly once in the whole service; the notice has the result.
  /// Returns false if the session is not owned, a name is not valid, or kTicketsMax tickets wait.
  /// @param lease  under which the store keeps the use, and that ends after the ticket; 0: for ever
  /// @param again  takes the place of a use that stands in the store: the caller knows that it was for this session,
  ///               at a former owner, and ended with that
  bool use_ticket(const std::string& session, const std::string& ticket, LeaseId lease = 0, bool again = false);
  /// The store has lost its data: every session is lost, claims are forgotten, and the view is read again.
  void begin_again();
  /// Sends no claim, or sends them again. Claims of sessions that the view gives to this server wait too.
  void hold_claims(bool held) noexcept { claims_held_ = held; }
  /// Removes a lost session.
  void forget(const std::string& session);
  void describe(std::string text) { keeper_.describe(std::move(text)); }

  [[nodiscard]] SessionState state(std::string_view session, Time now) const;
  /// Returns whether the session may have effort at `now`: serving, or ramping out.
  [[nodiscard]] bool may_act(std::string_view session, Time now) const;
  /// Fencing token of an owned session; 0 for any other.
  [[nodiscard]] Revision revision(std::string_view session) const;
  /// Names of the sessions that this server claims, owns, releases or has lost.
  [[nodiscard]] std::vector<std::string> sessions() const;
  [[nodiscard]] const LeaseKeeper& keeper() const noexcept { return keeper_; }
  [[nodiscard]] const DirectoryView& view() const noexcept { return view_; }
  [[nodiscard]] const std::string& server() const noexcept { return server_; }

 private:
  enum class Phase : std::uint8_t { kClaiming, kOwned, kRamping, kReleasing, kLost };
  struct Entry {
    Phase phase = Phase::kClaiming;
    Revision revision = 0;
    std::string standby;         ///< newest one asked for
    bool standby_asked = false;  ///< the request waits for its turn or its answer
    Time ramped{};               ///< kRamping: end of the ramp
    bool ends = false;           ///< kRamping, kReleasing: no standby takes over
    bool moves = false;          ///< begins to ramp as soon as `standby` is set
  };
  struct Work {
    enum class Kind : std::uint8_t { kClaim, kStandby, kRelease, kTicket } kind{};
    std::string session{}, other{}, token{};
    Time begin{}, sent{};
    LeaseId lease = 0;
    LeaseId ticket_lease = 0;
    bool use_again = false;   ///< kTicket: in the place of a former use
    Revision former_use = 0;  ///< kTicket: newest write of that use; 0: there is none
    Revision revision = 0;
    std::optional<bool> as_standby{};  ///< kClaim: the standby key is under our lease; empty: the view decides
  };

  [[nodiscard]] std::optional<Request> request_of(Work& work);
  [[nodiscard]] std::optional<Request> claim_request(Work& work) const;
  void on_claim(Time now, Work work, const Reply& reply);
  void on_standby(Time now, const Work& work, const Reply& reply);
  bool ask_standby(const std::string& session, const std::string& server);
  void refuse_standby(const Work& work, Entry& entry);
  void on_ticket(Time now, Work work, const Reply& reply);
  void again(Time now, Work work);
  void ramp(Time now, Entry& entry);
  void take_keeper_events();
  void follow_view();
  /// The view gives the session to this server, which does not own it as far as it knows.
  [[nodiscard]] bool given_to_us(const std::string& session) const;
  void lose(const std::string& session, Entry& entry);
  void expire_requests(Time now);
  void begin_releases(Time now);
  void notify(Notice::Kind kind, const std::string& session = {}, const std::string& other = {}, Revision revision = 0);
  [[nodiscard]] Entry* owned(const std::string& session);

  std::string server_;
  LeaseTimes times_;
  DirectoryKeys keys_;
  LeaseKeeper keeper_;
  DirectoryView view_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::map<std::string, Revision, std::less<>> released_;  ///< as long as the view shows these as ours
  std::deque<Work> waiting_;
  std::map<OperationId, Work> sent_;
  std::deque<Notice> notices_;
  OperationId newest_operation_ = 0;
  std::size_t ramping_ = 0, tickets_ = 0;
  bool claims_held_ = false;
  std::uint64_t attempts_ = 0;
};

}  // namespace tandem::directory
