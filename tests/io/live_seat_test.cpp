// A seat in a program of one's own, against a real server: joins, runs until the server ends, leaves by request.
#include "client/app/live_seat.h"

#include <gtest/gtest.h>

#include <atomic>

#include "hal/io/sim_servo.h"
#include "tests/io/programs.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTimeout = 30s;

/// A handle of 0.1 kg on a line, at rest until its motor moves it.
class Handle final : public hal::SteppedDevice {
 public:
  Handle() {
    caps_.joints = caps_.tip_axes = 1;
    caps_.prismatic = caps_.simulated = true;
    caps_.axis[0].peak = 3.0;
    caps_.damping = 0.2;
    state_.J(0, 0) = 1;
  }
  const hal::DeviceCaps& caps() const noexcept override { return caps_; }
  const hal::State& state() const noexcept override { return state_; }
  void advance(const hal::Command& command, Duration dt) noexcept override {
    const double motor = command.expires > state_.sampled_at ? command.effort[0] : 0;
    state_.dq[0] = state_.dx[0] += (motor - state_.dx[0]) / 0.1 * seconds(dt);
    state_.q[0] = state_.x[0] += state_.dx[0] * seconds(dt);
    state_.tau_out[0] = state_.f_out[0] = motor;
    state_.sampled_at += dt;
    ++state_.seq;
  }

 private:
  hal::DeviceCaps caps_;
  hal::State state_;
};

/// A joined seat whose device runs.
struct Joined {
  explicit Joined(const std::string& server) {
    auto handle = std::make_unique<Handle>();
    auto joined = LiveSeat::join({.server = server, .seat = "trainer"}, handle->caps());
    if (!joined) {
      ADD_FAILURE() << joined.error();
      return;
    }
    seat = std::move(*joined);
    device = std::make_unique<hal::SimServo>(std::move(handle), hal::DeviceId{"handle", "1"}, 1ms);
    EXPECT_TRUE(device->start(*seat));
    EXPECT_TRUE(device->enable());
  }
  ~Joined() { device.reset(); }  // before the seat
  /// Waits until the status satisfies `condition`. @return false: the seat closed, or the time is over
  template <class Condition>
  [[nodiscard]] bool reaches(Condition condition) const {
    for (Duration t{}; t < kTimeout; t += 10ms) {
      if (condition(seat->status())) return true;
      if (seat->wait_until_closed(10ms)) return condition(seat->status());
    }
    return false;
  }
  std::unique_ptr<LiveSeat> seat;
  std::unique_ptr<hal::SimServo> device;
};

bool runs(const ClientStatus& status) { return status.session == wire::SessionState::kRunning; }

TEST(LiveSeat, RunsUntilTheServerEndsTheSession) {
  test::Process server = test::hosting("one_axis", {"--duration", "1", "--quiet"});
  const Joined own{test::address_of(server)};
  ASSERT_TRUE(own.seat);
  EXPECT_EQ(own.seat->setup().seat.name, "trainer");
  EXPECT_EQ(own.seat->setup().dof, 1U);
  ASSERT_TRUE(own.reaches(runs)) << server.err();
  ASSERT_TRUE(own.seat->wait_until_closed(kTimeout));
  EXPECT_EQ(own.seat->status().close_reason, wire::CloseReason::kDone);
  EXPECT_GT(own.seat->status().link.datagrams.accepted, 100U);
  EXPECT_EQ(server.wait(), 0) << server.err();
}

TEST(LiveSeat, StopsResumesAndLeavesByRequest) {
  test::Process server = test::hosting("one_axis", {"--duration", "600", "--quiet"});
  const Joined own{test::address_of(server)};
  ASSERT_TRUE(own.seat);
  ASSERT_TRUE(own.reaches([](const ClientStatus& s) { return s.gate == wire::GateState::kActive; }));
  EXPECT_FALSE(own.seat->wait_until_closed(0ms));
  own.seat->stop();
  EXPECT_TRUE(own.reaches([](const ClientStatus& s) { return s.local_stop && s.gate != wire::GateState::kActive; }));
  own.seat->resume();
  EXPECT_TRUE(own.reaches([](const ClientStatus& s) { return !s.local_stop && s.gate == wire::GateState::kActive; }));
  own.seat->stop_all();
  EXPECT_TRUE(own.reaches([](const ClientStatus& s) { return s.session == wire::SessionState::kStopped; }));
  own.seat->resume();
  EXPECT_TRUE(own.reaches(runs));
  own.seat->leave();
  ASSERT_TRUE(own.seat->wait_until_closed(kTimeout));
  EXPECT_TRUE(own.seat->status().closed);
}

TEST(LiveSeat, CountsAsClosedWhenItsDeviceIsLost) {
  test::Process server = test::hosting("one_axis", {"--duration", "600", "--quiet"});
  const Joined own{test::address_of(server)};
  ASSERT_TRUE(own.seat);
  own.device->unplug();
  EXPECT_TRUE(own.seat->wait_until_closed(kTimeout));
}

/// Passes a device's exchanges on to a seat, and moves its phase itself while the seat is content with it.
class Witness final : public hal::ServoClient {
 public:
  explicit Witness(LiveSeat& seat) : seat_(seat) {}
  hal::Command tick(const hal::State& state) noexcept override { return seat_.tick(state); }
  void lost(hal::Errc why) noexcept override { seat_.lost(why); }
  Duration next_shift() noexcept override {
    const Duration asked = seat_.next_shift();
    if (asked != Duration{}) shifted = true;
    return ++ticks_ % 500 < 50 ? 10us : asked;
  }
  std::atomic<bool> shifted{false};

 private:
  LiveSeat& seat_;
  int ticks_ = 0;
};

TEST(LiveSeat, ShiftsItsTicksTowardsThoseOfTheServer) {
  test::Process server = test::hosting("one_axis", {"--duration", "600", "--quiet"});
  auto handle = std::make_unique<Handle>();
  auto seat = LiveSeat::join({.server = test::address_of(server), .seat = "trainer"}, handle->caps());
  ASSERT_TRUE(seat) << seat.error();
  Witness witness{**seat};
  hal::SimServo device{std::move(handle), hal::DeviceId{"handle", "1"}, 1ms};
  ASSERT_TRUE(device.start(witness));
  for (Duration t{}; t < kTimeout && !witness.shifted; t += 10ms) static_cast<void>((*seat)->wait_until_closed(10ms));
  EXPECT_TRUE(witness.shifted);
}

TEST(LiveSeat, ReportsWhyAJoinFailed) {
  const hal::DeviceCaps caps = Handle{}.caps();
  const auto no_port = LiveSeat::join({.server = "127.0.0.1", .seat = "trainer"}, caps);
  ASSERT_FALSE(no_port);
  EXPECT_NE(no_port.error().find("server: "), std::string::npos) << no_port.error();
  const auto nobody = LiveSeat::join({.server = "127.0.0.1:1", .seat = "trainer", .timeout = 200ms}, caps);
  ASSERT_FALSE(nobody);
  EXPECT_NE(nobody.error().find("no server at 127.0.0.1:1"), std::string::npos) << nobody.error();
  test::Process server = test::hosting("one_axis", {"--quiet"});
  const auto no_seat = LiveSeat::join({.server = test::address_of(server), .seat = "pilot"}, caps);
  ASSERT_FALSE(no_seat);
  EXPECT_NE(no_seat.error().find("--seat pilot"), std::string::npos) << no_seat.error();
}

}  // namespace
}  // namespace tandem::client
