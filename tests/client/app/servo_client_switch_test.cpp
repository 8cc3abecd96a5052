#include "client/app/servo_client_switch.h"

#include <gtest/gtest.h>

#include <vector>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

struct Seen final : hal::ServoClient {
  hal::State last;
  std::vector<hal::Errc> losses;
  hal::Command tick(const hal::State& state) noexcept override {
    last = state;
    return {1, state.sampled_at + 5ms, hal::CommandKind::kJointEffort, {1, 1, 1}};
  }
  Duration next_shift() noexcept override { return 7us; }
  void lost(hal::Errc why) noexcept override { losses.push_back(why); }
};

hal::State moving(Time at) {
  hal::State state;
  state.sampled_at = at;
  state.dx = {0.1, 0, 0};
  return state;
}

TEST(ServoClientSwitch, GivesNoForceWithoutAClient) {
  ServoClientSwitch to;
  EXPECT_EQ(to.tick(moving(Time{1ms})).kind, hal::CommandKind::kNone);
  EXPECT_EQ(to.next_shift(), Duration{});
  EXPECT_FALSE(to.was_lost());
  to.lost(hal::Errc::kUnplugged);
  EXPECT_TRUE(to.was_lost());
}

TEST(ServoClientSwitch, ForwardsStatesCommandsShiftsAndTheLossOfADevice) {
  for (const bool as_seat : {false, true}) {
    ServoClientSwitch to;
    Seen client;
    if (as_seat) {
      to.connect_seat(client, {});
    } else {
      to.connect(client);
    }
    EXPECT_EQ(to.tick(moving(Time{1ms})).kind, hal::CommandKind::kJointEffort);
    EXPECT_EQ(client.last.x[0], 0) << "not integrated";
    EXPECT_EQ(to.next_shift(), 7us);
    to.lost(hal::Errc::kUnplugged);
    EXPECT_EQ(client.losses.size(), 1U);
  }
}

TEST(ServoClientSwitch, ShowsASeatThePositionOfADeviceThatReportsVelocityAndDropsItsCommand) {
  hal::DeviceCaps device;
  device.input = hal::InputKind::kRate;
  ServoClientSwitch to;
  Seen client;
  to.connect_seat(client, device);
  for (int ms = 0; ms <= 100; ++ms) EXPECT_EQ(to.tick(moving(Time{ms * 1ms})).kind, hal::CommandKind::kNone);
  EXPECT_NEAR(client.last.x[0], 0.01, 1e-12);
  to.lost(hal::Errc::kUnplugged);
  EXPECT_EQ(client.losses.size(), 1U);
}

}  // namespace
}  // namespace tandem::client
