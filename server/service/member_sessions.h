#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "server/service/member_session.h"
#include "server/service/move_notes.h"

namespace tandem::server {

/// An order of the member to its server; orders are carried out in sequence.
struct ServiceEvent {
  enum class Kind : std::uint8_t {
    kOpen,        ///< serve the session; answer with `on_opened` or `on_open_failed`
    kGiveUp,      ///< end it here, its state stays; answer with `on_given_up`
    kHandOver,    ///< the same, because it moves, `text` says why; answer with `on_handed_over` when it is over, or
                  ///< with `on_kept`
    kRefused,     ///< a creation is refused: `text` says why
    kUnreadable,  ///< the session cannot be opened: its spec in the directory is damaged, or of another release
  };
  Kind kind{};
  std::string session;
  ServiceSession spec{};      ///< kOpen
  std::string snapshot{};     ///< kOpen: bytes of `encode_snapshot`; empty: a new session
  std::string consoles{};     ///< kOpen: text of ServiceConsoles, as the former owner wrote it; empty: none
  std::int64_t revision = 0;  ///< kOpen: of the ownership, with the session's epoch_base: its epoch
  std::uint64_t order = 0;    ///< kOpen, kRefused: number of the creation; 0: none
  std::string text{};
  bool waits = false;  ///< kHandOver: it moves because it waits for people: keep it if they have come
};

/// All sessions that this server claims, serves or ends, and the orders about them to the server.
///
/// - A session without owner is claimed when a client asks for it, by its standby, or as the caller decides.
/// - An owned session is opened from its spec and its newest snapshot in the directory.
/// - A session that ends takes its keys with it: spec, snapshot, then the owner key.
class MemberSessions {
 public:
  static constexpr Duration kCreationLimit = std::chrono::seconds(4);  ///< then a creation is refused
  static constexpr Duration kRefusalPause = std::chrono::seconds(10);  ///< after a session could not be opened here

  struct Entry {
    MemberSession session;
    std::uint64_t order = 0;  ///< number of the creation that is not answered yet; 0: none
    Time order_ends{};
    Time opened{};
    MoveNotes move{};
  };
  using Entries = std::map<std::string, Entry, std::less<>>;

  /// @param directory, base  must outlive this
  MemberSessions(ServiceDirectory& directory, EpochBase& base) : directory_(directory), base_(base) {}

  [[nodiscard]] std::optional<ServiceEvent> poll_event();
  [[nodiscard]] bool has_event() const noexcept { return !events_.empty(); }
  /// Whether the server may still serve a session that it has lost: the order to give it up is not answered.
  [[nodiscard]] bool loses() const noexcept { return given_up_ > 0; }

  /// Claims a session that no server owns, unless it could not be opened here a short time ago.
  void want(const std::string& session);
  /// It could not be opened here a short time ago.
  [[nodiscard]] bool refused(const std::string& session) const;
  /// Claims a session that begins from a spec. Returns false if too many are known.
  bool claim(const std::string& session, MemberSession::Origin origin, MemberSession::Run from);
  /// Creates a session. kOpen or kRefused follows. Returns false if this server knows it, or too many.
  [[nodiscard]] bool create(Time now, const std::string& session, ServiceSession spec, std::uint64_t order);
  /// Refuses a creation because the directory was lost.
  void refuse_as_lost(const std::string& session, std::uint64_t order);

  /// Answers to events.
  void on_opened(const std::string& session);
  void on_open_failed(Time now, const std::string& session);
  void on_given_up(const std::string& session);

  /// The session is over: erases its keys, then its ownership. Nothing is handed over of a session that ends before the
  /// server has begun that.
  void end(const std::string& session);
  /// Another run replaces the session under the same ownership. kOpen follows.
  void replace(const std::string& session, ServiceSession spec);
  /// @param mark   for `ServiceMember::poll_stored` once the snapshot is in the directory; 0: none
  /// @param order  has it written before other values, without a pause
  void set_snapshot(const std::string& session, std::string bytes, std::uint64_t mark = 0, bool order = false);
  /// Sets the text of ServiceConsoles.
  void set_consoles(const std::string& session, std::string text);
  void set_listed(const std::string& session, std::string text);

  /// Has the run of an open session handed over. kHandOver follows.
  /// @param why    for operators
  /// @param waits  the reason holds only while it waits for people
  void hand_over(const std::string& session, Entry& entry, std::string why, bool waits);

  /// Notices of the ownership.
  void on_owned(const std::string& session, directory::Revision revision);
  void on_elsewhere(const std::string& session, const std::string& other);
  void on_released(const std::string& session) { entries_.erase(session); }
  /// Returns the run that is lost, if it was served here.
  std::optional<MemberSession::Run> on_lost(const std::string& session);
  /// The directory has lost its data, and every ownership was lost before this call.
  void on_directory_lost();

  /// Begins the requests of all sessions, and refuses creations that took too long.
  /// @param retry_after  after which a request without an answer is begun again
  void step(Time now, Duration retry_after, const BeginRequest& begin);
  /// Takes a reply. Returns the name of the session that is to be opened by it; empty: none.
  std::string on_reply(Time now, const directory::Reply& reply);

  [[nodiscard]] Entries& entries() noexcept { return entries_; }
  [[nodiscard]] const Entries& entries() const noexcept { return entries_; }
  /// Phase of a session; nullopt: this server has nothing to do with it.
  [[nodiscard]] std::optional<MemberSession::Phase> phase(std::string_view session) const;
  [[nodiscard]] bool contains(std::string_view session) const { return entries_.contains(session); }
  [[nodiscard]] bool empty() const noexcept { return entries_.empty(); }
  /// Number of sessions that this server serves.
  [[nodiscard]] std::size_t open() const noexcept;

 private:
  using Phase = MemberSession::Phase;

  [[nodiscard]] MemberSession* in(Phase phase, const std::string& session);
  /// A session that is served here, also if its hand-over was ordered but has not begun.
  [[nodiscard]] MemberSession* served(const std::string& session);
  void refuse(const std::string& session, Entry& entry, std::string why);
  void release(Time now, const std::string& session);
  void report_open(const std::string& session, Entry& entry);

  ServiceDirectory& directory_;
  EpochBase& base_;
  Entries entries_;
  std::map<std::string, Time> refused_until_;  ///< sessions that this server could not open
  std::deque<ServiceEvent> events_;
  std::size_t given_up_ = 0;  ///< kGiveUp without answer; the session may be this server's again before
  Time now_{};                ///< of the newest step
};

}  // namespace tandem::server
