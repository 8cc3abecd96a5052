#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/process/session_table.h"

namespace tandem::server::test {

using namespace std::chrono_literals;

/// A session of scene `lesson`, whose instructor's seat is required.
inline SessionOptions lesson(const std::string& name) {
  SessionOptions session{.name = name};
  session.scene = *parse_scene(find_shipped_scene("lesson")->text, "lesson.textproto");
  return session;
}

/// Returns options of a quiet server on a free port of 127.0.0.1 with ephemeral keys.
inline ServerOptions options_with(std::vector<SessionOptions> sessions) {
  ServerOptions options{.command = "serve", .sessions = std::move(sessions), .quiet = true};
  options.control.listen = *io::parse_address("127.0.0.1:0", 0);
  return options;
}

/// The table with all parts that a server process has around it.
class TableRig {
 public:
  /// @param notes  the server's notes are printed
  explicit TableRig(ServerOptions given, bool notes = false)
      : options(std::move(given)), output("serve", notes, false), shards(options) {
    std::filesystem::create_directories(folder_);
    setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);  // keys for clients of this user
    control = *ControlServer::open(options.control, shards.steering(), {});
    table.emplace(options, shards, *control, nullptr, output);
  }
  ~TableRig() {
    shards.stop();
    shards.join();
    control->stop();
    table.reset();
    control.reset();
    unsetenv("XDG_RUNTIME_DIR");
    std::filesystem::remove_all(folder_);
  }

  /// Opens the sessions and runs shards and control server.
  void start() {
    ASSERT_EQ(table->open(), 0);
    shards.take_sockets(control->take_sockets());
    table->begin();
    for (const auto& shard : shards.all()) control->registry().requests().watch(*shard);
    ASSERT_EQ(control->start(), "");
    shards.run();
  }
  /// Waits until a session is over; the test fails after 30 s.
  void wait_until_over(SessionInstance& session) {
    pollfd over{session.live_session().over_fd(), POLLIN, 0};
    ASSERT_EQ(poll(&over, 1, 30'000), 1);
    for (int i = 0; i < 1000 && !session.live_session().over(); ++i) poll(nullptr, 0, 10);  // set after the event
    ASSERT_TRUE(session.live_session().over());
  }
  /// Executes an operator's order, and services the table until the reply is there; the test fails after 30 s.
  rpc::Body order(decltype(SessionOrder::body) body) {
    std::optional<rpc::Body> reply;
    table->execute(
        {.body = std::move(body), .who = "office (operator)", .answer = [&](rpc::Body b) { reply = std::move(b); }});
    for (int i = 0; i < 3000 && !reply; ++i) {
      std::vector<pollfd> over;
      for (const auto& session : table->all()) over.push_back({session->live_session().over_fd(), POLLIN, 0});
      poll(over.data(), over.size(), 10);
      table->service(io::monotonic_now());
    }
    EXPECT_TRUE(reply) << "no reply for 30 s";
    return reply.value_or(rpc::Body{});
  }
  /// Id of the session that an order creates; a rejection fails the test.
  rpc::Id create(const std::string& name) {
    const rpc::Body reply = order(rpc::CreateSession{.name = name, .scene = "lesson"});
    const auto* const created = std::get_if<rpc::SessionCreated>(&reply);
    EXPECT_NE(created, nullptr) << (std::holds_alternative<rpc::ErrorReply>(reply)
                                        ? std::get<rpc::ErrorReply>(reply).text
                                        : "");
    return created == nullptr ? rpc::Id{} : created->session.id;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& session : table->all()) all.push_back(session->options().name);
    return all;
  }

  ServerOptions options;
  ServerOutput output;
  ShardPool shards;
  std::unique_ptr<ControlServer> control;
  std::optional<SessionTable> table;

 private:
  std::string folder_ = testing::TempDir() + "session_table_" + std::to_string(::getpid());
};

}  // namespace tandem::server::test
