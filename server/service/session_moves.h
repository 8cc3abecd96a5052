#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/directory/placement/move_planner.h"
#include "server/directory/placement/placement.h"
#include "server/service/member_sessions.h"
#include "server/service/move_notes.h"
#include "server/service/move_targets.h"
#include "server/service/service_directory.h"

namespace tandem::server {

/// Decides which open sessions of this server move to which others, and their standbys: by order of an operator, to
/// spread the load, and when this server drains. A session moves when its last snapshot is in the directory and the
/// tickets of its consoles are valid again. If that takes more than 5 s it is opened here again. No move begins while
/// the directory does not store snapshots.
class SessionMoves {
 public:
  /// @param directory, sessions  must outlive this
  /// @param balances  sessions move to less used servers by themselves
  SessionMoves(ServiceDirectory& directory, MemberSessions& sessions, RandomKey key, bool balances)
      : directory_(directory), sessions_(sessions), placement_(key), planner_(key), balances_(balances) {}

  /// Sets the loads of the sessions of this server. A session moves by itself only after its load was set.
  void set_loads(const std::vector<SessionLoad>& loads);
  /// A session that moves is over here, and its last snapshot is published.
  void on_handed_over(Time now, const std::string& session);
  /// A session whose hand-over was ordered because it waits for people stays here: they have come.
  void on_kept(const std::string& session);
  /// This server owns the session no more, by its own will. To be called before it is forgotten here.
  void on_released(Time now, const std::string& session);
  /// Returns the sessions that their new server gave back without opening them, each once. No server owns them.
  [[nodiscard]] std::vector<std::string> poll_given_back(Time now) { return targets_.step(now, directory_); }
  /// The server that was named as standby, or as the target of a move, is not registered.
  /// @param refused  its name
  void on_standby_refused(Time now, const std::string& session, const std::string& refused);
  /// @param own  record of this server as it is now
  void step(Time now, const directory::ServerRecord& own);
  /// A session was handed over so recently that its new server may still give it back.
  [[nodiscard]] bool may_come_back() const noexcept { return !targets_.judged(); }
  /// Sessions that this server has handed over.
  [[nodiscard]] std::uint64_t begun() const noexcept { return begun_; }

 private:
  using Entry = MemberSessions::Entry;

  void follow_orders();
  void balance(Time now, const directory::ServerRecord& own);
  void begin(const std::string& session, Entry& entry, const std::string& server, const std::string& why,
             bool waits = false);
  void advance(Time now, const std::string& session, Entry& entry);
  void choose_standby(Time now, const std::string& session, Entry& entry, const directory::ServerRecord& own);
  /// All servers as their records have them; this one as it is now.
  [[nodiscard]] std::vector<directory::Candidate> candidates(const directory::ServerRecord& own) const;

  ServiceDirectory& directory_;
  MemberSessions& sessions_;
  directory::Placement placement_;
  directory::MovePlanner planner_;
  MoveTargets targets_;
  std::vector<directory::Candidate> candidates_;  ///< as of the newest look
  bool balances_;
  std::uint64_t orders_seen_ = 0;  ///< version of the catalogue
  std::uint64_t begun_ = 0;
  Time next_look_{};
};

}  // namespace tandem::server
