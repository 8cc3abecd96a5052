#include <gtest/gtest.h>

#include "client/seat/seat.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/text/seat_setup.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

/// Returns the gate phase of a seat whose device sends no readings for `silent` ms, from 50 ms on. Scene `devices`.
control::GatePhase phase_after_silence(int silent) {
  const auto scene = parse_scene(find_shipped_scene("devices")->text, "devices");
  EXPECT_TRUE(scene);
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 3;
  const SeatSetup setup = seat_setup(*scene, 0);
  Seat seat{setup, caps, {transport::Direction::kToServer, 1, 2}};
  hal::State state;
  state.J.leftCols<3>().setIdentity();
  Time now{1ms};
  for (int k = 0; k < 50 + silent; ++k, now += 1ms) {
    state.stale = k >= 50;
    static_cast<void>(seat.on_servo(now, state));
  }
  return seat.gate().phase();
}

// The last good reading replaces up to three missing ones, so one lost reply has no effect; a silent device faults.
TEST(SeatReading, HoldsASilentDeviceForThreeSamplesThenFaults) {
  EXPECT_NE(phase_after_silence(0), control::GatePhase::kFault);
  EXPECT_NE(phase_after_silence(3), control::GatePhase::kFault);
  EXPECT_EQ(phase_after_silence(4), control::GatePhase::kFault);
}

}  // namespace
}  // namespace tandem::client
