// Records of evdev through a pipe: the test writes the kernel's side.
#include "hal/io/evdev_mouse.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <unistd.h>

#include <array>

#include "hal/backends/input_backends.h"

namespace tandem::hal {
namespace {

struct Wire {
  Wire() {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC), 0);
    mouse = std::make_unique<EvdevMouse>(ends[0]);
    write_end = ends[1];
  }
  ~Wire() { unplug(); }
  void unplug() {
    if (write_end >= 0) ::close(write_end);
    write_end = -1;
  }
  void say(unsigned type, unsigned code, int value) const {
    input_event e{};
    e.type = static_cast<std::uint16_t>(type);
    e.code = static_cast<std::uint16_t>(code);
    e.value = value;
    EXPECT_EQ(::write(write_end, &e, sizeof e), static_cast<ssize_t>(sizeof e));
  }
  void report() const { say(EV_SYN, SYN_REPORT, 0); }
  std::unique_ptr<EvdevMouse> mouse;
  int write_end = -1;
};

TEST(EvdevMouse, AccumulatesMotionAndTracksButtons) {
  const Wire wire;
  for (int i = 0; i < 100; ++i) {
    wire.say(EV_REL, REL_X, 3);
    wire.say(EV_REL, REL_Y, -2);
    wire.report();
  }
  wire.say(EV_REL, REL_WHEEL, 1);
  wire.say(EV_KEY, BTN_LEFT, 1);
  wire.say(EV_KEY, BTN_MIDDLE, 1);
  wire.report();
  auto move = wire.mouse->read();
  ASSERT_TRUE(move);
  EXPECT_EQ(move->right, 300);
  EXPECT_EQ(move->forward, 200) << "evdev counts y towards the user";
  EXPECT_EQ(move->wheel, 1);
  EXPECT_EQ(move->buttons, 5u);
  wire.say(EV_KEY, BTN_LEFT, 0);
  wire.report();
  move = wire.mouse->read();
  EXPECT_EQ(move->right, 0);
  EXPECT_EQ(move->buttons, 4u);
}

TEST(EvdevMouse, WaitsForTheWholeReport) {
  const Wire wire;
  wire.say(EV_REL, REL_X, 7);
  EXPECT_EQ(wire.mouse->read()->right, 0);
  wire.report();
  EXPECT_EQ(wire.mouse->read()->right, 7);
}

TEST(EvdevMouse, DropsReportsMadeIncompleteByAnOverrun) {
  const Wire wire;
  wire.say(EV_REL, REL_X, 1);
  wire.report();
  wire.say(EV_SYN, SYN_DROPPED, 0);
  wire.say(EV_REL, REL_X, 1000);
  wire.report();
  wire.say(EV_REL, REL_X, 2);
  wire.report();
  EXPECT_EQ(wire.mouse->read()->right, 3);
}

TEST(EvdevMouse, ReportsUnplugging) {
  Wire wire;
  EXPECT_TRUE(wire.mouse->read());
  wire.unplug();
  const auto gone = wire.mouse->read();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), Errc::kUnplugged);
}

TEST(MouseBackend, RejectsInvalidOptionsAndNonMice) {
  MouseBackend backend;
  const auto error = [&](const std::string& spec) {
    const auto opened = backend.open(*parse_device_spec(spec));
    return opened ? DeviceError{} : opened.error();
  };
  EXPECT_EQ(error("mouse:event0,mm_per_count=nan").code, Errc::kUnsupported);
  EXPECT_NE(error("mouse:event0,mm_per_count=9").message.find("[0.001, 5]"), std::string::npos);
  EXPECT_NE(error("mouse:event0,plane=up").message.find("'vertical' or 'table'"), std::string::npos);
  EXPECT_NE(error("mouse:event0,grab=maybe").message.find("'yes' or 'no'"), std::string::npos);
  EXPECT_NE(error("mouse:event0,speed=2").message.find("mm_per_count"), std::string::npos);
  EXPECT_EQ(error("mouse:event9999").code, Errc::kNotFound);
  EXPECT_NE(error("mouse:/dev/null").message.find("is no mouse"), std::string::npos);
}

}  // namespace
}  // namespace tandem::hal
