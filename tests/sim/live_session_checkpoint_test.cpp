// The checkpoint that a live session writes for a restart, in virtual time.
#include <gtest/gtest.h>

#include "server/app/process/checkpoint_mailbox.h"
#include "tests/sim/hosted_hands.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;

using test::HostedHands;

TEST(LiveSessionCheckpoint, ContainsASessionFromItsFirstTickOn) {
  server::TickQueue records{64};
  HostedHands life(records);
  const io::EventFd wake;
  const auto mail = std::make_shared<server::CheckpointMailbox>(wake);
  life.hosted.persist_to(mail, 1);
  server::Checkpoint kept{};
  Time at = life.now;
  while (life.now < Time{} + 3s && !life.begun()) {
    at = life.now;
    life.step();
    static_cast<void>(mail->take(kept));
    EXPECT_EQ(kept.begun, life.begun()) << "at " << seconds(at - Time{}) << " s";
  }
  ASSERT_TRUE(life.begun()) << "else there is nothing to judge";
  EXPECT_NE((at - Time{}) % 500ms, 0ms) << "not by chance, with the regular one";
}

/// Without a report or trace a record is made at every 17th tick, as telemetry travels. Each stands for the ticks since
/// the one before, so a report counts the same time.
TEST(LiveSession, RecordsAtSixtyHertzWithoutAReport) {
  for (const bool recorded : {false, true}) {
    SCOPED_TRACE(recorded ? "with a report" : "without");
    server::TickQueue records{4096};
    HostedHands life(records);
    life.hosted.set_recorded(recorded);
    while (life.now < Time{} + 3s && !life.begun()) life.step();
    ASSERT_TRUE(life.begun());
    for (int tick = 0; tick < 1700; ++tick) life.step();
    std::size_t made = 0;
    std::uint32_t last = 0;
    for (; records.front() != nullptr; records.pop(), ++made) {
      const std::uint32_t tick = records.front()->tick;
      if (made > 0) {
        EXPECT_EQ(tick - last, recorded ? 1u : 17u);
      }
      last = tick;
    }
    EXPECT_NEAR(static_cast<double>(made), recorded ? 1700 : 100, 1);
    EXPECT_EQ(life.hosted.skipped_records(), 0u) << "no load was shed";
  }
}

TEST(LiveSession, CountsTheRecordsThatAReportLacksWhileLoadIsShed) {
  server::TickQueue records{4096};
  HostedHands life(records);
  life.hosted.set_recorded(true);
  while (life.now < Time{} + 3s && !life.begun()) life.step();
  ASSERT_TRUE(life.begun());
  while (records.front() != nullptr) records.pop();
  server::MachineStatus busy;
  busy.load_state.level = server::ShedLevel::kTelemetry;
  for (int tick = 0; tick < 100; ++tick) life.step(busy);
  std::size_t made = 0;
  for (; records.front() != nullptr; records.pop()) ++made;
  EXPECT_EQ(made, 10u);
  EXPECT_EQ(life.hosted.skipped_records(), 90u);
}

/// A stop changes the reported state; the session still reports that it waits for participants.
TEST(LiveSession, ReportsThatItWaitsWhileItIsStopped) {
  const SceneSpec scene = test::shipped("one_axis");
  server::TickQueue records{64};
  server::Checkpoint from{};
  {
    auto slaves = server::make_local_slaves(scene, Time{});
    ASSERT_TRUE(slaves);
    server::LiveSession first(scene, std::move(*slaves), 0, records);
    from = first.session().checkpoint();
  }
  from.begun = true;
  from.seats[0].taken = true;
  from.tools[0].alpha[0] = 1;
  auto slaves = server::make_local_slaves(scene, Time{});
  ASSERT_TRUE(slaves);
  server::LiveSession restored(scene, std::move(*slaves), 0, records, &from);
  Time now = Time{} + 1ms;
  const auto look = [&] {
    for (int n = 0; n < 64; ++n, now += 1ms) restored.tick(now, now, 0, {});
    return restored.status();
  };
  EXPECT_TRUE(look().waiting);
  ASSERT_TRUE(restored.session().stop_control().request(now, {AccessRole::kOperator}));
  const server::SessionStatus stopped = look();
  EXPECT_EQ(stopped.state, wire::SessionState::kStopped);
  EXPECT_TRUE(stopped.waiting) << "it waits for the required seats";
  ASSERT_EQ(restored.session().stop_control().resume(now, {AccessRole::kOperator},
                                                     restored.session().stop_control().latch().stops()),
            server::CommandResult::kDone);
  ASSERT_EQ(restored.session().stop_control().resume(now, {AccessRole::kOperator},
                                                     restored.session().stop_control().latch().stops()),
            server::CommandResult::kDone);  // resumes without the missing seats
  EXPECT_FALSE(look().waiting);
}

TEST(LiveSession, CountsEventsThatWereNotTakenInTime) {
  const SceneSpec scene = test::shipped("one_axis");
  auto slaves = server::make_local_slaves(scene, Time{});
  ASSERT_TRUE(slaves);
  server::TickQueue records{64};
  server::LiveSession hosted(scene, std::move(*slaves), 0, records);
  Time now = Time{} + 1ms;
  const auto stops = [&](int many) {  // each stop and its end are one event each
    for (int n = 0; n < many; ++n) {
      ASSERT_TRUE(hosted.session().stop_control().request(now, {AccessRole::kInstructor}));
      ASSERT_EQ(hosted.session().stop_control().resume(now, {AccessRole::kInstructor},
                                                       hosted.session().stop_control().latch().stops()),
                server::CommandResult::kDone);
    }
  };
  const auto told = [&] {
    for (int n = 0; n < 64; ++n, now += 1ms) hosted.tick(now, now, 0, {});
    return hosted.status().audit_dropped;
  };
  stops(100);
  EXPECT_EQ(told(), 0u);
  stops(server::AuditQueue::kCapacity / 2 + 5);  // within one tick
  EXPECT_EQ(told(), 10u);
  for (int n = 0; n < 10; ++n) {  // no thread takes the events
    stops(100);
    now += 1ms;
    hosted.tick(now, now, 0, {});
  }
  EXPECT_GT(told(), 10u + 1000u);
}

}  // namespace
}  // namespace tandem
