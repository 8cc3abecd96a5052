// The sessions of a server process, with their shards and a control server on loopback but without clients.
#include "server/app/process/session_table.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// A session of scene `lesson`, whose instructor's seat is required.
SessionOptions lesson(const std::string& name) {
  SessionOptions session{.name = name};
  session.scene = *parse_scene(find_shipped_scene("lesson")->text, "lesson.textproto");
  return session;
}

/// Returns options of a quiet server on a free port of 127.0.0.1 with ephemeral keys.
ServerOptions options_with(std::vector<SessionOptions> sessions) {
  ServerOptions options{.command = "serve", .sessions = std::move(sessions), .quiet = true};
  options.control.listen = *io::parse_address("127.0.0.1:0", 0);
  return options;
}

/// The table with all parts that a server process has around it.
class TableRig {
 public:
  explicit TableRig(ServerOptions given) : options(std::move(given)), shards(rates(options)) {
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
    ASSERT_TRUE(session.live_session().over());
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& session : table->all()) all.push_back(session->options().name);
    return all;
  }

  ServerOptions options;
  ServerOutput output{"serve", false, false};
  ShardPool shards;
  std::unique_ptr<ControlServer> control;
  std::optional<SessionTable> table;

 private:
  static std::vector<double> rates(const ServerOptions& options) {
    std::vector<double> all;
    for (const SessionOptions& session : options.sessions) all.push_back(session.scene.tick_hz);
    return all;
  }
  std::string folder_ = testing::TempDir() + "session_table_" + std::to_string(::getpid());
};

using Names = std::vector<std::string>;

TEST(SessionTable, OpensEverySessionInItsSlot) {
  TableRig rig(options_with({lesson("first"), lesson("second")}));
  EXPECT_TRUE(rig.table->all().empty()) << "nothing is open before `open`";
  ASSERT_EQ(rig.table->open(), 0);
  EXPECT_EQ(rig.names(), (Names{"first", "second"}));
  const auto& sessions = rig.table->all();
  EXPECT_NE(sessions[0]->id(), sessions[1]->id());
  for (std::size_t slot = 0; slot < 2; ++slot) {
    EXPECT_EQ(sessions[slot]->live_session().slot(), slot);
    EXPECT_EQ(sessions[slot]->epoch(), 1U);
    EXPECT_EQ(sessions[slot]->code(), "") << "clients of this user need no code with ephemeral keys";
  }
  const auto entries = rig.table->screen_entries();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[1].name, "second");
  EXPECT_EQ(rig.table->exit_code(), 0);
  EXPECT_FALSE(rig.table->will_resume()) << "there are no checkpoints";
}

TEST(SessionTable, ReportsASessionThatCannotBeOpened) {
  SessionOptions unwritable = lesson("second");
  unwritable.trace = "/nonexistent/trace.csv";
  TableRig rig(options_with({lesson("first"), unwritable, lesson("third")}));
  EXPECT_EQ(rig.table->open(), io::kExitUsage);
  EXPECT_EQ(rig.names(), Names{"first"}) << "the first error ends the server";
}

TEST(SessionTable, FinishesAllSessionsOfADrainWithoutAnError) {
  SessionOptions restarts = lesson("second");
  restarts.restart = true;
  TableRig rig(options_with({lesson("first"), restarts}));
  rig.start();
  rig.table->service(io::monotonic_now());
  EXPECT_EQ(rig.names(), (Names{"first", "second"})) << "no session is over";
  rig.table->drain();
  for (const auto& session : rig.table->all()) EXPECT_EQ(session->end, EndReason::kSignal);
  rig.shards.stop();
  rig.shards.join();
  rig.table->service(io::monotonic_now());
  EXPECT_TRUE(rig.table->all().empty()) << "a server that ends replaces no session";
  EXPECT_EQ(rig.table->exit_code(), io::kExitDone);
}

TEST(SessionTable, EndsASessionWhoseRequiredSeatsDoNotCome) {
  ServerOptions options = options_with({lesson("first")});
  options.start_timeout_s = 60;
  TableRig rig(std::move(options));
  rig.start();
  rig.table->service(io::monotonic_now() + 59s);
  EXPECT_FALSE(rig.table->all()[0]->end) << "59 of 60 s";
  rig.table->service(io::monotonic_now() + 61s);
  ASSERT_EQ(rig.table->all().size(), 1U);
  SessionInstance& session = *rig.table->all()[0];
  EXPECT_EQ(session.end, EndReason::kStartTimeout);
  EXPECT_NE(session.missing_seats.find("instructor"), std::string::npos) << session.missing_seats;
  rig.wait_until_over(session);
  rig.table->service(io::monotonic_now());
  EXPECT_TRUE(rig.table->all().empty());
  EXPECT_EQ(rig.table->exit_code(), io::kExitTrouble);
}

TEST(SessionTable, ReplacesAnEndedSessionThatRestarts) {
  SessionOptions restarts = lesson("lesson");
  restarts.restart = true;
  ServerOptions options = options_with({restarts});
  options.start_timeout_s = 60;
  TableRig rig(std::move(options));
  rig.start();
  SessionInstance& old = *rig.table->all()[0];
  const auth::Id16 id = old.id();
  rig.table->service(io::monotonic_now() + 61s);
  rig.wait_until_over(old);
  rig.table->service(io::monotonic_now());
  ASSERT_EQ(rig.names(), Names{"lesson"});
  const SessionInstance& next = *rig.table->all()[0];
  EXPECT_NE(next.id(), id);
  EXPECT_EQ(next.epoch(), 2U);
  EXPECT_FALSE(next.end);
  EXPECT_EQ(rig.table->exit_code(), 0) << "the code of a session that was replaced does not count";
}

}  // namespace
}  // namespace tandem::server
