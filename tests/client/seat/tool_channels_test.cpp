#include "client/seat/tool_channels.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

/// A master of law `replica` with two tools; half and a quarter of their force act on the seat.
SeatSetup two_tools() {
  SeatSetup s;
  s.channel.law = LawKind::kReplica;
  s.weight = 0.5;
  CoupledTool second;
  second.tool = 1;
  second.weight = 0.25;
  s.further.push_back(second);
  return s;
}

TEST(ToolChannels, HoldTheValuesOfEachTool) {
  ToolChannels tools{two_tools()};
  ASSERT_EQ(tools.size(), 2U);
  EXPECT_FALSE(tools.heard());
  wire::ForceMessage force;
  force.alpha = 0.25;
  tools.further_next()[0].alpha = 0.75;
  EXPECT_EQ(tools.received(1).alpha, 0) << "not yet received";
  tools.receive(force);
  EXPECT_TRUE(tools.heard());
  EXPECT_EQ(tools.received(0).alpha, 0.25);
  EXPECT_EQ(tools.received(1).alpha, 0.75);
  EXPECT_EQ(tools.all()[1].received->alpha, 0.75);
  EXPECT_EQ(tools.authority(), 0.75);
  tools.clear_received();
  EXPECT_FALSE(tools.heard());
  EXPECT_EQ(tools.authority(), 0);
}

TEST(ToolChannels, WeightTheRefusedEnergy) {
  const ToolChannels tools{two_tools()};
  tools.end(0).note_refused(1);
  tools.end(1).note_refused(2);
  wire::Telemetry t;
  tools.fill(t);
  EXPECT_DOUBLE_EQ(t.refused_j, 0.5 * 1 + 0.25 * 2);
}

TEST(ToolChannels, ExchangeTheEndsWithANewConnection) {
  const SeatSetup setup = two_tools();
  ToolChannels tools{setup};
  const control::ChannelEnd* const old = &tools.end(1);
  ToolChannels::Ends next = ToolChannels::make_ends(setup);
  const control::ChannelEnd* const replacement = next[1].get();
  tools.swap_ends(next);
  EXPECT_EQ(&tools.end(1), replacement);
  EXPECT_EQ(tools.all()[1].end, replacement);
  EXPECT_EQ(next[1].get(), old);
}

}  // namespace
}  // namespace tandem::client
