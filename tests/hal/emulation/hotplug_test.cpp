// Enumeration, selection and hotplug with the real libudev.
#include "hal/io/hotplug.h"

#include <gtest/gtest.h>

#include "hal/io/udev_rule.h"
#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
constexpr Duration kPatient = 20s;

TEST(HotplugMonitor, ReportsArrivalsAndRemovals) {
  Testbed bed;
  auto opened = hal::HotplugMonitor::open();
  ASSERT_TRUE(opened) << opened.error().message;
  hal::HotplugMonitor& watch = **opened;
  EXPECT_TRUE(watch.present().empty());
  UsbEcho model;
  UsbfsNode node(model);
  bed.plug(node, model, "1-2");
  const auto arrived = watch.wait(kPatient);
  ASSERT_EQ(arrived.size(), 1u);
  EXPECT_TRUE(arrived[0].arrived);
  EXPECT_EQ(arrived[0].device.port, "1-2");
  node.unplug();
  bed.remove("1-2");
  const auto left = watch.wait(kPatient);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_FALSE(left[0].arrived);
  EXPECT_EQ(left[0].device.instance, arrived[0].device.instance);
  EXPECT_TRUE(watch.present().empty());
}

TEST(HotplugMonitor, SeesAHidDeviceOnBothBuses) {
  Testbed bed;
  auto opened = hal::HotplugMonitor::open();
  ASSERT_TRUE(opened);
  HidEcho model;
  HidrawNode node(model);
  bed.plug(node, model, "1-4");
  std::vector<hal::HotplugEvent> all;
  while (all.size() < 2) {
    const auto some = (*opened)->wait(kPatient);
    ASSERT_FALSE(some.empty());
    all.insert(all.end(), some.begin(), some.end());
  }
  EXPECT_EQ((*opened)->present().size(), 2u);
  EXPECT_TRUE(std::ranges::any_of(
      all, [](const auto& c) { return c.device.bus == hal::Bus::kHidraw && c.device.port == "1-4"; }));
}

TEST(HotplugMonitor, ReportsBothChangesOfAReplugBetweenPolls) {
  Testbed bed;
  UsbEcho model;
  auto first = std::make_unique<UsbfsNode>(model);
  bed.plug(*first, model, "1-2");
  auto opened = hal::HotplugMonitor::open();
  ASSERT_TRUE(opened);
  EXPECT_EQ((*opened)->present().size(), 1u);
  first->unplug();
  bed.remove("1-2");
  model.plug_in();
  UsbfsNode second(model);
  bed.plug(second, model, "1-2");
  const auto changes = (*opened)->wait(kPatient);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_FALSE(changes[0].arrived);
  EXPECT_TRUE(changes[1].arrived);
  EXPECT_EQ(changes[0].device.port, changes[1].device.port);
}

TEST(HotplugMonitor, TreatsAReusedNodeNameAsAnotherDevice) {
  Testbed bed;
  HidEcho model;
  auto first = std::make_unique<HidrawNode>(model);
  bed.plug(*first, model, "1-2");
  auto opened = hal::HotplugMonitor::open();
  ASSERT_TRUE(opened);
  first->unplug();
  bed.remove("1-2");
  model.plug_in();
  HidrawNode second(model);
  bed.plug(second, model, "1-2");
  std::vector<hal::HotplugEvent> all;
  while (all.size() < 4) {  // removed and added, on both buses
    const auto some = (*opened)->wait(kPatient);
    ASSERT_FALSE(some.empty());
    all.insert(all.end(), some.begin(), some.end());
  }
  const auto raw = [](const hal::HotplugEvent& c) { return c.device.bus == hal::Bus::kHidraw; };
  EXPECT_EQ(std::ranges::count_if(all, raw), 2);
  EXPECT_EQ(std::ranges::find_if(all, raw)->device.node, "/dev/hidraw0");
  EXPECT_EQ(hal::list_hidraw().at(0).node, "/dev/hidraw0");
}

TEST(HotplugMonitor, ReportsNothingWithoutAChange) {
  Testbed bed;
  auto opened = hal::HotplugMonitor::open();
  ASSERT_TRUE(opened);
  EXPECT_TRUE((*opened)->wait(0ms).empty());
  EXPECT_TRUE((*opened)->wait(1200ms).empty()) << "looks once by itself";
}

struct SelectDevice : testing::Test {
  static hal::AttachedDevice one(const char* port, const char* serial, std::uint16_t product = 0xCB48) {
    hal::AttachedDevice a;
    a.ids = {0x0403, product};
    a.name = "FALCON HAPTIC";
    a.port = port;
    a.serial = serial;
    a.node = "/dev/bus/usb/001/004";
    return a;
  }
  std::vector<hal::AttachedDevice> list{one("1-1", "A"), one("1-2", "B"), one("1-3", "C", 0x6001)};
  hal::DeviceFilter falcon{"Novint Falcon", {{0x0403, 0xCB48}}, {}, {}, {}};
};

TEST_F(SelectDevice, SelectsByPortOrSerial) {
  falcon.port = "1-2";
  EXPECT_EQ(hal::select_device(list, falcon)->serial, "B");
  falcon.port.reset();
  falcon.serial = "A";
  EXPECT_EQ(hal::select_device(list, falcon)->port, "1-1");
  falcon.port = "1-2";
  EXPECT_FALSE(hal::select_device(list, falcon)) << "both must fit";
}

TEST_F(SelectDevice, SelectsNoDefaultAmongSeveral) {
  const auto chosen = hal::select_device(list, falcon);
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, hal::Errc::kBadState);
  EXPECT_EQ(chosen.error().message,
            "2 devices match Novint Falcon; select one: port=1-1 (0403:cb48 FALCON HAPTIC, serial A, at port 1-1), or "
            "port=1-2 (0403:cb48 FALCON HAPTIC, serial B, at port 1-2)");
  EXPECT_EQ(hal::select_device(std::span(list).subspan(1), falcon)->port, "1-2") << "the only one needs no words";
}

TEST_F(SelectDevice, ListsTheAttachedDevicesIfNoneMatches) {
  falcon.port = "2-9";
  const auto chosen = hal::select_device(std::span(list).last(1), falcon);
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, hal::Errc::kNotFound);
  EXPECT_EQ(chosen.error().message,
            "no Novint Falcon at port 2-9 is attached (USB id 0403:cb48); there are 0403:6001 FALCON HAPTIC, serial C, "
            "at port 1-3. Check its cable and its power");
  EXPECT_EQ(hal::select_device({}, falcon).error().message,
            "no Novint Falcon at port 2-9 is attached (USB id 0403:cb48); nothing is. Check its cable and its power");
}

TEST_F(SelectDevice, SelectsByUsageWhereIdsAreNotUnique) {
  list[0].usages = {{0x01, 0x02}};
  list[1].usages = {{0x01, 0x06}, {0xFFAB, 0x0200}};
  falcon.usage = hal::HidUsage{0xFFAB, 0x0200};
  EXPECT_EQ(hal::select_device(list, falcon)->port, "1-2");
}

TEST(UdevRule, IsOneLinePerBus) {
  EXPECT_EQ(hal::udev_rule(hal::Bus::kUsb, {0x0403, 0xCB48}),
            R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0660", TAG+="uaccess")");
  EXPECT_EQ(hal::udev_rule(hal::Bus::kHidraw, {0x256F, 0xC635}),
            R"(SUBSYSTEM=="hidraw", KERNELS=="*:256F:C635.*", MODE="0660", TAG+="uaccess")");
}

}  // namespace
}  // namespace tandem::test
