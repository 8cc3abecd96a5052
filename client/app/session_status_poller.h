#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/auth/io/control_client.h"
#include "common/io/event_fd.h"
#include "common/io/fd.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Polls the session status from the server once per second on its own thread: leader, origin and reason of a stop,
/// progress of a drain. FORCE contains only numbers. The servo thread does not wait for it, and the seat continues if
/// the connection is lost.
class SessionStatusPoller {
 public:
  static constexpr std::chrono::milliseconds kReplyTimeout{2000};
  /// Starts the thread.
  /// @param connection  control connection of the join, used only by this object during its lifetime; null: no status
  /// @param reply_timeout  timeout of each reply
  SessionStatusPoller(std::shared_ptr<auth::ControlClient> connection, const rpc::Id& session,
                      std::chrono::milliseconds reply_timeout = kReplyTimeout);
  /// Waits for a pending reply, at most for the reply timeout.
  ~SessionStatusPoller();
  SessionStatusPoller(const SessionStatusPoller&) = delete;
  SessionStatusPoller& operator=(const SessionStatusPoller&) = delete;

  /// Shuts the connection down, so that the destructor does not wait for a reply.
  void cancel() noexcept;
  /// Polls at once instead of within a second; at least 150 ms after the last reply.
  void poll_now() noexcept;
  /// Readable when `take` returns a status.
  [[nodiscard]] int status_fd() const noexcept { return news_.get(); }
  /// Descriptor of the connection for poll(), valid during the life of this object; -1 without a connection.
  [[nodiscard]] int connection_fd() const noexcept { return socket_.get(); }
  /// True if the connection is lost: no further status arrives, and the last one may be outdated.
  [[nodiscard]] bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  /// Returns the newest status that was not taken yet.
  [[nodiscard]] std::optional<rpc::Status> take();

 private:
  void work(const rpc::Id& session);

  std::shared_ptr<auth::ControlClient> connection_;
  std::chrono::milliseconds reply_timeout_;
  io::Fd socket_;  ///< duplicate of the connection's socket, which the thread may close at any time
  io::EventFd news_, wake_;
  std::mutex lock_;
  std::optional<rpc::Status> newest_;
  std::atomic<bool> over_{false}, ended_{false};
  std::thread thread_;
};

/// Returns the server's reason for the removal of a seat; empty if the server gives none. Blocks for at most 2 s.
[[nodiscard]] std::string query_removal_reason(auth::ControlClient* connection, const rpc::Id& session);

}  // namespace tandem::client
