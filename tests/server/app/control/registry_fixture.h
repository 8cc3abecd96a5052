#pragma once

#include <gtest/gtest.h>

#include <list>
#include <string>
#include <thread>

#include "common/io/udp_socket.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/control/session_registry.h"

namespace tandem::server::test {

using namespace std::chrono_literals;

/// Ids of sessions, by a number.
inline auth::Id16 id_of(unsigned number) { return {static_cast<std::byte>(number)}; }

/// A session registry and a shard, without clients. The shard executes requests after `serve`.
class RegistryFixture {
 public:
  RegistryFixture() { registry.requests().watch(shard); }
  ~RegistryFixture() { finish(); }
  /// Ends the thread of the shard.
  void finish() {
    shard.stop();
    if (ticking_.joinable()) ticking_.join();
  }
  [[nodiscard]] TickQueue& records() noexcept { return records_; }

  /// Registers a session of the scene free_motion (seats trainer and trainee), in the slot after the last one.
  /// @param code    session code; empty: tickets only
  /// @param served  false: the shard has removed the session already
  SessionEntry& add(const std::string& name, unsigned id, const std::string& code = {}, bool served = true) {
    const auto slot = static_cast<std::uint8_t>(sessions_.size());
    LiveSession& session = sessions_.emplace_back(scene, *make_local_slaves(scene, Time{}), slot, records_);
    EXPECT_TRUE(!served || shard.add_session(session));
    registry.add({name, id_of(id), code, 3, &session, &shard});
    return registry.entries().back();
  }
  /// Ticks the sessions on their own thread from now on.
  void serve() {
    ticking_ = std::thread([this] { shard.run(); });
  }
  /// Completes requests until the condition holds. The test fails after 30 s.
  template <class Condition>
  void wait_until(Condition condition) {
    while (!condition())
      if (context.run_one_for(30s) == 0) FAIL() << "no request was completed for 30 s";
  }

  const SceneSpec scene = *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto");
  asio::io_context context;
  Shard shard{std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), 1000};
  SessionRegistry registry{context};

 private:
  TickQueue records_{16};
  std::list<LiveSession> sessions_;
  std::thread ticking_;
};

/// The error of a reply; kInternal without a text for any other reply.
template <class Reply>
rpc::ErrorReply error_of(const Reply& reply) {
  const auto* const error = std::get_if<rpc::ErrorReply>(&reply);
  return error == nullptr ? rpc::ErrorReply{} : *error;
}

}  // namespace tandem::server::test
