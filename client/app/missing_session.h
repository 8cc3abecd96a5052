#pragma once

#include <cstdint>
#include <optional>

#include "common/base/time.h"

namespace tandem::client {

/// Answer of the servers that a client asked for its seat in one attempt; of several answers the greatest one.
enum class SeatAnswer : std::uint8_t {
  kNone,     ///< no server was reached
  kMissing,  ///< the service has no such session
  kOther,    ///< anything else: the session goes on, is coming, or the server cannot tell
};

/// Decides how often and how long a client asks the servers of its service for a session that they do not have. Pure:
/// the caller passes the time.
///
/// One answer kMissing proves nothing. A server that is cut off from etcd has an old copy of the directory until the
/// pings of its connection fail, after 8 s at most; then it answers that it cannot tell. A server that could not open
/// the session denies it until etcd has taken its ownership back, which lasts up to 12 s while etcd replaces its
/// leader. In all other states of a session that goes on, for example without an owner, servers answer that it is
/// coming, that another server has it, or that they cannot tell. A client that gives up after 15 s of kMissing
/// therefore misses no session that comes back within 7 s of its server's death, or within 12 s if the leader of etcd
/// dies too. Exception: after a loss of the directory only the former owner has the session, and stays cut off.
class MissingSession {
 public:
  static constexpr Duration kLimit = std::chrono::seconds(15);
  static constexpr int kAnswersMin = 4;  ///< two answers may be 15 s apart if the network fails between them
  /// A server accepts 10 connections per second from one address, after a burst of 100. With this wait 30 clients
  /// behind one address make no more, so that others can join from there.
  static constexpr Duration kWait = std::chrono::seconds(3);

  /// Takes the answer to one attempt. An attempt without any answer changes nothing, because a server also closes
  /// connections above its limit. @return true: the session has ended, so that a further attempt is useless
  bool on_attempt(Time now, SeatAnswer heard) noexcept {
    if (heard == SeatAnswer::kOther) since_.reset();
    if (heard != SeatAnswer::kMissing) return false;
    if (!since_) {
      since_ = now;
      answers_ = 0;
    }
    ++answers_;
    return answers_ >= kAnswersMin && now - *since_ >= kLimit;
  }
  /// Shortest wait before the next attempt.
  [[nodiscard]] Duration wait() const noexcept { return since_ ? kWait : Duration{}; }

 private:
  std::optional<Time> since_;  ///< time of the first answer kMissing since the last kOther
  int answers_ = 0;            ///< since then
};

}  // namespace tandem::client
