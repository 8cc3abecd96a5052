#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "common/io/datagram_steering.h"
#include "server/app/process/shard.h"

namespace tandem::test {

/// Two shards of one tick rate, with their sockets on one port of 127.0.0.1. The caller plays the control plane.
class ShardPair {
 public:
  explicit ShardPair(double tick_hz) {
    steering_.byte = 5;  // of a datagram: the slot in its connection id
    steering_.sockets = 2;
    auto sockets = io::bind_udp_steered(*io::parse_address("127.0.0.1:0", 0), steering_);
    for (io::UdpSocket& socket : *sockets)
      shards_.push_back(std::make_unique<server::Shard>(std::move(socket), tick_hz));
  }
  ~ShardPair() { stop(); }

  void run() {
    for (const auto& shard : shards_) threads_.emplace_back([&shard] { shard->run(); });
  }
  void stop() {
    for (const auto& shard : shards_) shard->stop();
    for (std::thread& thread : threads_)
      if (thread.joinable()) thread.join();
    threads_.clear();
  }
  /// Ends one of the threads.
  void end(std::size_t i) {
    shards_[i]->stop();
    threads_[i].join();
  }
  [[nodiscard]] server::Shard& shard(std::size_t i) { return *shards_[i]; }
  [[nodiscard]] std::size_t shard_of(const server::LiveSession& session) const {
    return steering_.socket_of[session.slot()];
  }

  /// Begins to move a session to the other shard.
  /// @param program  for the kernel, in place of the right one; null: none
  void begin_move(server::LiveSession& session, const io::SteeringProgram* program = nullptr) {
    const std::size_t from = shard_of(session);
    io::Steering changed = steering_;
    changed.socket_of[session.slot()] = static_cast<std::uint8_t>(1 - from);
    there_ = std::make_unique<io::SteeringProgram>(changed);
    before_ = std::make_unique<io::SteeringProgram>(steering_);
    request_ = {.what = server::ShardRequest::What::kMoveSession,
                .session = &session,
                .target = shards_[1 - from].get(),
                .steering = program != nullptr ? program : there_.get(),
                .steering_before = before_.get()};
    ASSERT_TRUE(shards_[from]->post(request_));
  }
  /// @return whether the move that was begun is complete; `moved` tells whether the other shard serves the session
  [[nodiscard]] bool complete(bool& moved) {
    for (const auto& shard : shards_)
      while (const server::ShardRequest* const done = shard->next_completed()) {
        if (done != &request_) continue;
        moved = request_.result == server::JoinResult::kAccepted;
        if (moved) steering_.socket_of[request_.session->slot()] ^= 1;
        return true;
      }
    return false;
  }
  /// Moves a session and waits for it, at most 30 s. @return whether the other shard serves it
  bool move(server::LiveSession& session, const io::SteeringProgram* program = nullptr) {
    begin_move(session, program);
    bool moved = false;
    for (int i = 0; i < 30'000 && !complete(moved); ++i) ::usleep(1000);
    return moved;
  }

 private:
  io::Steering steering_;
  std::vector<std::unique_ptr<server::Shard>> shards_;
  std::unique_ptr<io::SteeringProgram> there_, before_;
  server::ShardRequest request_;
  std::vector<std::thread> threads_;
};

}  // namespace tandem::test
