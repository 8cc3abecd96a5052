// A hand presses on bone while its session moves between two threads, beside a hand whose session never moves.
// Ratios and counts of the two are compared, never durations.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/diagnostics/session_watch.h"
#include "client/seat/seat.h"
#include "common/io/clock.h"
#include "common/io/udp_socket.h"
#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "proto/text/scene_text.h"
#include "server/app/process/local_slaves.h"
#include "tests/io/machine_witness.h"
#include "tests/io/shard_pair.h"
#include "tests/support/press_scene.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

constexpr int kMoves = 20;
constexpr Duration kTick = 1ms;
constexpr Duration kLate = 1500us, kAfterLate = 30ms;
constexpr double kStepNoise = 5e-3;  // [N], far below what a hand notices; the steps of both vary with the machine
constexpr double kPressed = 2.4, kEnd = 6.6;  // [s] of session time: the hand is in contact, and its force changes

/// The scene of PressScene, but the hand presses more and less, once per second.
SceneSpec pressing() {
  PressScene press;
  press.duration_s = 30;
  press.silence_ms = 200;  // so that delays of a busy machine do not count as loss
  std::string text = press.text(), more;
  for (int i = 0; i < 9; ++i)
    more += " waypoint { at_s: " + std::to_string(2.5 + 0.5 * i) + " x_m: " + (i % 2 == 0 ? "0.04" : "0.02") + " }";
  const std::string last = "at_s: 2 x_m: 0.030000 }";
  text.insert(text.find(last) + last.size(), more);
  return *parse_scene(text, "pressing.textproto");
}

/// A session with its client: a simulated hand behind a socket, as a servo thread runs it.
class PressedSession {
 public:
  PressedSession(const SceneSpec& scene, std::uint8_t slot, ShardPair& shards)
      : session_(scene, *server::make_local_slaves(scene, Time{}), slot, records_),
        socket_(std::move(io::connect_udp(shards.shard(0).address())->fd)) {
    EXPECT_TRUE(shards.shard(0).add_session(session_));
    const SeatSpec& seat = scene.seats[0];
    hand_ = *hal::sim::SimDevice::make({seat.device, seat.hand, seat.environment, nullptr, io::monotonic_now()});
    const auto joined = netsim::simulate_join(session_.session(), io::monotonic_now(), 0, hand_->caps(),
                                              RandomKey{slot}, 0, false, slot);
    seat_.emplace(joined->setup, hand_->caps(), joined->channel_params);
  }
  /// One tick of the servo. @param measured  its force counts  @return session time [s]; nullopt: not known yet
  std::optional<double> tick(Time now, bool measured) {
    std::array<std::byte, transport::kDatagramMax> buffer;
    for (ssize_t size; (size = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
      seat_->on_datagram(now, std::span{buffer}.first(static_cast<std::size_t>(size)));
    const auto time = seat_->clock().session_time(now);
    hand_->set_session_time(time);
    while (hand_->state().sampled_at + kTick <= now) hand_->advance(command_, kTick);
    command_ = seat_->on_servo(now, hand_->state());
    while (const auto size = seat_->poll_transmit(now, buffer)) ::send(socket_.get(), buffer.data(), *size, 0);
    const double force = hand_->state().f_out[0];
    if (measured && time && *time > kPressed && *time < kEnd) {
      ++measured_;
      step_ = std::max(step_, std::abs(force - force_));
      least_ = std::min(least_, std::abs(force));
      most_ = std::max(most_, std::abs(force));
    }
    force_ = force;
    return time;
  }
  [[nodiscard]] server::LiveSession& session() { return session_; }
  [[nodiscard]] const client::Seat& seat() const { return *seat_; }
  /// Largest change of the force from one tick to the next, least and greatest force while the hand pressed [N].
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }
  [[nodiscard]] int measured() const { return measured_; }
  /// Session ticks of the records, of which none is lost.
  [[nodiscard]] std::vector<std::uint32_t> ticks() {
    std::vector<std::uint32_t> all;
    for (const server::TickRecord* record; (record = records_.front()) != nullptr; records_.pop())
      if (record->running) all.push_back(record->tick);
    EXPECT_EQ(records_.dropped(), 0U);
    return all;
  }

 private:
  server::TickQueue records_{60'000, 1, 1};
  server::LiveSession session_;
  io::Fd socket_;
  std::unique_ptr<hal::sim::SimDevice> hand_;
  std::optional<client::Seat> seat_;
  hal::Command command_;
  double step_ = 0, force_ = 0, least_ = 1e9, most_ = 0;
  int measured_ = 0;
};

/// A recorder's console, which gets TELEMETRY of the session in slot 0 at every tick.
class Recorder {
 public:
  Recorder(server::LiveSession& session, const io::SocketAddress& server)
      : watch_(
            server::telemetry_layout(session.scene()), kTick,
            netsim::simulate_watch_join(session.session(), io::monotonic_now(), RandomKey{9}, 1, true)->channel_params),
        socket_(std::move(io::connect_udp(server)->fd)) {}
  void tick(Time now) {
    std::array<std::byte, transport::kDatagramMax> buffer;
    for (ssize_t size; (size = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
      watch_.on_datagram(now, std::span{buffer}.first(static_cast<std::size_t>(size)));
    while (const auto size = watch_.poll_transmit(now, buffer)) ::send(socket_.get(), buffer.data(), *size, 0);
  }
  [[nodiscard]] const client::SessionWatch& watch() const { return watch_; }

 private:
  client::SessionWatch watch_;
  io::Fd socket_;
};

/// Number of ticks that a session left out between its first and its last one.
std::size_t gaps(const std::vector<std::uint32_t>& ticks) {
  for (std::size_t i = 1; i < ticks.size(); ++i)
    if (ticks[i] <= ticks[i - 1]) ADD_FAILURE() << "tick " << ticks[i] << " after " << ticks[i - 1];
  return ticks.empty() ? 0 : ticks.back() - ticks.front() + 1 - ticks.size();
}

/// @param judged  set if the machine allowed a judgement
void judge_moves(bool last, bool& judged) {
  const MachineWitness witness;
  const SceneSpec scene = pressing();
  ShardPair shards{scene.tick_hz};
  PressedSession moved{scene, 0, shards}, twin{scene, 1, shards};
  Recorder recorder{moved.session(), shards.shard(0).address()};
  const io::EventFd checkpoint_due;
  const auto mailbox = std::make_shared<server::CheckpointMailbox>(checkpoint_due);
  moved.session().persist_to(mailbox, 7);
  shards.run();
  int moves = 0, tries = 0;
  bool moving = false;
  const Time begin = io::monotonic_now();
  std::optional<double> time;
  Time late_until{};
  for (Time due = begin + kTick; due < begin + 60s && time.value_or(0) < kEnd; due += kTick) {
    std::this_thread::sleep_until(std::chrono::steady_clock::time_point(due.time_since_epoch()));
    const Time now = io::monotonic_now();
    // A command expires after some ticks, so a late thread of the hands lets both of them go for a moment.
    if (now - due > kLate) late_until = now + kAfterLate;
    time = moved.tick(now, now > late_until);
    twin.tick(now, now > late_until);
    recorder.tick(now);
    bool done = false;
    if (moving && shards.complete(done)) {
      moving = false;
      moves += done ? 1 : 0;
    }
    if (!moving && moves < kMoves && time.value_or(0) > kPressed + 0.2 * tries) {
      shards.begin_move(moved.session());
      moving = true;
      ++tries;
    }
  }
  shards.stop();
  EXPECT_EQ(moves, kMoves);
  const server::SessionStatus a = moved.session().final_status(), b = twin.session().final_status();
  const std::uint64_t stray = shards.shard(0).unmatched_datagrams() + shards.shard(1).unmatched_datagrams();
  std::printf(
      "[  moves   ] %d moves, %d ticks measured: largest step of the force %.4f N, twin %.4f N; forces %.2f ... %.2f "
      "N, twin %.2f ... "
      "%.2f "
      "N\n[  moves   ] missed ticks %llu, twin %llu; lost from the hand %llu, twin %llu; to the hand %llu, twin %llu; "
      "at no session %llu\n",
      moves, moved.measured(), moved.step(), twin.step(), moved.least(), moved.most(), twin.least(), twin.most(),
      static_cast<unsigned long long>(a.machine.missed_ticks), static_cast<unsigned long long>(b.machine.missed_ticks),
      static_cast<unsigned long long>(a.seats[0].lost), static_cast<unsigned long long>(b.seats[0].lost),
      static_cast<unsigned long long>(moved.seat().link().stats().lost()),
      static_cast<unsigned long long>(twin.seat().link().stats().lost()), static_cast<unsigned long long>(stray));
  // Whatever the machine does: nothing is lost beyond one datagram and one tick per move, and the session's count of
  // ticks goes on.
  EXPECT_LE(stray, static_cast<std::uint64_t>(kMoves));
  EXPECT_LE(a.seats[0].lost, b.seats[0].lost + kMoves);
  const std::vector<std::uint32_t> ticks = moved.ticks();
  ASSERT_FALSE(ticks.empty());
  EXPECT_LE(gaps(ticks), gaps(twin.ticks()) + a.machine.missed_ticks);
  EXPECT_LE(recorder.watch().statistics().lost(), static_cast<std::uint64_t>(kMoves));
  ASSERT_TRUE(recorder.watch().newest());
  EXPECT_NEAR(recorder.watch().newest()->session_tick, ticks.back(), 500) << "the console got TELEMETRY to the end";
  server::Checkpoint last_one;
  ASSERT_TRUE(mailbox->take(last_one));
  EXPECT_EQ(last_one.epoch, 7U);
  EXPECT_NEAR(last_one.session_tick, ticks.back(), 1) << "the last checkpoint is that of the last thread";
  EXPECT_NEAR(a.time, b.time, 0.05);
  // The hand whose session never moves presses with 0.2 to 0.4 N all the time, unless the machine delays it.
  if (witness.machine_stood_still() || twin.least() < 0.15 || 2e-3 * moved.measured() < kEnd - kPressed) return;
  const double step_max = 1.5 * twin.step() + kStepNoise;
  const double range = 0.1 * twin.most();
  const bool alike = std::abs(moved.most() - twin.most()) <= range && std::abs(moved.least() - twin.least()) <= range;
  if (!last && (moved.step() > step_max || !alike)) return;  // a disturbance of one hand; a fault shows every time
  EXPECT_GT(twin.most() - twin.least(), 0.1) << "the force must change, else no step could show";
  EXPECT_LE(moved.step(), step_max);
  EXPECT_NEAR(moved.most(), twin.most(), range);
  EXPECT_NEAR(moved.least(), twin.least(), range);
  EXPECT_LE(a.machine.missed_ticks, b.machine.missed_ticks + kMoves);
  judged = true;
}

TEST(SessionMoves, AreNotFeltByAHandInContact) {
  int sessions = 0;
  repeat_disturbed("SessionMoves, twenty moves in contact", [&] {
    bool judged = false;
    judge_moves(++sessions == kSessionsOfADisturbedMachine, judged);
    return judged;
  });
}

}  // namespace
}  // namespace tandem::test
