// Sessions in which clients send telemetry at 60 Hz instead of at every tick. No law uses telemetry, so forces and
// motion are the same bit for bit on networks whose delay does not depend on the size of a datagram.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

TEST(TelemetryRate, ChangesNoForceAndNoMotion) {
  for (const std::string name : {"free_motion", "contact", "contact_remote", "two_by_two", "one_axis"}) {
    SCOPED_TRACE(name);
    netsim::SimulationConfig config{.scene = test::shipped(name), .network = netsim::link_from(test::delayed(20))};
    config.scene.duration = 5;
    const std::size_t seats = config.scene.seats.size();
    auto full = netsim::Simulation::make(config);
    config.telemetry_every_tick = false;
    auto lean = netsim::Simulation::make(config);
    ASSERT_TRUE(full && lean);
    std::uint64_t carried = 0, ticks = 0;
    while ((*full)->step() && (*lean)->step()) {
      ++ticks;
      for (std::size_t i = 0; i < seats; ++i) {
        const client::Seat* a = (*full)->seat(i);
        const client::Seat* b = (*lean)->seat(i);
        ASSERT_EQ(a == nullptr, b == nullptr);
        if (a == nullptr) continue;
        ASSERT_EQ(a->effort(), b->effort()) << "tick " << ticks << ", seat " << i;
        ASSERT_EQ(a->sample().port.x, b->sample().port.x) << "tick " << ticks << ", seat " << i;
        ASSERT_EQ(a->sample().port.e_in, b->sample().port.e_in) << "tick " << ticks << ", seat " << i;
        if (i == 0 && b->sample().with_telemetry) ++carried;
      }
    }
    EXPECT_GT(ticks, 4000u);
    EXPECT_LE(carried, ticks * 60 / 1000 + 200) << "before the first FORCE a seat sends it at every tick";
    EXPECT_GE(carried, ticks * 50 / 1000);
    EXPECT_TRUE((*lean)->violations().passed());
  }
}

}  // namespace
}  // namespace tandem
