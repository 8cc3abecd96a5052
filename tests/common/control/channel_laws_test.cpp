#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/control/channel.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

TEST(ChannelLaws, AreFoundByNameAndDeclareTheirGuarantees) {
  EXPECT_EQ(channel_laws().front().name, "replica");  // the default
  for (const ChannelLaw& law : channel_laws()) {
    SCOPED_TRACE(law.name);
    const auto end = make_channel_end(law.name, {});
    ASSERT_NE(end, nullptr);
    EXPECT_EQ(end->guarantees().ledger, law.name != "raw" && law.name != "pd");
    EXPECT_FALSE(law.summary.empty());
  }
  EXPECT_EQ(make_channel_end("no such law", {}), nullptr);
}

TEST(ChannelLaws, StayFiniteForAnyInputAndTakeNoHeap) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(),
                             1e300,
                             -1e300,
                             5e-324,
                             -0.0};
  for (const ChannelLaw& law : channel_laws()) {
    for (const Side side : {Side::kClient, Side::kServer}) {
      SCOPED_TRACE(law.name);
      ChannelParams p;
      p.side = side;
      p.dof = 1;
      const auto end = make_channel_end(law.name, p);
      end->engage({}, 0.05);
      EndInput in;
      const test::AllocGuard guard;
      for (AxisArray PortSample::* member : {&PortSample::x, &PortSample::v, &PortSample::f, &PortSample::a}) {
        for (const double bad : kBad) {
          in.rx = {};
          (in.rx.*member)[0] = bad;
          end->move(in);
          in.rx = {};
          end->move(in);
        }
      }
      EXPECT_EQ(guard.count(), 0U);
      AxisArray sent{};
      end->replace_velocity(sent);
      EXPECT_TRUE(std::isfinite(sent[0]));
      EXPECT_TRUE(std::isfinite(end->state().ref[0]));
      EXPECT_TRUE(std::isfinite(end->state().k[0]));
      EXPECT_TRUE(std::isfinite(end->state().b[0]));
    }
  }
}

}  // namespace
}  // namespace tandem::control
