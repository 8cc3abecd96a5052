// Motor temperature as the vendor's library reports it: by numbers or by an error.
#include <cmath>
#include <limits>

#include "tests/hal/drivers/openhaptics/openhaptics_fixture.h"

namespace tandem::hal::openhaptics {
namespace {

TEST_F(OpenHaptics, ReportsTheHottestMotorWhereAvailable) {
  stub().devices.resize(2);
  stub().devices[1].name = "old";
  stub().devices[1].tells_heat = false;
  auto c = core(), old = core("old");
  Pusher p, q;
  ASSERT_TRUE(c->bring_up(patient));
  ASSERT_TRUE(old->bring_up(patient));
  const auto heat = [&](std::array<double, 6> all) {
    stub().devices[0].heat = all;
    run({{c.get(), &p}, {old.get(), &q}}, 4ms);
    return p.seen.heat.value_or(-1);
  };
  EXPECT_EQ(heat({0.2, 0.7, 0.4, 0.9, 0.9, 0.9}), 0.7) << "of three motors: the values behind them belong to no motor";
  EXPECT_EQ(heat({1.2, 0, 0, 0, 0, 0}), 1.2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(heat({nan, 0.5, 0.5, 0, 0, 0})));
  EXPECT_TRUE(std::isnan(heat({0.5, 0.5, nan, 0, 0, 0})));
  EXPECT_EQ(heat({0, 0, 0, 0, 0, 0}), 0);
  EXPECT_FALSE(q.seen.heat.has_value()) << "not asked again, and no error on the stack";
  EXPECT_TRUE(stub().errors.empty());
}

TEST_F(OpenHaptics, TrustsTheLibrarysMotorWarningForASecond) {
  for (const bool tells : {true, false}) {
    SCOPED_TRACE(tells);
    stub().devices[0].tells_heat = tells;
    auto c = core();
    Pusher p;
    ASSERT_TRUE(c->bring_up(patient));
    run({{c.get(), &p}}, 10ms);
    EXPECT_EQ(p.seen.heat.has_value(), tells);
    stub().devices[0].cycle_error = 0x0200;
    run({{c.get(), &p}}, 4ms);
    EXPECT_EQ(p.seen.heat.value_or(0), 1);
    run({{c.get(), &p}}, 900ms);
    EXPECT_EQ(p.seen.heat.value_or(0), 1);
    run({{c.get(), &p}}, 200ms);
    EXPECT_LT(p.seen.heat.value_or(0), 1);
  }
}

}  // namespace
}  // namespace tandem::hal::openhaptics
