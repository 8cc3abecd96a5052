// The WoodenHaptics driver in a user's configuration, over the real hidapi, on its device model.
#include <gtest/gtest.h>

#include "hal/io/hid_pipe.h"
#include "hal/io/periodic_timer.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"
#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using hal::Errc;
using hal::Exchange;
using hal::woodenhaptics::WoodenHapticsDriver;

struct BoardSeat {
  explicit BoardSeat(Testbed& bed_, bool energise = true)
      : bed(bed_), model(WoodenHapticsFixture::at_calibration(wooden_2015(), {})) {
    node.with_model([&] { model.place(model.tip()); });
    bed.plug(node, model, "1-2");
    const hal::DeviceFilter wanted{"WoodenHaptics board", {}, {}, std::string(model.serial()), "1-2"};
    auto opened = hal::HidrawPipe::open(*hal::select_device(hal::list_hidraw(), wanted));
    EXPECT_TRUE(opened) << opened.error().message;
    pipe = std::move(*opened);
    driver = std::make_unique<WoodenHapticsDriver>(
        hal::DeviceId{"woodenhaptics", "1-2"}, *pipe, clock,
        hal::woodenhaptics::WoodenHapticsOptions{.spec = wooden_2015(), .enable_motors = energise});
  }
  ~BoardSeat() { bed.remove("1-2"); }

  template <class Do>
  auto with_model(Do&& act) {
    return node.with_model([&] { return act(model); });
  }

  hal::Result<> bring_up() {
    QuietBringUp watcher;
    return driver->bring_up(watcher);
  }
  std::expected<Exchange, Errc> tick(double effort = 0) {
    const hal::ServoCommand orders{.seq = ++seq, .effort = {effort, effort, effort}};
    const auto result = driver->exchange(orders, state);
    clock.wait_until(clock.now() + 1ms);
    return result;
  }
  bool home() {
    (void)tick();
    with_model([](auto& m) { m.press_calibration(); });
    for (int i = 0; i < 500 && !driver->homed(); ++i) (void)tick();
    return driver->homed();
  }
  bool recovers() {
    for (int i = 0; i < 500; ++i) {
      const auto result = tick();
      if (result && *result == Exchange::kFresh) return true;
    }
    return false;
  }
  Testbed& bed;
  hal::emulation::WoodenHapticsModel model;
  HidrawNode node{model};
  hal::MonotonicClock clock;
  std::unique_ptr<hal::HidrawPipe> pipe;
  std::unique_ptr<WoodenHapticsDriver> driver;
  hal::State state;
  std::uint64_t seq = 0;
};

TEST(BoardOnHidraw, IsHomedByItsButtonAndGivesCurrentOnlyThen) {
  Testbed bed;
  BoardSeat seat(bed);
  const auto up = seat.bring_up();
  ASSERT_TRUE(up) << up.error().message;
  for (int i = 0; i < 20; ++i) (void)seat.tick(0.02);
  EXPECT_EQ(seat.with_model([](auto& m) { return m.motor_effort().norm(); }), 0.0);
  ASSERT_TRUE(seat.home());
  double most = 0;
  for (int i = 0; i < 100; ++i) {
    (void)seat.tick(0.02);
    most = std::max(most, seat.with_model([](auto& m) { return m.motor_effort().norm(); }));
  }
  EXPECT_GT(most, 0.01);
  seat.driver->send_zeros();
  EXPECT_EQ(seat.with_model([](auto& m) { return m.motor_effort().norm(); }), 0.0);
}

TEST(BoardOnHidraw, RecoversTheServoAfterFaults) {
  Testbed bed;
  BoardSeat seat(bed);
  ASSERT_TRUE(seat.bring_up());
  ASSERT_TRUE(seat.home());
  seat.with_model([](auto& m) { m.faults.lost_reports = 3; });
  for (int i = 0; i < 10; ++i) (void)seat.tick();
  EXPECT_TRUE(seat.recovers());
  seat.with_model([](auto& m) { m.faults.odd_reports = 3; });
  for (int i = 0; i < 10; ++i) (void)seat.tick();
  EXPECT_TRUE(seat.recovers());
  seat.with_model([](auto& m) { m.faults.stalled_out = true; });
  EXPECT_EQ(error_of(seat.tick()), Errc::kProtocol);
  seat.with_model([](auto& m) { m.faults.stalled_out = false; });
  EXPECT_TRUE(seat.recovers());
}

TEST(BoardOnHidraw, EndsBootOrServoWhenUnpluggedAtAnyReport) {
  Testbed bed;
  for (unsigned at = 1; at <= 12; ++at) {
    SCOPED_TRACE(at);
    BoardSeat seat(bed);
    seat.node.unplug_at(at);
    std::optional<Errc> error;
    if (const auto up = seat.bring_up(); !up) error = up.error().code;
    for (int i = 0; i < 40 && !error; ++i) error = error_of(seat.tick());
    EXPECT_EQ(error, Errc::kUnplugged);
    EXPECT_EQ(error_of(seat.tick()), Errc::kUnplugged);
    seat.driver->send_zeros();
  }
}

TEST(BoardOnHidraw, StartsWithZerosAndUnhomedAfterReplug) {
  Testbed bed;
  {
    BoardSeat seat(bed);
    ASSERT_TRUE(seat.bring_up());
    ASSERT_TRUE(seat.home());
    for (int i = 0; i < 10; ++i) (void)seat.tick(0.02);
    seat.node.unplug();
    EXPECT_EQ(error_of(seat.tick(0.02)), Errc::kUnplugged);
  }
  BoardSeat again(bed);
  ASSERT_TRUE(again.bring_up());
  for (int i = 0; i < 10; ++i) (void)again.tick(0.02);
  EXPECT_FALSE(again.driver->homed());
  again.with_model([](auto& m) {
    for (std::size_t back = 0; back < std::min<std::uint64_t>(m.host_reports(), m.kRemembered); ++back) {
      EXPECT_EQ(m.host_report(back).current_ma, (std::array<std::int16_t, 3>{}));
    }
  });
}

}  // namespace
}  // namespace tandem::test
