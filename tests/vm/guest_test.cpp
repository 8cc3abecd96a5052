// Runs as the only program of a virtual machine with Debian's kernel. Drivers, libusb, hidapi, usbfs, hidraw and udev
// are those of users; only the devices are emulated. The machine's time follows its instruction count, so that tests
// can assert times.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "common/base/histogram.h"
#include "hal/drivers/falcon/falcon_ftdi.h"
#include "hal/io/hid_pipe.h"
#include "hal/io/hotplug.h"
#include "hal/io/periodic_timer.h"
#include "hal/io/udev_rule.h"
#include "hal/io/usb_pipe.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"
#include "tests/vm/uhid_device.h"
#include "tests/vm/usbip_server.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using hal::Errc;
using hal::Exchange;

constexpr hal::UsbIds kFalcon{hal::kFalconVendor, hal::kFalconProduct};
constexpr unsigned kTicks = 2000;

/// Waits until a device with these ids is present with its final permissions, or (`there` false) absent. @return the
/// device, if present
std::optional<hal::AttachedDevice> settle(hal::HotplugMonitor& watch, hal::Bus bus, hal::UsbIds ids, bool there) {
  for (int tries = 0; tries < 50; ++tries) {
    for (const hal::AttachedDevice& a : watch.present()) {
      if (a.bus == bus && a.ids == ids) {
        if (there) return a;
        goto again;
      }
    }
    if (!there) return std::nullopt;
  again:
    (void)watch.wait(1s);
  }
  ADD_FAILURE() << "the kernel or udev did not " << (there ? "show" : "remove") << " the device";
  return std::nullopt;
}

struct Course {
  unsigned fresh = 0, nothing = 0, errors = 0;
  std::uint64_t missed = 0;
  Histogram round_trip;
};

/// Runs a servo as a device's thread does, for kTicks periods of 1 ms.
template <class Driver>
Course serve(Driver& driver, hal::State& state) {
  Course course;
  std::jthread([&] {
    hal::request_realtime();
    hal::MonotonicClock clock;
    hal::PeriodicTimer pace(1ms);
    pace.begin();
    for (unsigned i = 0; i < kTicks; ++i) {
      course.missed += pace.next().missed;
      const Time began = clock.now();
      const auto result = driver.exchange({.seq = i}, state);
      course.round_trip.add((clock.now() - began).count());
      if (!result)
        ++course.errors;
      else
        ++(*result == Exchange::kNothing ? course.nothing : course.fresh);
    }
  }).join();
  return course;
}

void print(const char* what, const Course& c) {
  std::printf(
      "[  guest   ] %s: 1000 Hz virtual, %u cycles, %llu missed, %u fresh, %u without a whole answer, %u errors; "
      "exchange p50 "
      "%.1f p99.9 %.1f max %.1f us\n",
      what, kTicks, static_cast<unsigned long long>(c.missed), c.fresh, c.nothing, c.errors,
      static_cast<double>(c.round_trip.quantile(0.5)) * 1e-3, static_cast<double>(c.round_trip.quantile(0.999)) * 1e-3,
      static_cast<double>(c.round_trip.max()) * 1e-3);
}

unsigned rights(const std::string& node) {
  struct stat status{};
  return stat(node.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
}

struct Guest : testing::Test {
  Guest() {
    auto opened = hal::HotplugMonitor::open();
    EXPECT_TRUE(opened);
    watch = std::move(*opened);
  }
  std::unique_ptr<hal::HotplugMonitor> watch;
};

TEST_F(Guest, FalconBootsThroughUsbfsServesAtOneKilohertzAndIsUnplugged) {
  hal::emulation::FalconModel model;
  UsbipServer server(model, 0);
  ASSERT_TRUE(server.attached());
  const auto device = settle(*watch, hal::Bus::kUsb, kFalcon, true);
  ASSERT_TRUE(device);
  EXPECT_FALSE(device->port.empty());
  EXPECT_EQ(rights(device->node), 0660u) << "the documented udev rule sets the rights";
  auto pipe = hal::LibusbPipe::open(*device, {0, hal::kFalconIn, hal::kFalconOut});
  ASSERT_TRUE(pipe) << pipe.error().message;
  const auto second = hal::LibusbPipe::open(*device);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);

  hal::MonotonicClock clock;
  auto driver = hal::FalconDriver::make({"falcon", device->port}, **pipe, clock,
                                        {hal::falcon::calibrated(), hal::falcon::some_firmware()});
  ASSERT_TRUE(driver);
  hal::falcon::Watcher watcher;
  const auto up = driver->bring_up(watcher);
  ASSERT_TRUE(up) << up.error().message;
  EXPECT_TRUE(
      server.with_model([&] { return model.running() && model.image() == hal::falcon::some_firmware().image; }));
  hal::State state;
  const Course course = serve(*driver, state);
  print("Falcon, vhci_hcd and usbfs, libusb", course);
  EXPECT_EQ(course.missed, 0u);
  EXPECT_EQ(course.errors, 0u);
  // If the bridge flushes during an answer (a tenth of the millisecond), the rest of the answer arrives with the next
  // exchange.
  EXPECT_GT(course.fresh, kTicks * 3 / 4);

  server.unplug();
  std::optional<Errc> error;
  for (int i = 0; i < 100 && !error; ++i) {
    if (const auto result = driver->exchange({}, state); !result) error = result.error();
    if (error == Errc::kProtocol) error.reset();  // transfers that failed before the kernel reported the unplugging
  }
  EXPECT_EQ(error, Errc::kUnplugged);
  (void)settle(*watch, hal::Bus::kUsb, kFalcon, false);
}

TEST_F(Guest, ReportsAFalconPluggedInAgainAsANewInstanceOnTheSamePort) {
  hal::emulation::FalconModel model(hal::falcon::ready_model());
  std::optional<hal::AttachedDevice> first;
  {
    UsbipServer server(model, 1);
    first = settle(*watch, hal::Bus::kUsb, kFalcon, true);
    ASSERT_TRUE(first);
  }
  (void)settle(*watch, hal::Bus::kUsb, kFalcon, false);
  model.plug_in();
  UsbipServer server(model, 1);
  const auto again = settle(*watch, hal::Bus::kUsb, kFalcon, true);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->port, first->port);
  EXPECT_NE(again->instance, first->instance);
  EXPECT_TRUE(hal::LibusbPipe::open(*again));
}

TEST_F(Guest, BoardOverHidrawServesAtOneKilohertzAndIsUnplugged) {
  hal::emulation::WoodenHapticsModel model(WoodenHapticsFixture::at_calibration(wooden_2015(), {}));
  model.place(model.tip());
  UhidDevice plug(model);
  ASSERT_TRUE(plug.attached());
  const hal::UsbIds ids{model.vendor_id(), model.product_id()};
  const auto device = settle(*watch, hal::Bus::kHidraw, ids, true);
  ASSERT_TRUE(device);
  EXPECT_EQ(device->serial, model.serial());
  EXPECT_EQ(rights(device->node), 0660u) << "the documented udev rule sets the rights";
  auto pipe = hal::HidrawPipe::open(*device);
  ASSERT_TRUE(pipe) << pipe.error().message;

  hal::MonotonicClock clock;
  hal::woodenhaptics::WoodenHapticsDriver driver({"woodenhaptics", device->serial}, **pipe, clock,
                                                 {.spec = wooden_2015(), .enable_motors = true});
  QuietBringUp watcher;
  const auto up = driver.bring_up(watcher);
  ASSERT_TRUE(up) << up.error().message;
  hal::State state;
  const Course course = serve(driver, state);
  print("WoodenHaptics board, uhid and hidraw, hidapi", course);
  EXPECT_EQ(course.missed, 0u);
  EXPECT_EQ(course.errors, 0u);
  EXPECT_GT(course.fresh, kTicks * 9 / 10);

  plug.unplug();
  std::optional<Errc> error;
  for (int i = 0; i < 100 && !error; ++i) {
    if (const auto result = driver.exchange({}, state); !result) error = result.error();
  }
  EXPECT_EQ(error, Errc::kUnplugged);
  (void)settle(*watch, hal::Bus::kHidraw, ids, false);
}

}  // namespace
}  // namespace tandem::test

/// `--rules`: prints the udev rules of the devices above. The guest's init installs them before udevd starts.
int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--rules") {
    constexpr tandem::hal::UsbIds kBoard{0x1234, 0x0006};
    std::printf("%s\n%s\n", tandem::hal::udev_rule(tandem::hal::Bus::kUsb, tandem::test::kFalcon).c_str(),
                tandem::hal::udev_rule(tandem::hal::Bus::kHidraw, kBoard).c_str());
    return 0;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
