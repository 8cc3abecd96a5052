#include "tests/hal/emulation/devices/falcon_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "hal/drivers/falcon/falcon_ftdi.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"

namespace tandem::hal::emulation {
namespace {

using namespace std::chrono_literals;

TEST(FalconModel, DescribesItselfAsAFalcon) {
  FalconModel model;
  const auto device = model.device_descriptor();
  ASSERT_EQ(device.size(), 18u);
  EXPECT_EQ(static_cast<int>(device[8]) | static_cast<int>(device[9]) << 8, 0x0403);
  EXPECT_EQ(static_cast<int>(device[10]) | static_cast<int>(device[11]) << 8, 0xCB48);
  const auto config = model.config_descriptor();
  ASSERT_EQ(config.size(), 32u);
  EXPECT_EQ(static_cast<std::size_t>(config[2]), config.size());
  EXPECT_EQ(static_cast<int>(config[20]), 0x81);
  EXPECT_EQ(static_cast<int>(config[27]), 0x02);
  EXPECT_NE(std::string(model.string(2)).find("FALCON HAPTIC"), std::string::npos);
  EXPECT_TRUE(model.string(3).empty());
}

TEST(FtdiModel, SendsEmptyPacketsWhenItsTimerRunsOut) {
  FtdiModel line;
  std::array<std::byte, 64> packet{};
  ASSERT_TRUE(line.request(ftdi::kLatency, 5));
  EXPECT_FALSE(line.request(ftdi::kLatency, 0));
  line.advance(4ms);
  EXPECT_FALSE(line.to_host(packet));
  line.advance(1ms);
  EXPECT_EQ(line.to_host(packet), std::optional<std::size_t>(2));
  EXPECT_FALSE(line.to_host(packet));
}

TEST(FtdiModel, DelaysBytesByTheLineRate) {
  FtdiModel line;
  ASSERT_TRUE(line.request(ftdi::kBaud, ftdi::k9600));
  const std::array<std::byte, 3> three{std::byte{1}, std::byte{2}, std::byte{3}};
  line.from_host(three);
  // 9600 baud is 960 bytes per second: 1.04 ms each.
  line.advance(1ms);
  EXPECT_FALSE(line.next_for_device());
  line.advance(100us);
  EXPECT_EQ(line.next_for_device(), std::optional(std::byte{1}));
  EXPECT_FALSE(line.next_for_device());
  for (int i = 0; i < 22; ++i) line.advance(100us);
  EXPECT_EQ(line.next_for_device(), std::optional(std::byte{2}));
  EXPECT_EQ(line.next_for_device(), std::optional(std::byte{3}));
}

TEST(FtdiModel, SendsFullPacketsAtOnce) {
  FtdiModel line;
  ASSERT_TRUE(line.request(ftdi::kBaud, ftdi::k1500k));
  for (int i = 0; i < 70; ++i) line.from_device(static_cast<std::byte>(i));
  for (int i = 0; i < 10; ++i) line.advance(50us);
  std::array<std::byte, 64> packet{};
  ASSERT_EQ(line.to_host(packet), std::optional<std::size_t>(64));
  EXPECT_EQ(packet[2], std::byte{0});
  EXPECT_EQ(packet[63], std::byte{61});
  EXPECT_FALSE(line.to_host(packet));
}

TEST(FalconMechanics, RestsTheTipWhereHandAndMotorsBalance) {
  FalconMechanics mechanics({.damping = 5});
  mechanics.set_pull({.k = 200, .b = 10, .m = 0, .x = Vec3::Zero()});
  const std::array<std::int16_t, 3> motor{-200, -200, -200};  // 0.02 N m outwards on each leg
  for (int i = 0; i < 40000; ++i) mechanics.advance(motor, 50e-6);
  const Vec3 force = mechanics.motor_force();
  EXPECT_LT(force[1], -0.5) << "growing angles push the tip out, towards the user";
  EXPECT_LE((200 * mechanics.tip() - force).norm(), 1e-3);
  EXPECT_LE(mechanics.velocity().norm(), 1e-6);
}

TEST(FalconMechanics, StaysWithinTheStops) {
  FalconMechanics mechanics({});
  for (const Vec3& target : {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)}) {
    mechanics.set_pull({.k = 500, .b = 5, .m = 0.1, .x = target});
    for (int i = 0; i < 20000; ++i) mechanics.advance({}, 50e-6);
    ASSERT_TRUE(mechanics.tip().allFinite());
    EXPECT_GE(mechanics.theta().minCoeff(), kFalconAngleMin);
    EXPECT_LE(mechanics.theta().maxCoeff(), kFalconAngleMax);
  }
}

TEST(FalconModel, LosesFirmwareAndOriginOnlyWithoutPower) {
  FalconModel model(hal::falcon::ready_model());
  model.unplug();
  std::array<std::byte, 64> packet{};
  EXPECT_EQ(model.bulk_in(kFalconIn, packet).error(), TransferStatus::kGone);
  EXPECT_EQ(model.bulk_out(kFalconOut, packet).error(), TransferStatus::kGone);
  EXPECT_EQ(model.control({0x40, 0, 0, 0, 0}, {}).error(), TransferStatus::kGone);
  model.plug_in();
  EXPECT_TRUE(model.running());
  EXPECT_EQ(model.homed(), kFalconAllHomed);
  model.lose_power();
  EXPECT_FALSE(model.running());
  EXPECT_EQ(model.homed(), 0);
  EXPECT_EQ(model.mechanics().encoder(), (std::array<std::int16_t, 3>{}));
}

TEST(FalconModel, HoldsAStallUntilItIsCleared) {
  FalconModel model;
  model.faults.stall_out = 1;
  const std::array<std::byte, 1> byte{};
  EXPECT_EQ(model.bulk_out(kFalconOut, byte).error(), TransferStatus::kStall);
  EXPECT_EQ(model.bulk_out(kFalconOut, byte).error(), TransferStatus::kStall);
  EXPECT_TRUE(model.control({0x02, 1, 0, kFalconOut, 0}, {}));
  EXPECT_TRUE(model.bulk_out(kFalconOut, byte));
  EXPECT_EQ(model.control({0x40, 77, 0, 0, 0}, {}).error(), TransferStatus::kStall);
  EXPECT_EQ(model.bulk_out(0x05, byte).error(), TransferStatus::kStall);
}

TEST(FalconModel, LetsASimulatedHandHoldTheGrip) {
  FalconModel model(hal::falcon::ready_model());
  model.set_hand(std::make_unique<sim::Hand>(HandSpec{}, Vec3(0, 0, 0)));
  for (int i = 0; i < 500; ++i) model.advance(1ms);
  EXPECT_LE(model.mechanics().tip().norm(), 1e-3);
}

}  // namespace
}  // namespace tandem::hal::emulation
