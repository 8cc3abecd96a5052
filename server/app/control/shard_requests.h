#pragma once

#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <vector>

#include "server/app/process/shard.h"

namespace tandem::server {

/// Requests of the control plane to the shards, from `post` to their completion. It owns each request while a shard
/// executes it. All members run on the control plane's thread.
class ShardRequests {
 public:
  static constexpr std::size_t kHeldMax = 256;  ///< requests of a moving session above which questions do not wait
  static constexpr std::chrono::milliseconds kRetry{2};

  explicit ShardRequests(asio::io_context& context) : context_(context), retry_timer_(context) {}

  [[nodiscard]] asio::io_context& context() const noexcept { return context_; }
  /// Waits for completed requests of the shard.
  void watch(Shard& shard);
  /// Stops waiting for all shards, so that the context can end.
  void stop_watching();
  /// The watched shards.
  [[nodiscard]] std::vector<const Shard*> shards() const;

  /// Posts a request. Its `done` is called after a shard has executed it. While the shard has no place for it, a
  /// question (`asks_only`) is completed now with JoinResult::kBusy. All others must not be lost: they are posted again
  /// every kRetry, until `stop_watching` completes them with JoinResult::kSessionOver. Each connection, seat, slot and
  /// session has at most one of them.
  void post(Shard& shard, ShardRequest request);
  /// Passes the session of the request (kMoveSession) from its shard to another. Until that is completed, all requests
  /// of the session wait here; then they go to the shard that serves it. One session moves at a time.
  /// While another moves, or requests wait for a place in a queue, this is completed now with JoinResult::kSessionOver.
  void move(Shard& from, ShardRequest request);
  /// Calls `then` once no request of the session is in progress.
  void when_idle(const LiveSession& session, std::function<void()> then);

 private:
  struct Watched {
    Shard* shard;
    asio::posix::stream_descriptor completions;
  };
  struct Waiting {
    const LiveSession* session;
    std::function<void()> then;
  };
  struct Retried {
    Shard* shard;
    ShardRequest* request;
  };
  void await_completions(Watched& watched);
  void retry();
  void begin(Shard& shard, ShardRequest& request);
  void hold(ShardRequest& request);
  void reject(ShardRequest& question);
  void end_move(Shard& serving);
  void complete(ShardRequest& request);
  [[nodiscard]] bool idle(const LiveSession& session) const;

  asio::io_context& context_;
  std::list<Watched> watched_;
  std::list<ShardRequest> requests_;  ///< in progress
  std::list<Waiting> waiting_;
  std::deque<Retried> retried_;  ///< requests of `requests_` that wait for a place, in their order
  asio::steady_timer retry_timer_;
  const LiveSession* moving_ = nullptr;  ///< the session that moves
  Shard* moves_from_ = nullptr;
  std::vector<ShardRequest*> held_;  ///< requests of `requests_` for that session, in their order
};

}  // namespace tandem::server
