#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "client/app/join_client.h"
#include "server/console/app/live_source.h"

namespace tandem::console {

/// Live values by StatusRequest on a console's control connection, five per second. The server answers ten requests
/// per second; orders get the rest. Joins again while the server is gone.
class StatusSource final : public LiveSource {
 public:
  static constexpr std::size_t kOrdersMax = 16;
  /// @param options  of the join; with a ticket, which is valid once, a lost connection stays lost
  /// @param status   first status, read on the connection
  StatusSource(client::JoinOptions options, client::Console console, rpc::Status status);
  /// Waits for a pending reply, at most for the timeout of the options.
  ~StatusSource() override;

  [[nodiscard]] LivePicture newest() const override;
  [[nodiscard]] std::uint64_t number() const noexcept override { return number_.load(std::memory_order_acquire); }
  [[nodiscard]] bool order(rpc::Body body, Reply reply) override;

 private:
  void work();
  void set(bool connected, rpc::Status* status);
  [[nodiscard]] bool step();
  void execute(const rpc::Body& body, const Reply& reply);

  client::JoinOptions options_;
  client::Console console_;
  mutable std::mutex lock_;
  std::condition_variable wake_;
  LivePicture picture_;
  std::deque<std::pair<rpc::Body, Reply>> orders_;
  bool over_ = false;
  std::atomic<std::uint64_t> number_{1};
  std::thread thread_;
};

}  // namespace tandem::console
