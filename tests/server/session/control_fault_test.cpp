// NaN inside the server's control step (tests/FAILURES.md): the tool goes one tick back, at rest. Two faults within a
// second stop the session.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "hal/sim/sim_device.h"
#include "server/session/session.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// A slave whose reading is NaN while `sick` is set.
class SickSlave : public hal::SteppedDevice {
 public:
  SickSlave(std::unique_ptr<hal::sim::SimDevice> sound, const bool* sick)
      : sound_(std::move(sound)), sick_(sick), state_(sound_->state()) {}
  [[nodiscard]] const hal::DeviceCaps& caps() const noexcept override { return sound_->caps(); }
  [[nodiscard]] const hal::State& state() const noexcept override { return state_; }
  void advance(const hal::Command& command, Duration dt) noexcept override {
    for (const double e : command.effort) finite_ = finite_ && std::isfinite(e);
    sound_->advance(command, dt);
    state_ = sound_->state();
    if (*sick_) state_.q[0] = state_.x[0] = std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] bool finite() const noexcept { return finite_; }  ///< all received commands were finite

 private:
  std::unique_ptr<hal::sim::SimDevice> sound_;
  const bool* sick_;
  hal::State state_;
  bool finite_ = true;
};

struct Rig {
  Rig() {
    AxisArray scale;
    scale.fill(1);
    auto one = std::make_unique<SickSlave>(
        std::move(*hal::sim::SimDevice::make({scene.tools[0].slave, {}, {}, nullptr, Time{}})), &sick);
    slave = one.get();
    std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
    slaves.push_back(std::move(one));
    session = std::make_unique<Session>(scene, std::move(slaves), scale);
    live(10);
  }
  void live(int ticks) {
    for (int n = 0; n < ticks; ++n, now += 1ms) {
      session->on_tick(now, 0);
      for (const double x : session->tool(0).position()) ASSERT_TRUE(std::isfinite(x));
      while (const auto e = session->audit().poll()) faults += e->what == AuditEvent::What::kFault ? 1 : 0;
    }
  }
  void fall_sick_for(int ticks) {
    sick = true;
    live(ticks);
    sick = false;
  }
  [[nodiscard]] bool stopped() const { return session->state() == wire::SessionState::kStopped; }

  SceneSpec scene = test::set_position("one_axis");  // its tool is a device, which can fail
  bool sick = false;
  SickSlave* slave = nullptr;
  std::unique_ptr<Session> session;
  Time now{1ms};
  int faults = 0;
};

TEST(ControlFault, RecoversFromASingleFaultWithoutAStop) {
  Rig rig;
  rig.fall_sick_for(1);
  rig.live(500);
  EXPECT_EQ(rig.session->tool(0).not_finite(), 1u);
  EXPECT_TRUE(rig.slave->finite());
  EXPECT_FALSE(rig.stopped());
}

TEST(ControlFault, StopsTheSessionAtTheSecondFaultWithinASecond) {
  Rig rig;
  rig.fall_sick_for(1);
  rig.live(900);
  EXPECT_FALSE(rig.stopped());
  rig.fall_sick_for(1);
  rig.live(2);
  EXPECT_TRUE(rig.stopped());
  EXPECT_EQ(rig.faults, 1);
  rig.live(3000);
  EXPECT_TRUE(rig.stopped()) << "latched";
  EXPECT_EQ(rig.session->stop_control().resume(rig.now, {AccessRole::kInstructor},
                                               rig.session->stop_control().latch().stops()),
            CommandResult::kDone);
  rig.live(2);
  EXPECT_FALSE(rig.stopped());
  EXPECT_TRUE(rig.slave->finite());
}

TEST(ControlFault, DoesNotStopTheSessionForFaultsMoreThanASecondApart) {
  Rig rig;
  for (int n = 0; n < 3; ++n) {
    rig.fall_sick_for(1);
    rig.live(1100);
  }
  EXPECT_FALSE(rig.stopped());
}

}  // namespace
}  // namespace tandem::server
