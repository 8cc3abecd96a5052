// Consoles that watch a session: their joins over TLS, against a session on its own tick thread.
#include <list>

#include "proto/text/scene_bytes.h"
#include "tests/io/live_server.h"

namespace tandem::server::test {
namespace {

using rpc::ErrorCode;

const rpc::Id kId = LiveServer::kId;

/// Polls until the condition holds; fails the test at the time limit instead of hanging it.
bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kTimeout; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(20ms);
  }
  return false;
}

/// A request to watch. Without WATCH the slot is free after 2 s.
rpc::Hello watching_hello(const LiveServer& live_server, const auth::Identity& key, AccessRole role) {
  rpc::Hello hello = LiveServer::hello(live_server.ticket(key, role));
  hello.watch = true;
  return hello;
}
JoinedClient watching(LiveServer& live_server, const std::string& name, AccessRole role) {
  auth::Identity key = live_server.enrolled(name);
  auto connection = live_server.connect(key);
  auto welcome = connection.ask(watching_hello(live_server, key, role), kTimeout);
  return {std::move(key), std::move(connection), std::move(welcome)};
}

TEST(Consoles, WatchASessionWithTheRightsOfTheirRole) {
  LiveServer live_server;
  {
    JoinedClient office = watching(live_server, "office", AccessRole::kOperator);
    ASSERT_TRUE(office.welcomed()) << text_of(office.welcome);
    const auto setup = std::span{reinterpret_cast<const char*>(office.in().setup.data()), office.in().setup.size()};
    const auto scene = decode_scene(setup, "lesson");
    ASSERT_TRUE(scene);
    EXPECT_EQ(effective_scene_text(*scene), effective_scene_text(live_server.scene()));
    EXPECT_TRUE(done(office.ask(rpc::StopSession{kId, "why"})));
    JoinedClient archive = watching(live_server, "archive", AccessRole::kRecorder);
    ASSERT_TRUE(archive.welcomed()) << text_of(archive.welcome);
    EXPECT_NE(office.in().server_cid, archive.in().server_cid);
    EXPECT_EQ(reason_of(archive.ask(rpc::StopSession{kId, "why"})), ErrorCode::kNotAllowed);
    EXPECT_EQ(reason_of(archive.ask(rpc::SetAuthority{kId, 0, 1, {0.5, 0.5}})), ErrorCode::kNotAllowed);
  }
  std::vector<auth::Identity> keys;  // made before, so that all joins are within two seconds
  for (std::size_t n = 0; n <= Watchers::kMax; ++n) keys.push_back(live_server.enrolled("w" + std::to_string(n)));
  const auto last_of = [&] {
    std::list<auth::ControlClient> open;
    std::expected<rpc::Body, auth::ClientError> reply;
    for (const auth::Identity& key : keys) {
      open.push_back(live_server.connect(key));
      reply = open.back().ask(watching_hello(live_server, key, AccessRole::kRecorder), kTimeout);
    }
    return std::pair(reason_of(reply), text_of(reply));
  };
  EXPECT_TRUE(comes_true([&] {  // on a busy machine the first slots may be free again before the last join
    const auto [reason, text] = last_of();
    return reason == ErrorCode::kFull && text.find("all 8 places of watching consoles") != std::string::npos;
  }));
  JoinedClient console = joined(live_server, "desk", AccessRole::kOperator);
  EXPECT_TRUE(console.welcomed()) << "a console that does not watch needs no place";
  EXPECT_TRUE(comes_true([&] { return watching(live_server, "next", AccessRole::kRecorder).welcomed(); }));
}

// Three times as many as slots, each gone at once: also one that goes before the session has admitted it keeps no slot.
TEST(Consoles, ReleaseTheirSlotWithTheirConnection) {
  LiveServer live_server;
  std::vector<auth::Identity> keys;
  for (std::size_t n = 0; n < 3 * Watchers::kMax; ++n) keys.push_back(live_server.enrolled("w" + std::to_string(n)));
  for (const auth::Identity& key : keys)
    EXPECT_TRUE(comes_true([&] {
      auto connection = live_server.connect(key);
      const auto reply = connection.ask(watching_hello(live_server, key, AccessRole::kRecorder), kTimeout);
      return reply && std::holds_alternative<rpc::Welcome>(*reply);
    }));
  std::list<auth::ControlClient> open;
  std::size_t welcomed = 0;
  for (std::size_t n = 0; n < Watchers::kMax; ++n)
    welcomed += comes_true([&] {
      open.push_back(live_server.connect(keys[n]));
      const auto reply = open.back().ask(watching_hello(live_server, keys[n], AccessRole::kRecorder), kTimeout);
      if (!reply || !std::holds_alternative<rpc::Welcome>(*reply)) open.pop_back();
      return reply && std::holds_alternative<rpc::Welcome>(*reply);
    })
                    ? 1
                    : 0;
  EXPECT_EQ(welcomed, Watchers::kMax);
}

}  // namespace
}  // namespace tandem::server::test
