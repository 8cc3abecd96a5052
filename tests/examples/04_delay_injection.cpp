// A delay-injection test: a protocol of one's own and a whole haptic session over networks with delay, jitter and loss,
// in virtual time. A failing test prints the command that repeats it.
//
// Prints, among other lines:
//   [       OK ] DelayInjection.AReplyTakesOneRoundTrip
//   [       OK ] DelayInjection.EveryRequestIsAnsweredDespiteLoss
//   [       OK ] DelayInjection.ASessionStaysPassiveAndTheToolNearTheLeader
//   [  PASSED  ] 3 tests.
#include <tandem/testing.h>

using namespace std::chrono_literals;
using tandem::netsim::Direction;

struct DelayInjection : tandem::netsim::NetworkTest {};

TEST_F(DelayInjection, AReplyTakesOneRoundTrip) {
  use_numbers({.delay = 40ms});
  send(Direction::kUp, "request");
  ASSERT_TRUE(advance_to_next());
  ASSERT_EQ(receive(Direction::kUp)->text(), "request");
  send(Direction::kDown, "reply");
  ASSERT_TRUE(advance_to_next());
  EXPECT_EQ(receive(Direction::kDown)->text(), "reply");
  EXPECT_EQ(now(), tandem::Time{80ms});
}

TEST_F(DelayInjection, EveryRequestIsAnsweredDespiteLoss) {
  for_seeds(20, [&] {
    use_profile("wifi-busy");
    bool answered = false;
    run_for(2s, 50ms, [&] {  // repeats the request every 50 ms
      if (!answered) send(Direction::kUp, "request");
      while (receive(Direction::kUp)) send(Direction::kDown, "reply");
      while (receive(Direction::kDown)) answered = true;
    });
    EXPECT_TRUE(answered);
  });
}

TEST_F(DelayInjection, ASessionStaysPassiveAndTheToolNearTheLeader) {
  for (const auto delay : {0ms, 20ms, 100ms}) {
    auto setup = tandem::netsim::simulation_config({.scene = "free_motion", .duration_s = 8});
    ASSERT_TRUE(setup) << setup.error();
    setup->network = tandem::netsim::link_from({.delay = delay, .jitter = delay / 4, .loss = 0.05});
    const auto result = tandem::netsim::run_simulation(*setup);
    ASSERT_EQ(result.trouble, "");
    EXPECT_TRUE(result.report.passed) << delay.count() << " ms: an invariant is violated";
    EXPECT_EQ(result.report.seats[0].gate_trips, 0U);
    EXPECT_LT(result.report.seats[0].metrics.tracking_rms_m, 0.004) << delay.count() << " ms";
  }
}
