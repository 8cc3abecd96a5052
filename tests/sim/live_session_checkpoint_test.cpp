// The checkpoint that a live session writes for a restart, in virtual time.
#include <gtest/gtest.h>

#include "client/seat/seat.h"
#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "server/app/process/checkpoint_mailbox.h"
#include "server/app/process/live_session.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;

TEST(LiveSessionCheckpoint, ContainsASessionFromItsFirstTickOn) {
  const SceneSpec scene = test::shipped("one_axis");
  auto slaves = server::make_local_slaves(scene, Time{});
  ASSERT_TRUE(slaves);
  server::TickQueue records{64};
  server::LiveSession hosted(scene, std::move(*slaves), 0, records);
  const io::EventFd wake;
  const auto mail = std::make_shared<server::CheckpointMailbox>(wake);
  hosted.persist_to(mail, 1);

  struct Hand {
    std::unique_ptr<hal::sim::SimDevice> device;
    std::unique_ptr<client::Seat> seat;
    hal::Command command;
  };
  std::vector<Hand> hands;
  Time now = Time{} + 1ms;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    auto device = hal::sim::SimDevice::make(
        {scene.seats[i].device, scene.seats[i].hand, scene.seats[i].environment, nullptr, now});
    ASSERT_TRUE(device);
    const hal::DeviceCaps caps = (*device)->caps();
    const auto joined = netsim::simulate_join(hosted.session(), now, i, caps, RandomKey{7}.derive(i), 0);
    ASSERT_TRUE(joined);
    hands.push_back(
        {std::move(*device), std::make_unique<client::Seat>(joined->setup, caps, joined->channel_params), {}});
  }

  std::array<std::byte, transport::kDatagramMax> buffer;
  const auto address = [](std::size_t i) {
    server::PeerAddress e;
    e.bytes[0] = static_cast<std::byte>(i + 1);
    e.size = 1;
    return e;
  };
  server::Checkpoint kept{};
  std::optional<Time> began;
  for (; now < Time{} + 3s && !began; now += 1ms) {
    for (std::size_t i = 0; i < hands.size(); ++i) {
      hands[i].device->advance(hands[i].command, 1ms);
      hands[i].command = hands[i].seat->on_servo(now, hands[i].device->state());
      while (const auto size = hands[i].seat->poll_transmit(now, buffer))
        hosted.session().on_datagram(now, address(i), std::span{buffer}.first(*size));
    }
    hosted.tick(now, 0, {});
    while (const auto out = hosted.session().poll_transmit(now, buffer))
      hands[std::to_integer<std::size_t>(out->to.bytes[0]) - 1].seat->on_datagram(now,
                                                                                  std::span{buffer}.first(out->size));
    static_cast<void>(mail->take(kept));
    if (hosted.session().start_condition().begun()) began = now;
    EXPECT_EQ(kept.begun, hosted.session().start_condition().begun()) << "at " << seconds(now - Time{}) << " s";
  }
  ASSERT_TRUE(began) << "else there is nothing to judge";
  EXPECT_NE((*began - Time{}) % 500ms, 0ms) << "not by chance, with the regular one";
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
    for (int n = 0; n < 64; ++n, now += 1ms) restored.tick(now, 0, {});
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
    for (int n = 0; n < 64; ++n, now += 1ms) hosted.tick(now, 0, {});
    return hosted.status().audit_dropped;
  };
  stops(100);
  EXPECT_EQ(told(), 0u);
  stops(server::AuditQueue::kCapacity / 2 + 5);  // within one tick
  EXPECT_EQ(told(), 10u);
  for (int n = 0; n < 10; ++n) {  // no thread takes the events
    stops(100);
    hosted.tick(now += 1ms, 0, {});
  }
  EXPECT_GT(told(), 10u + 1000u);
}

}  // namespace
}  // namespace tandem
