// The sessions of a server process, with their shards and a control server on loopback but without clients.
#include "common/io/exit_code.h"
#include "tests/server/app/process/table_rig.h"

namespace tandem::server {
namespace {

using namespace test;

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
