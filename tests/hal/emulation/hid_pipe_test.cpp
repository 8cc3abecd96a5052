// The hidraw pipe with the real hidapi and libudev, against an emulated device.
#include "hal/io/hid_pipe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <thread>

#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"
#include "tests/support/alloc_guard.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using hal::Errc;
using hal::HidrawPipe;

constexpr Duration kPatient = 5s;

std::vector<std::byte> report(int first) {
  std::vector<std::byte> out(14);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<std::byte>(static_cast<std::size_t>(first) + i);
  return out;
}

/// Returns the bytes of a read; repeats it while the emulated node wakes the pipe without data.
std::vector<std::byte> next(HidrawPipe& pipe) {
  std::array<std::byte, 64> into{};
  for (int tries = 0; tries < 100; ++tries) {
    const auto got = pipe.read(into, kPatient);
    if (!got) return {};
    if (*got > 0) return {into.begin(), into.begin() + static_cast<std::ptrdiff_t>(*got)};
  }
  return {};
}

struct HidPipe : testing::Test {
  HidPipe() { bed.plug(node, model, "1-2"); }

  hal::AttachedDevice attached() {
    const auto list = hal::list_hidraw();
    EXPECT_EQ(list.size(), 1u);
    return list.empty() ? hal::AttachedDevice{} : list.front();
  }
  std::unique_ptr<HidrawPipe> open() {
    auto pipe = HidrawPipe::open(attached());
    EXPECT_TRUE(pipe) << pipe.error().message;
    return pipe ? std::move(*pipe) : nullptr;
  }

  HidEcho model;
  Testbed bed;
  HidrawNode node{model};
};

TEST_F(HidPipe, IsListedWithNamesUsageAndPortBeforeItIsOpened) {
  const auto device = attached();
  EXPECT_EQ(device.bus, hal::Bus::kHidraw);
  EXPECT_EQ(device.ids, (hal::UsbIds{0x1234, 0x0006}));
  EXPECT_EQ(device.maker, "Tandem");
  EXPECT_EQ(device.name, "HID DEVICE");
  EXPECT_EQ(device.serial, "H3");
  EXPECT_EQ(device.port, "1-2");
  EXPECT_EQ(device.node, "/dev/hidraw0");
  EXPECT_EQ(device.interface_number, 0);
  EXPECT_EQ(device.usages, (std::vector<hal::HidUsage>{{0xFFAB, 0x0200}}));
}

TEST_F(HidPipe, CarriesReportsInLockStepWithoutHeap) {
  auto pipe = open();
  ASSERT_TRUE(pipe);
  std::array<std::byte, 64> into{};
  const auto sent = report(3);
  int wrong = 0;
  const AllocGuard heap;
  const auto inside_before = Node::heap_inside();
  for (int i = 0; i < 300; ++i) {
    wrong += pipe->write(sent).value_or(0) == sent.size() ? 0 : 1;
    std::size_t got = 0;
    for (int tries = 0; got == 0 && tries < 100; ++tries) got = pipe->read(into, kPatient).value_or(1000);
    wrong += got == sent.size() && std::equal(sent.begin(), sent.end(), into.begin()) ? 0 : 1;
  }
  EXPECT_EQ(heap.count() - (Node::heap_inside() - inside_before), 0u);
  EXPECT_EQ(wrong, 0);
}

TEST(HidNumbered, KeepsTheIdOfReports) {
  HidEcho model(true);
  Testbed bed;
  HidrawNode node(model);
  bed.plug(node, model, "1-2");
  auto pipe = HidrawPipe::open(hal::list_hidraw().at(0));
  ASSERT_TRUE(pipe) << pipe.error().message;
  ASSERT_EQ((*pipe)->write(report(7)).value_or(0), 14u);
  EXPECT_EQ(next(**pipe), report(7));
}

TEST_F(HidPipe, PermissionDeniedNamesTheUdevRule) {
  bed.set_mode("/dev/hidraw0", 0);
  const WithoutOverride nobody;
  const auto pipe = HidrawPipe::open(attached());
  ASSERT_FALSE(pipe);
  EXPECT_EQ(pipe.error().code, Errc::kPermission);
  EXPECT_NE(pipe.error().message.find(R"(SUBSYSTEM=="hidraw", KERNELS=="*:1234:0006.*", MODE="0660", TAG+="uaccess")"),
            std::string::npos)
      << pipe.error().message;
  EXPECT_NE(pipe.error().message.find("/dev/hidraw0"), std::string::npos);
}

TEST_F(HidPipe, ReportsBusyToASecondClientUntilTheFirstCloses) {
  auto first = open();
  const auto second = HidrawPipe::open(attached());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
  first.reset();
  EXPECT_TRUE(HidrawPipe::open(attached()));
}

TEST_F(HidPipe, OpensOnlyListedNodes) {
  for (const char* path : {"/dev/null", "/dev/hidraw7", "/dev/ptmx", ""}) {
    hal::AttachedDevice device = attached();
    device.node = path;
    const auto pipe = HidrawPipe::open(device);
    ASSERT_FALSE(pipe) << path;
    EXPECT_EQ(pipe.error().code, Errc::kNotFound);
  }
}

TEST_F(HidPipe, QueuesReportsInOrderWithTheirBoundaries) {
  auto pipe = open();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(pipe->write(report(10 * i)));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(next(*pipe), report(10 * i));
  std::array<std::byte, 64> into{};
  for (int tries = 0; tries < 3; ++tries) EXPECT_EQ(pipe->read(into, 0ms).value_or(9), 0u);
}

TEST_F(HidPipe, TimesOutOnASilentDeviceAndKeepsItsLateReport) {
  auto pipe = open();
  node.with_model([&] { model.silent = true; });
  ASSERT_TRUE(pipe->write(report(1)));
  std::array<std::byte, 64> into{};
  EXPECT_EQ(pipe->read(into, 2ms).value_or(9), 0u);
  node.with_model([&] { model.silent = false; });
  ASSERT_TRUE(pipe->write(report(2)));
  EXPECT_EQ(next(*pipe), report(2));
}

TEST_F(HidPipe, ReadsAStreamingDeviceToTheNewest) {
  auto pipe = open();
  node.with_model([&] { model.period = 1ms; });
  std::uint64_t newest = 0;
  std::array<std::byte, 64> into{};
  for (int reports = 0; reports < 50;) {
    const auto got = pipe->read(into, kPatient);
    ASSERT_TRUE(got);
    if (*got == 0) continue;
    std::uint64_t count = 0;
    std::memcpy(&count, into.data(), sizeof count);
    EXPECT_GT(count, newest);
    newest = count;
    ++reports;
  }
}

TEST_F(HidPipe, ReportsARejectedReportAsAProtocolError) {
  auto pipe = open();
  node.with_model([&] { model.refuses = true; });
  EXPECT_EQ(error_of(pipe->write(report(1))), Errc::kProtocol);
  node.with_model([&] { model.refuses = false; });
  ASSERT_TRUE(pipe->write(report(2)));
  EXPECT_EQ(next(*pipe), report(2));
  EXPECT_EQ(error_of(pipe->write(std::vector<std::byte>(HidrawPipe::kReportMax + 1))), Errc::kInternal);
}

TEST(HidUnplug, IsDetectedAtOnceAtEveryReport) {
  Testbed bed;
  for (unsigned at = 1; at <= 6; ++at) {
    SCOPED_TRACE(at);
    HidEcho model;
    HidrawNode node(model);
    bed.plug(node, model, "1-2");
    {
      const auto pipe = HidrawPipe::open(hal::list_hidraw().at(0));
      ASSERT_TRUE(pipe) << pipe.error().message;
      node.unplug_at(at);
      std::optional<Errc> error;
      unsigned written = 0;
      while (!error && written < 5) {
        error = error_of((*pipe)->write(report(1)));
        ++written;
        if (!error && next(**pipe).empty()) error = Errc::kInternal;
      }
      if (at == 6) {
        EXPECT_FALSE(error);
      } else {
        EXPECT_EQ(error, Errc::kUnplugged);
        EXPECT_EQ(written, at);
        std::array<std::byte, 64> into{};
        EXPECT_EQ(error_of((*pipe)->write(report(1))), Errc::kUnplugged);
        EXPECT_EQ(error_of((*pipe)->read(into, kPatient)), Errc::kUnplugged);
      }
    }
    bed.remove("1-2");
  }
}

TEST_F(HidPipe, EndsAPendingReadWhenUnplugged) {
  auto pipe = open();
  std::array<std::byte, 64> into{};
  std::jthread hand([&] { node.unplug(); });
  std::optional<Errc> error;
  for (int tries = 0; !error && tries < 100; ++tries) error = error_of(pipe->read(into, kPatient));
  EXPECT_EQ(error, Errc::kUnplugged);
  EXPECT_EQ(error_of(pipe->write(report(1))), Errc::kUnplugged);
}

TEST_F(HidPipe, TreatsAReplugAsANewDevice) {
  auto old = open();
  const auto before = attached();
  node.unplug();
  bed.remove("1-2");
  EXPECT_TRUE(hal::list_hidraw().empty());
  const auto late = HidrawPipe::open(before);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, Errc::kNotFound);
  model.plug_in();
  HidrawNode again(model);
  bed.plug(again, model, "1-2");
  EXPECT_EQ(attached().port, before.port);
  EXPECT_NE(attached().instance, before.instance);
  auto fresh = open();
  EXPECT_EQ(error_of(old->write(report(1))), Errc::kUnplugged);
  ASSERT_TRUE(fresh->write(report(4)));
  EXPECT_EQ(next(*fresh), report(4));
}

}  // namespace
}  // namespace tandem::test
