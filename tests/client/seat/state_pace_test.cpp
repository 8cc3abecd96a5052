#include "client/seat/state_pace.h"

#include <gtest/gtest.h>

#include "common/setup/send_pace.h"

namespace tandem::client {
namespace {

/// A seat at rest, engaged since tick 0.
struct AtRest {
  AtRest() {
    setup.send.dead_band.emplace();
    setup.send.heartbeat = 0.016;
    state.engaged = true;
    for (tick = 0; tick < 100; ++tick) static_cast<void>(pace().due(tick, state, {}));
  }
  StatePace& pace() {
    if (!pace_) pace_.emplace(setup::send_pace(setup, control::Side::kClient), 1 + setup.further.size());
    return *pace_;
  }
  /// STATEs in the next ticks.
  int sent(int ticks) {
    int n = 0;
    for (int i = 0; i < ticks; ++i) n += pace().due(tick++, state, {}) ? 1 : 0;
    return n;
  }
  SeatSetup setup;
  wire::StateMessage state;
  std::uint32_t tick = 0;

 private:
  std::optional<StatePace> pace_;
};

TEST(StatePace, SendsHeartbeatsOfASeatAtRest) {
  AtRest seat;
  EXPECT_EQ(seat.sent(1600), 100);
}

TEST(StatePace, SendsEveryTickWhileTheSeatIsNotEngagedOrRequests) {
  AtRest seat;
  seat.state.engaged = false;
  EXPECT_EQ(seat.sent(100), 100);
  for (bool wire::StateMessage::* const request : {&wire::StateMessage::stop, &wire::StateMessage::stop_all}) {
    AtRest one;
    one.state.*request = true;
    EXPECT_EQ(one.sent(100), 100);
  }
  AtRest resumes;
  resumes.state.resume_stop = 1;
  EXPECT_EQ(resumes.sent(100), 100);
}

TEST(StatePace, RepeatsAChangeOfAnyFlag) {
  AtRest gate, ready;
  gate.state.gate = wire::GateState::kActive;
  EXPECT_EQ(gate.sent(10), 10) << "a lost datagram delays it by one tick";
  EXPECT_EQ(gate.sent(16), 1);
  ready.state.ready = true;
  EXPECT_EQ(ready.sent(10), 10);
  AtRest ended;
  ended.state.stop = true;
  static_cast<void>(ended.sent(50));
  ended.state.stop = false;
  EXPECT_EQ(ended.sent(10), 10) << "the end of a request is a change as well";
}

TEST(StatePace, SendsMotionAndTheFirstStateOfAConnection) {
  AtRest seat;
  static_cast<void>(seat.sent(3));
  seat.state.port.x[0] = 0.001;
  EXPECT_EQ(seat.sent(1), 1);
  EXPECT_EQ(seat.sent(1), 0);
  seat.pace().restart();
  EXPECT_EQ(seat.sent(1), 1);
}

}  // namespace
}  // namespace tandem::client
