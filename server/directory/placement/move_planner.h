#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "server/directory/placement/placement.h"

namespace tandem::directory {

/// A session of the server that plans moves.
struct PlacedSession {
  std::string session;
  double cost = 0;       ///< measured processor time [cores]
  double expected = 0;   ///< processor time when all its seats are taken [cores]
  bool waiting = false;  ///< no seat is taken, and no console is joined: no person notices a move
  bool pinned = false;   ///< an operator moved it here: it leaves only a server that drains
  Time opened{};         ///< at this server
};

struct PlannedMove {
  enum class Why : std::uint8_t {
    kDrain,   ///< the server takes no further sessions, and is about to end
    kSpread,  ///< the session waits, and another server expects less work
    kStrain,  ///< the server is busy, and others are less so
  };
  std::string session, server;
  Why why{};
};

/// Decides which session of a server moves to another server, one at a time. Pure.
///
/// - A server that drains moves all its sessions away, those without people first.
/// - Sessions without people are spread by the processor time that is expected when all seats are taken: one moves if
///   it makes the use of the two servers more even by at least half of its own part.
/// - A session with people moves only if its server uses more than kBusy of its capacity and more than kAbove times the
///   mean of all servers, to one that stays at or below the mean.
/// - After a server has come or gone nothing moves for kSettle, and no session moves within its rest after it was
///   opened. Records of other servers are some seconds old, so that this server's own moves are added to them.
class MovePlanner {
 public:
  static constexpr double kBusy = 0.5, kAbove = 1.08;
  static constexpr Duration kSettle = std::chrono::seconds(3), kRecordAge = std::chrono::seconds(3),
                            kBetweenStrained = std::chrono::seconds(3), kRest = std::chrono::minutes(1),
                            kWaitingRest = std::chrono::seconds(5);

  explicit MovePlanner(RandomKey key) noexcept : placement_(key) {}

  /// @param candidates  all servers; that of `own` is as new as `sessions`
  /// @return the move to begin now; nothing: none
  [[nodiscard]] std::optional<PlannedMove> step(Time now, std::span<const Candidate> candidates, std::string_view own,
                                                std::span<const PlacedSession> sessions);

 private:
  /// A move of this server that the target's record may not show yet.
  struct Sent {
    Time at{};
    std::string server;
    double cost = 0, expected = 0;
  };

  [[nodiscard]] bool settled(Time now, std::span<const Candidate> candidates);
  [[nodiscard]] std::optional<PlannedMove> leave(std::span<const Candidate> servers,
                                                 std::span<const PlacedSession> sessions, std::string_view own);
  [[nodiscard]] std::optional<PlannedMove> spread(Time now, std::span<const Candidate> servers,
                                                  std::span<const PlacedSession> sessions, std::string_view own);
  [[nodiscard]] std::optional<PlannedMove> relieve(Time now, std::span<const Candidate> servers,
                                                   std::span<const PlacedSession> sessions, std::string_view own);

  Placement placement_;
  std::vector<std::string> known_;  ///< names of the servers
  std::optional<Time> changed_;     ///< when a server came or went
  std::optional<Time> relieved_;    ///< newest move of a session with people
  std::deque<Sent> sent_;
  std::map<std::string, Time> moved_;  ///< by session: it may come back, and rests then
};

}  // namespace tandem::directory
