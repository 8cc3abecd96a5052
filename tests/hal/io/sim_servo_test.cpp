#include "hal/io/sim_servo.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <thread>
#include <utility>

#include "hal/core/port_map.h"
#include "hal/io/open_sim_device.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Client that pushes with 1 N along x and records its readings.
class Pusher final : public ServoClient {
 public:
  Command tick(const State& s) noexcept override {
    if (ticks > 0 && s.sampled_at <= last_) backwards = true;
    last_ = s.sampled_at;
    if (s.f_out.norm() > 0.5) forces.fetch_add(1);
    Command c;
    c.seq = s.seq + 1;
    c.kind = CommandKind::kJointEffort;
    c.expires = poison ? Time{} : s.sampled_at + 1s;
    c.effort = PortMap(PortSpace::kTip, 3, 3).joint_effort(s, {1, 0, 0});
    ticks.fetch_add(1);
    ticks.notify_all();
    return c;
  }
  void lost(Errc e) noexcept override {
    lost_with = static_cast<int>(e);
    lost_with.notify_all();
  }
  /// Waits for `n` more ticks, however long the machine takes.
  void await(int n) {
    const int goal = ticks.load() + n;
    for (int t = ticks.load(); t < goal; t = ticks.load()) ticks.wait(t);
  }

  std::atomic<int> ticks{0}, forces{0}, lost_with{-1};
  std::atomic<bool> backwards{false}, poison{false};

 private:
  Time last_{};
};

LiveSim live() {
  HandSpec leader;
  leader.model = HandModel::kLeader;
  return make_live(std::move(*open_sim_device("sim", SimDeviceSpec{}, leader)));
}

TEST(SimServo, PassesThroughItsStates) {
  Pusher client;
  auto sim = live();
  Device& d = *sim.device;
  EXPECT_EQ(d.phase(), Phase::kIdentified);
  EXPECT_EQ(d.enable().error().code, Errc::kBadState);
  ASSERT_TRUE(d.start(client).has_value());
  EXPECT_EQ(d.phase(), Phase::kReady);
  EXPECT_EQ(d.start(client).error().code, Errc::kBadState);
  client.await(20);
  EXPECT_EQ(client.forces.load(), 0) << "Ready means zero force whatever is asked";
  ASSERT_TRUE(d.enable().has_value());
  EXPECT_EQ(d.phase(), Phase::kEnabled);
  client.await(20);
  EXPECT_GE(client.forces.load(), 10);
  d.disable();
  EXPECT_EQ(d.phase(), Phase::kReady);
  client.await(3);
  const int before = client.forces.load();
  client.await(10);
  EXPECT_EQ(client.forces.load(), before);
  d.close();
  EXPECT_EQ(d.phase(), Phase::kAbsent);
  const int ticks = client.ticks.load();
  EXPECT_EQ(d.stats().ticks, static_cast<std::uint64_t>(ticks));
  EXPECT_EQ(d.start(client).error().code, Errc::kBadState);
  d.close();
  EXPECT_FALSE(client.backwards.load());
  EXPECT_GT(d.stats().period_p50_s, 0.0);
  EXPECT_EQ(sim.sim->ground_truth().x.allFinite(), true);
}

TEST(SimServo, CountsExpiredCommandsAndGivesNoForceForThem) {
  Pusher client;
  client.poison = true;
  auto sim = live();
  ASSERT_TRUE(sim.device->start(client).has_value());
  ASSERT_TRUE(sim.device->enable().has_value());
  client.await(30);
  sim.device->close();
  EXPECT_EQ(client.forces.load(), 0);
  EXPECT_GE(sim.device->stats().expired, 25u);
}

TEST(SimServo, LosesAnUnpluggedDeviceForGood) {
  Pusher client;
  auto sim = live();
  auto& servo = dynamic_cast<SimServo&>(*sim.device);
  ASSERT_TRUE(servo.start(client).has_value());
  ASSERT_TRUE(servo.enable().has_value());
  client.await(5);
  servo.unplug();
  client.lost_with.wait(-1);
  EXPECT_EQ(client.lost_with.load(), static_cast<int>(Errc::kUnplugged));
  EXPECT_EQ(servo.phase(), Phase::kLost);
  EXPECT_FALSE(servo.enable().has_value());
  EXPECT_EQ(servo.reset().error().code, Errc::kBadState);
  EXPECT_EQ(servo.phase(), Phase::kLost);
}

TEST(SimServo, KeepsDeviceTimeOnSchedule) {
  Pusher client;
  auto sim = live();
  ASSERT_TRUE(sim.device->start(client).has_value());
  client.await(100);
  sim.device->close();
  const auto s = sim.device->stats();
  // Every period was stepped, including those the machine missed, plus one at the end with zero effort.
  EXPECT_EQ(sim.sim->counts().ticks, s.ticks + s.missed + 1);
}

/// Device that only counts its time.
class Clockwork final : public SteppedDevice {
 public:
  const DeviceCaps& caps() const noexcept override { return caps_; }
  const State& state() const noexcept override { return state_; }
  void advance(const Command&, Duration dt) noexcept override { state_.sampled_at += dt; }

 private:
  DeviceCaps caps_;
  State state_;
};

/// Client that asks for a shift of every period, and compares each period with the one before.
class Shifter final : public ServoClient {
 public:
  Shifter(const Clockwork& device, Duration asked, Duration granted)
      : device_(device), asked_(asked), granted_(granted) {}
  Command tick(const State& s) noexcept override {
    const Duration period = s.sampled_at - last_, stepped = device_.state().sampled_at - last_device_;
    last_ = s.sampled_at, last_device_ = device_.state().sampled_at;
    if (ticks > 0 && (period - granted_) % 1ms != Duration{}) wrong.fetch_add(1);
    if (ticks > 0 && period < 200ms && std::chrono::abs(stepped - period) > 200ns) wrong.fetch_add(1);
    ticks.fetch_add(1);
    ticks.notify_all();
    return {};
  }
  Duration next_shift() noexcept override { return asked_; }
  void lost(Errc) noexcept override {}

  std::atomic<int> ticks{0}, wrong{0};

 private:
  const Clockwork& device_;
  Duration asked_, granted_;
  Time last_{}, last_device_{};
};

TEST(SimServo, ShiftsItsPeriodAsItsClientAsksByAtMostOnePercent) {
  const std::pair<Duration, Duration> cases[] = {{4us, 4us}, {-4us, -4us}, {1ms, 10us}, {-1s, -10us}};
  for (const auto& [asked, granted] : cases) {
    auto device = std::make_unique<Clockwork>();
    Shifter client{*device, asked, granted};
    SimServo servo{std::move(device), DeviceId{"clockwork", "1"}, 1ms};
    ASSERT_TRUE(servo.start(client));
    for (int t = 0; t < 50; t = client.ticks.load()) client.ticks.wait(t);
    servo.close();
    EXPECT_EQ(client.wrong.load(), 0) << asked;
  }
}

}  // namespace
}  // namespace tandem::hal
