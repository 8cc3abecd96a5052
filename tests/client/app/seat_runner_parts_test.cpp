// The parts of a SeatRunner that join its threads or collect its status, each with a seat that no server answers.
#include <gtest/gtest.h>

#include "client/app/connection_swapper.h"
#include "client/app/seat_runner.h"
#include "client/app/seat_status_recorder.h"
#include "client/app/status_pace.h"
#include "client/app/user_commands.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/text/seat_setup.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

/// Seat `index` of the shipped scene `devices`.
Seat seat_of(std::size_t index = 0) {
  const auto scene = parse_scene(find_shipped_scene("devices")->text, "devices");
  EXPECT_TRUE(scene);
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 3;
  return {seat_setup(*scene, index), caps, {transport::Direction::kToServer, 1, 2}};
}

hal::State reading() {
  hal::State state;
  state.J.leftCols<3>().setIdentity();
  return state;
}

TEST(UserCommands, ReachTheSeatWithTheNextTickAndActOnce) {
  Seat seat = seat_of();
  UserCommands commands;
  EXPECT_FALSE(commands.apply(seat));
  commands.stop();
  commands.stop_all();
  commands.apply(seat);
  EXPECT_TRUE(seat.requests().locally_stopped());
  wire::StateMessage state;
  seat.requests().fill(state);
  EXPECT_TRUE(state.stop_all);
  seat.requests().resume();
  commands.apply(seat);
  EXPECT_FALSE(seat.requests().locally_stopped()) << "the earlier stop is spent";
}

TEST(UserCommands, LetAStopTakePrecedenceOverAResume) {
  Seat seat = seat_of();
  UserCommands commands;
  commands.stop();
  commands.resume();
  commands.apply(seat);
  EXPECT_TRUE(seat.requests().locally_stopped());
}

TEST(UserCommands, PassOnTheNewestRequestForAuthority) {
  Seat seat = seat_of();
  ASSERT_EQ(seat.setup().seat.role, Role::kInstructor);
  UserCommands commands;
  commands.change_authority({0.9, 0.1});
  commands.change_authority({0.8, 0.2});
  EXPECT_TRUE(commands.apply(seat));
  EXPECT_FALSE(commands.apply(seat));
  const auto message = seat.requests().take_authority(Time{1s});
  ASSERT_TRUE(message);
  EXPECT_EQ(message->masters, seat.setup().masters.size());
  EXPECT_EQ(message->alpha[0], 0.8);
}

TEST(ConnectionSwapper, PassesAConnectionThereAndTheOldOneBack) {
  ConnectionSwapper swapper;
  EXPECT_EQ(swapper.take_next(), nullptr);
  EXPECT_EQ(swapper.take_old(), nullptr);
  auto next = std::make_unique<ConnectionSwap>();
  ConnectionSwap* const offered = next.get();
  swapper.offer(std::move(next));
  EXPECT_EQ(swapper.take_old(), nullptr);
  std::unique_ptr<ConnectionSwap> taken = swapper.take_next();
  EXPECT_EQ(taken.get(), offered);
  EXPECT_EQ(swapper.take_next(), nullptr);
  swapper.return_old(std::move(taken));
  EXPECT_EQ(swapper.take_old().get(), offered);
}

TEST(StatusPace, PublishesEvery64thTickAndAllOfAClosedSeat) {
  StatusPace pace;
  int published = 0;
  for (int tick = 0; tick < 640; ++tick)
    if (pace.due(false)) {
      ++published;
      EXPECT_FALSE(pace.on_publish(true, false));
    }
  EXPECT_EQ(published, 10);
  for (int tick = 0; tick < 10; ++tick) {
    EXPECT_TRUE(pace.due(true));
    EXPECT_EQ(pace.on_publish(true, true), tick == 0) << "the end is signalled once";
  }
}

TEST(StatusPace, SignalsTheEndOnlyAfterTheStatusWithItIsPublished) {
  StatusPace pace;
  for (int tick = 0; tick < 3; ++tick) {
    EXPECT_TRUE(pace.due(true));
    EXPECT_FALSE(pace.on_publish(false, true)) << "another thread reads the status of before";
  }
  EXPECT_TRUE(pace.due(true));
  EXPECT_TRUE(pace.on_publish(true, true));
}

TEST(StatusPace, RepeatsTheFirstStatusOfAConnectionThatAReaderPrevented) {
  StatusPace pace;
  EXPECT_TRUE(pace.due(true));
  EXPECT_TRUE(pace.on_publish(true, true));
  pace.restart();
  EXPECT_TRUE(pace.due(false));
  EXPECT_FALSE(pace.on_publish(false, false));
  EXPECT_TRUE(pace.due(false));
  EXPECT_FALSE(pace.on_publish(true, false));
  EXPECT_FALSE(pace.due(false));
  EXPECT_TRUE(pace.due(true));
  EXPECT_TRUE(pace.on_publish(true, true)) << "the new connection ends too";
}

TEST(SeatRunner, PublishesTheStatusInTheFirstTickOfAConnection) {
  Seat seat = seat_of();
  const auto socket = [] { return io::connect_udp(*io::numeric_address("127.0.0.1:1", 1)).value(); };
  SeatRunner runner{socket(), seat, nullptr, {}, nullptr};
  static_cast<void>(runner.tick(reading()));
  runner.connections().offer(std::make_unique<ConnectionSwap>(
      ConnectionSwap{socket(), seat.prepare({transport::Direction::kToServer, 1, 3})}));
  static_cast<void>(runner.tick(reading()));
  EXPECT_EQ(runner.status().reconnects, 1U);
}

TEST(SeatStatusRecorder, CountsSilenceFromTheFirstTickOfEachConnection) {
  Seat seat = seat_of();
  SeatStatusRecorder recorder{1000};
  recorder.on_tick(Time{1s}, seat);
  EXPECT_DOUBLE_EQ(recorder.update(Time{3s}, seat).silence_s, 2);
  recorder.on_reconnect(Time{4s}, seat);
  EXPECT_DOUBLE_EQ(recorder.update(Time{5s}, seat).silence_s, 1);
  EXPECT_EQ(recorder.status().reconnects, 1U);
  EXPECT_FALSE(recorder.status().heard);
  EXPECT_LT(recorder.status().session_time, 0);
}

TEST(SeatStatusRecorder, SumsDatagramsOverConnectionsAndKeepsTheLargestForceAndHeat) {
  Seat seat = seat_of();
  SeatStatusRecorder recorder{1000};
  EXPECT_EQ(recorder.count_late_tick(true), 1U);
  EXPECT_EQ(recorder.count_late_tick(false), 1U);
  std::array<std::byte, transport::kDatagramMax> buffer;
  Time now{1s};
  const auto tick = [&](double force, double heat) {
    hal::State state = reading();
    state.f_out = {0, force, 0};
    state.heat = heat;
    static_cast<void>(seat.on_servo(now += 1ms, state));
    EXPECT_TRUE(seat.poll_transmit(now, buffer));
    recorder.on_tick(now, seat);
    recorder.update(now, seat);
  };
  tick(2, 0.5);
  tick(1, 0.25);
  EXPECT_EQ(recorder.status().link.datagrams.sent, 2U);
  EXPECT_DOUBLE_EQ(recorder.status().force_n, 1);
  EXPECT_DOUBLE_EQ(recorder.status().force_peak_n, 2);
  EXPECT_DOUBLE_EQ(recorder.status().motors.heat_max.value(), 0.5);
  recorder.on_reconnect(now, seat);
  seat.reconnect({transport::Direction::kToServer, 1, 3});
  tick(0, 0);
  EXPECT_EQ(recorder.status().link.datagrams.sent, 3U);
  EXPECT_EQ(recorder.status().late_ticks, 1U);
}

}  // namespace
}  // namespace tandem::client
