// The libusb pipe with the real libusb and libudev, against an emulated device.
#include "hal/io/usb_pipe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <thread>

#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"
#include "tests/support/alloc_guard.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using hal::Errc;
using hal::LibusbPipe;

/// Long enough for a busy machine: a read returns as soon as data is available.
constexpr Duration kPatient = 5s;

struct UsbPipe : testing::Test {
  UsbPipe() { bed.plug(node, model, "1-2"); }

  hal::AttachedDevice attached() {
    const auto list = hal::list_usb();
    EXPECT_EQ(list.size(), 1u);
    return list.empty() ? hal::AttachedDevice{} : list.front();
  }
  std::unique_ptr<LibusbPipe> open() {
    auto pipe = LibusbPipe::open(attached());
    EXPECT_TRUE(pipe) << pipe.error().message;
    return pipe ? std::move(*pipe) : nullptr;
  }
  /// Returns data bytes of complete packets without their status, until `count` bytes arrived.
  static std::vector<std::byte> gather(hal::UsbPipe& pipe, std::size_t count, std::size_t* packets = nullptr) {
    std::vector<std::byte> out;
    std::array<std::byte, UsbEcho::kPacket> packet{};
    for (int tries = 0; out.size() < count && tries < 10000; ++tries) {
      const auto got = pipe.read(packet, kPatient);
      if (!got || *got < UsbEcho::kStatus) break;
      if (packets != nullptr && *got > UsbEcho::kStatus) ++*packets;
      out.insert(out.end(), packet.begin() + UsbEcho::kStatus, packet.begin() + static_cast<std::ptrdiff_t>(*got));
    }
    return out;
  }

  UsbEcho model;
  Testbed bed;
  UsbfsNode node{model};
};

std::vector<std::byte> frame(int first, std::size_t size = 16) {
  std::vector<std::byte> out(size);
  for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::byte>((static_cast<std::size_t>(first) + i) & 0xFF);
  return out;
}

TEST_F(UsbPipe, IsListedWithItsNamesBeforeItIsOpened) {
  const auto device = attached();
  EXPECT_EQ(device.ids, (hal::UsbIds{0x0403, 0xCB48}));
  EXPECT_EQ(device.maker, "Tandem");
  EXPECT_EQ(device.name, "ECHO");
  EXPECT_EQ(device.serial, "E7");
  EXPECT_EQ(device.port, "1-2");
  EXPECT_EQ(device.node, "/dev/bus/usb/001/004");
  EXPECT_EQ(hal::describe(device), "0403:cb48 ECHO, serial E7, at port 1-2");
}

TEST_F(UsbPipe, CarriesRequestsAndFramesWithoutHeap) {
  auto pipe = open();
  ASSERT_TRUE(pipe);
  ASSERT_TRUE(pipe->control(9, 1, 0));
  EXPECT_EQ(node.with_model([&] { return model.requests.back().request; }), 9);
  EXPECT_EQ(node.with_model([&] { return model.requests.back().request_type; }), 0x40);
  const auto sent = frame(1);
  std::array<std::byte, UsbEcho::kPacket> packet{};
  std::size_t came = 0, taken = 0;
  const AllocGuard heap;
  const auto inside_before = Node::heap_inside();
  for (int i = 0; i < 500; ++i) {
    const auto written = pipe->write(sent, kPatient);
    std::size_t got = 0;
    while (got < sent.size()) {
      const auto n = pipe->read(packet, kPatient);
      if (!n || *n < UsbEcho::kStatus) break;
      got += *n - UsbEcho::kStatus;
    }
    came += got;
    taken += written.value_or(0);
  }
  EXPECT_EQ(heap.count() - (Node::heap_inside() - inside_before), 0u);
  EXPECT_EQ(taken, 500 * sent.size());
  EXPECT_EQ(came, 500 * sent.size());
}

TEST_F(UsbPipe, PermissionDeniedNamesTheUdevRule) {
  bed.set_mode("/dev/bus/usb/001/004", 0);
  const WithoutOverride nobody;
  const auto pipe = LibusbPipe::open(attached());
  ASSERT_FALSE(pipe);
  EXPECT_EQ(pipe.error().code, Errc::kPermission);
  EXPECT_NE(pipe.error().message.find(
                R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0660", TAG+="uaccess")"),
            std::string::npos)
      << pipe.error().message;
  EXPECT_NE(pipe.error().message.find("/etc/udev/rules.d/70-tandem.rules"), std::string::npos);
  EXPECT_NE(pipe.error().message.find("/dev/bus/usb/001/004"), std::string::npos);
}

TEST_F(UsbPipe, ReportsBusyToASecondClientUntilTheFirstCloses) {
  auto first = open();
  const auto second = LibusbPipe::open(attached());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
  EXPECT_NE(second.error().message.find("another tandem-client"), std::string::npos);
  first.reset();
  EXPECT_TRUE(LibusbPipe::open(attached()));
}

TEST_F(UsbPipe, DetachesAndReattachesTheKernelDriver) {
  UsbEcho other;
  UsbfsNode bound(other, "ftdi_sio");
  bed.plug(bound, other, "1-3");
  const auto list = hal::list_usb();
  ASSERT_EQ(list.size(), 2u);
  {
    const auto pipe = LibusbPipe::open(list[1]);
    ASSERT_TRUE(pipe) << pipe.error().message;
    EXPECT_EQ(bound.kernel_driver(), "");
  }
  EXPECT_EQ(bound.kernel_driver(), "ftdi_sio");
}

TEST_F(UsbPipe, RefusesAnotherDeviceWithTheSameId) {
  UsbEcho other;
  other.become_another_device();
  UsbfsNode its_node(other);
  bed.plug(its_node, other, "1-3");
  const auto pipe = LibusbPipe::open(hal::list_usb().at(1));
  ASSERT_FALSE(pipe);
  EXPECT_EQ(pipe.error().code, Errc::kUnsupported);
}

TEST_F(UsbPipe, ReportsAStallAsAProtocolErrorUntilCleared) {
  auto pipe = open();
  std::array<std::byte, UsbEcho::kPacket> packet{};
  node.with_model([&] { model.stall_in = model.stall_out = true; });
  EXPECT_EQ(error_of(pipe->read(packet, kPatient)), Errc::kProtocol);
  EXPECT_EQ(error_of(pipe->write(frame(1), kPatient)), Errc::kProtocol);
  EXPECT_EQ(error_of(pipe->read(packet, kPatient)), Errc::kProtocol) << "still halted";
  ASSERT_TRUE(pipe->clear_halt());
  ASSERT_TRUE(pipe->write(frame(1), kPatient));
  EXPECT_EQ(gather(*pipe, 16), frame(1));
  node.with_model([&] { model.refuse_control = true; });
  EXPECT_EQ(error_of(pipe->control(1, 2, 3)), Errc::kProtocol);
  node.with_model([&] { model.refuse_control = false; });
  EXPECT_TRUE(pipe->control(1, 2, 3));
}

TEST_F(UsbPipe, ClearsAHaltDuringAPendingRead) {
  auto pipe = open();
  std::array<std::byte, UsbEcho::kPacket> packet{};
  node.with_model([&] { model.silent = true; });
  EXPECT_EQ(pipe->read(packet, 0ms).value_or(9), 0u);
  EXPECT_TRUE(pipe->clear_halt());
  EXPECT_EQ(node.with_model([&] { return model.halts_cleared; }), 2u);
  node.with_model([&] { model.silent = false; });
  ASSERT_TRUE(pipe->write(frame(3), kPatient));
  EXPECT_EQ(gather(*pipe, 16), frame(3));
}

TEST_F(UsbPipe, KeepsDataThatArrivesAfterAReadTimeout) {
  auto pipe = open();
  std::array<std::byte, UsbEcho::kPacket> packet{};
  node.with_model([&] { model.silent = true; });
  for (const Duration timeout : {Duration{0}, Duration{300us}, Duration{2ms}}) {
    EXPECT_EQ(pipe->read(packet, timeout).value_or(9), 0u);
  }
  node.with_model([&] { model.silent = false; });
  ASSERT_TRUE(pipe->write(frame(5, 40), kPatient));
  EXPECT_EQ(gather(*pipe, 40), frame(5, 40));
}

TEST_F(UsbPipe, CancelsAWriteThatTimesOut) {
  auto pipe = open();
  node.with_model([&] { model.takes_nothing = true; });
  EXPECT_EQ(error_of(pipe->write(frame(1), 2ms)), Errc::kTimeout);
  node.with_model([&] { model.takes_nothing = false; });
  ASSERT_TRUE(pipe->write(frame(9), kPatient));
  EXPECT_EQ(gather(*pipe, 16), frame(9));
  EXPECT_EQ(node.with_model([&] { return model.bytes_taken; }), 16u);
}

TEST_F(UsbPipe, DeliversPartialAndConcatenatedFramesByteForByte) {
  auto pipe = open();
  for (const std::size_t piece : {std::size_t{1}, std::size_t{5}, std::size_t{14}}) {
    node.with_model([&] { model.packet_data = piece; });
    ASSERT_TRUE(pipe->write(frame(static_cast<int>(piece)), kPatient));
    EXPECT_EQ(gather(*pipe, 16), frame(static_cast<int>(piece)));
  }
  node.with_model([&] {
    model.packet_data = 62;
    model.holds_back = true;
  });
  std::vector<std::byte> both = frame(1);
  std::ranges::copy(frame(77), std::back_inserter(both));
  ASSERT_TRUE(pipe->write(frame(1), kPatient));
  ASSERT_TRUE(pipe->write(frame(77), kPatient));
  node.with_model([&] { model.holds_back = false; });
  std::size_t packets = 0;
  EXPECT_EQ(gather(*pipe, 32, &packets), both);
  EXPECT_EQ(packets, 1u) << "two frames in one packet";
}

TEST_F(UsbPipe, TransfersAFirmwareSizedUploadUnchanged) {
  auto pipe = open();
  for (int block = 0; block < 118; ++block) {
    const auto sent = frame(block, 62);
    ASSERT_TRUE(pipe->write(sent, kPatient));
    ASSERT_EQ(gather(*pipe, 62), sent) << "block " << block;
  }
}

TEST_F(UsbPipe, TreatsEmptyLatencyTimerPacketsAsStatus) {
  auto pipe = open();
  std::array<std::byte, UsbEcho::kPacket> packet{};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(pipe->read(packet, kPatient).value_or(0), UsbEcho::kStatus);
}

TEST_F(UsbPipe, RejectsTransfersThatDoNotFit) {
  auto pipe = open();
  std::array<std::byte, UsbEcho::kPacket - 1> small{};
  EXPECT_EQ(error_of(pipe->read(small, kPatient)), Errc::kInternal);
  EXPECT_EQ(error_of(pipe->write(frame(0, LibusbPipe::kWriteMax + 1), kPatient)), Errc::kInternal);
  EXPECT_TRUE(pipe->write(frame(0, LibusbPipe::kWriteMax), kPatient));
}

/// Performs a boot-like exchange of transfers. Returns its first error.
std::optional<Errc> converse(hal::UsbPipe& pipe) {
  std::array<std::byte, UsbEcho::kPacket> packet{};
  for (int i = 0; i < 3; ++i) {
    if (const auto done = pipe.control(static_cast<std::uint8_t>(i), 0, 0); !done) return done.error();
  }
  for (int i = 0; i < 4; ++i) {
    if (const auto done = pipe.write(frame(i), kPatient); !done) return done.error();
    if (const auto done = pipe.read(packet, kPatient); !done) return done.error();
  }
  return std::nullopt;
}

TEST(UsbUnplug, IsDetectedAtOnceAtEveryTransfer) {
  Testbed bed;
  unsigned transfers = 0;
  for (unsigned at = 1; at <= 13; ++at) {
    SCOPED_TRACE(at);
    UsbEcho model;
    UsbfsNode node(model);
    bed.plug(node, model, "1-2");
    {
      const auto pipe = LibusbPipe::open(hal::list_usb().at(0));
      ASSERT_TRUE(pipe) << pipe.error().message;
      const unsigned before = node.handed_in();
      node.unplug_at(at);
      const auto error = converse(**pipe);
      transfers = node.handed_in() - before;
      constexpr unsigned kAll = 12;  // the last one is a read in advance, whose failure the next call reports
      EXPECT_EQ(error, at < kAll ? std::optional(Errc::kUnplugged) : std::nullopt);
      if (at <= kAll) {
        std::array<std::byte, UsbEcho::kPacket> packet{};
        EXPECT_EQ(error_of((*pipe)->read(packet, kPatient)), Errc::kUnplugged);
        EXPECT_EQ(error_of((*pipe)->write(frame(1), kPatient)), Errc::kUnplugged);
        EXPECT_EQ(error_of((*pipe)->control(1, 1, 1)), Errc::kUnplugged);
        EXPECT_EQ(error_of((*pipe)->clear_halt()), Errc::kUnplugged);
        EXPECT_EQ(node.handed_in() - before, transfers) << "nothing more goes to a lost device";
      }
    }
    bed.remove("1-2");
  }
}

TEST_F(UsbPipe, EndsAPendingReadWhenUnplugged) {
  auto pipe = open();
  node.with_model([&] { model.silent = true; });
  std::array<std::byte, UsbEcho::kPacket> packet{};
  EXPECT_EQ(pipe->read(packet, 0ms).value_or(9), 0u);  // now a transfer is pending
  std::jthread hand([&] { node.unplug(); });
  EXPECT_EQ(error_of(pipe->read(packet, kPatient)), Errc::kUnplugged);
}

TEST_F(UsbPipe, ReportsUnpluggingDuringAReadAtTheNextWrite) {
  auto pipe = open();
  node.with_model([&] { model.silent = true; });
  std::array<std::byte, UsbEcho::kPacket> packet{};
  EXPECT_EQ(pipe->read(packet, 0ms).value_or(9), 0u);
  node.unplug();
  EXPECT_EQ(error_of(pipe->write(frame(1), kPatient)), Errc::kUnplugged);
}

TEST_F(UsbPipe, ReportsUnpluggingBetweenListingAndOpening) {
  const auto device = attached();
  node.unplug();
  bed.remove("1-2");
  const auto pipe = LibusbPipe::open(device);
  ASSERT_FALSE(pipe);
  EXPECT_EQ(pipe.error().code, Errc::kUnplugged);
}

TEST_F(UsbPipe, TreatsAReplugAsANewDevice) {
  auto old = open();
  const auto before = attached();
  node.unplug();
  bed.remove("1-2");
  EXPECT_TRUE(hal::list_usb().empty());
  model.plug_in();
  UsbfsNode again(model);
  bed.plug(again, model, "1-2");
  const auto after = attached();
  EXPECT_EQ(after.port, before.port);
  EXPECT_NE(after.instance, before.instance);
  EXPECT_EQ(error_of(old->write(frame(1), kPatient)), Errc::kUnplugged);
  auto fresh = open();
  ASSERT_TRUE(fresh->write(frame(1), kPatient));
  EXPECT_EQ(gather(*fresh, 16), frame(1));
  EXPECT_EQ(error_of(old->control(1, 1, 1)), Errc::kUnplugged);
}

}  // namespace
}  // namespace tandem::test
