// The Falcon's driver in a user's configuration, over the real libusb, on its device model: boot, faults, unplugging at
// every phase.
// Times are the machine's, so the tests assert outcomes, not durations.
#include <gtest/gtest.h>

#include "hal/drivers/falcon/falcon_ftdi.h"
#include "hal/io/periodic_timer.h"
#include "hal/io/usb_pipe.h"
#include "tests/common/base/counts.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"
#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using hal::Errc;
using hal::Exchange;
using hal::falcon::Watcher;

/// A plugged-in Falcon, opened by its driver through the operating system.
struct FalconSeat {
  explicit FalconSeat(Testbed& bed_, const hal::emulation::FalconModelSpec& spec) : bed(bed_), model(spec) {
    bed.plug(node, model, "1-2");
    const hal::DeviceFilter wanted{"Novint Falcon", {{hal::kFalconVendor, hal::kFalconProduct}}, {}, {}, {}};
    auto opened =
        hal::LibusbPipe::open(*hal::select_device(hal::list_usb(), wanted), {0, hal::kFalconIn, hal::kFalconOut});
    EXPECT_TRUE(opened) << opened.error().message;
    pipe = std::move(*opened);
    driver.emplace(*hal::FalconDriver::make({"falcon", "1-2"}, *pipe, clock,
                                            {hal::falcon::calibrated(), hal::falcon::some_firmware()}));
  }
  ~FalconSeat() { bed.remove("1-2"); }

  hal::Result<> bring_up() {
    Watcher watcher;
    return driver->bring_up(watcher);
  }
  std::expected<Exchange, Errc> tick(const hal::ServoCommand& command = {}) {
    const auto result = driver->exchange(command, state);
    clock.wait_until(clock.now() + 1ms);
    return result;
  }
  /// Performs exchanges until a fresh reading. @return false: none in many exchanges
  bool recovers() {
    for (int i = 0; i < 500; ++i) {
      const auto result = tick(push);
      if (result && *result == Exchange::kFresh) return true;
    }
    return false;
  }
  template <class Do>
  auto with_model(Do&& act) {
    return node.with_model([&] { return act(model); });
  }

  Testbed& bed;
  hal::emulation::FalconModel model;
  UsbfsNode node{model};
  hal::MonotonicClock clock;
  std::unique_ptr<hal::LibusbPipe> pipe;
  std::optional<hal::FalconDriver> driver;
  hal::State state;
  hal::ServoCommand push{.seq = 1, .effort = {0.02, 0.02, 0.02}};
};

TEST(FalconOnLibusb, BootsFromItsFileDespiteFaultsAndThenServes) {
  Testbed bed;
  FalconSeat seat(bed, {});
  seat.with_model([](auto& m) {
    m.faults.deaf_greetings = 1;
    m.faults.wrong_echoes = 1;  // a mismatch between image and echo restarts the loading
  });
  const auto up = seat.bring_up();
  ASSERT_TRUE(up) << up.error().message;
  EXPECT_GE(seat.driver->boot_attempts(), 2);
  EXPECT_TRUE(seat.with_model([](auto& m) { return m.running() && m.image() == hal::falcon::some_firmware().image; }));
  EXPECT_TRUE(seat.recovers());
  EXPECT_EQ(seat.with_model([](auto& m) { return m.unsafe_frames(); }), 0u)
      << "not homed: no force, though it was asked for";
}

TEST(FalconOnLibusb, KeepsRunningFirmwareAndDeliversForces) {
  Testbed bed;
  FalconSeat seat(bed, hal::falcon::ready_model());
  ASSERT_TRUE(seat.bring_up());
  EXPECT_EQ(seat.driver->boot_attempts(), 0);
  ASSERT_TRUE(seat.recovers());
  seat.with_model([](auto& m) { m.mechanics().set_pull({.k = 1e4, .b = 100, .m = 1, .x = m.mechanics().tip()}); });
  // 0.02 N m at 10000 counts per N m, with the sign of the motors.
  bool arrived = false;
  for (int i = 0; i < 200 && !arrived; ++i) {
    (void)seat.tick(seat.push);
    arrived = seat.with_model([](auto& m) { return std::abs(m.order().motor[0]) == 200; });
  }
  EXPECT_TRUE(arrived);
  seat.driver->send_zeros();
  EXPECT_EQ(seat.with_model([](auto& m) { return m.order().motor; }), (std::array<std::int16_t, 3>{}));
}

TEST(FalconOnLibusb, RecoversTheServoAfterEveryLineFault) {
  struct Fault {
    const char* name;
    std::function<void(hal::emulation::FalconFaults&)> make;
  };
  const std::vector<Fault> faults{
      {"short", [](auto& f) { f.short_replies = 3; }},     {"glued", [](auto& f) { f.glued_replies = 2; }},
      {"split", [](auto& f) { f.split_replies = 3; }},     {"noise", [](auto& f) { f.noise_bytes = 9; }},
      {"flipped", [](auto& f) { f.flipped_replies = 3; }}, {"lost", [](auto& f) { f.lost_replies = 3; }},
      {"stall out", [](auto& f) { f.stall_out = 1; }},     {"stall in", [](auto& f) { f.stall_in = 1; }}};
  Testbed bed;
  FalconSeat seat(bed, hal::falcon::ready_model());
  ASSERT_TRUE(seat.bring_up());
  // A hand holds the grip. On a slow machine the push would otherwise drive it to its stops, where counts have no pose.
  seat.with_model([](auto& m) { m.mechanics().set_pull({.k = 1e4, .b = 100, .m = 1, .x = m.mechanics().tip()}); });
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.name);
    seat.with_model([&](auto& m) { fault.make(m.faults); });
    for (int i = 0; i < 20; ++i) {
      const auto result = seat.tick(seat.push);
      const Errc error = result ? Errc::kProtocol : result.error();
      EXPECT_TRUE(error == Errc::kProtocol || error == Errc::kTimeout || error == Errc::kFraming) << to_string(error);
      EXPECT_EQ(seat.state.buttons, 0u) << "a ghost";
    }
    EXPECT_TRUE(seat.recovers());
  }
  EXPECT_EQ(seat.with_model([](auto& m) { return m.unsafe_frames(); }), 0u);
}

TEST(FalconOnLibusb, ReportsNothingUntilASilentDeviceResponds) {
  Testbed bed;
  FalconSeat seat(bed, hal::falcon::ready_model());
  ASSERT_TRUE(seat.bring_up());
  seat.with_model([](auto& m) { m.faults.silent = true; });
  for (int i = 0; i < 5; ++i) (void)seat.tick();  // replies in transit
  for (int i = 0; i < 10; ++i) {
    const auto result = seat.tick();
    ASSERT_TRUE(result);
    EXPECT_EQ(*result, Exchange::kNothing);
  }
  seat.with_model([](auto& m) { m.faults.silent = false; });
  EXPECT_TRUE(seat.recovers());
}

/// Reset, greeting, speed, image, probe: tests every one of the first transfers and some of the image's.
TEST(FalconOnLibusb, ReportsUnpluggingAtAnyTransferOfTheBoot) {
  Testbed bed;
  for (const unsigned at : {1u, 2u, 3u, 5u, 8u, 13u, 21u, 34u, 55u, 89u, 144u, 233u}) {
    SCOPED_TRACE(at);
    FalconSeat seat(bed, {});
    seat.node.unplug_at(at);
    const auto up = seat.bring_up();
    ASSERT_FALSE(up);
    EXPECT_EQ(up.error().code, Errc::kUnplugged) << up.error().message;
    EXPECT_FALSE(seat.driver->exchange({}, seat.state));
  }
}

TEST(FalconOnLibusb, EndsTheExchangeWhenUnpluggedAtAnyTransfer) {
  Testbed bed;
  for (unsigned at = 1; at <= 8; ++at) {
    SCOPED_TRACE(at);
    FalconSeat seat(bed, hal::falcon::ready_model());
    ASSERT_TRUE(seat.bring_up());
    seat.node.unplug_at(at);
    std::optional<Errc> error;
    for (int i = 0; i < 20 && !error; ++i) error = error_of(seat.tick(seat.push));
    EXPECT_EQ(error, Errc::kUnplugged);
    EXPECT_EQ(error_of(seat.tick(seat.push)), Errc::kUnplugged);
    seat.driver->send_zeros();  // harmless
  }
}

}  // namespace
}  // namespace tandem::test
