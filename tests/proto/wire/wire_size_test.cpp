#include <gtest/gtest.h>

#include "tests/proto/wire/wire_samples.h"

namespace tandem::wire {
namespace {

/// The sizes given in wire.proto and the documents. A change here is a change of the protocol.
TEST(WireSize, MatchesTheDocuments) {
  EXPECT_EQ(state_size(3), 310u);
  EXPECT_EQ(state_size(7), 502u);
  EXPECT_EQ(force_size(3), 159u);
  EXPECT_EQ(force_size(7), 287u);
  EXPECT_EQ(kContactSize, 51u);
  EXPECT_EQ(force_size(3, 4), 368u);
  EXPECT_EQ(kGhostSize, 34u);
  EXPECT_EQ(tool_state_size(3), 97u);
  EXPECT_EQ(tool_force_size(3), 92u);
  EXPECT_EQ(kPathSize, 25u);
  EXPECT_EQ(kAuthoritySize, 162u);
  EXPECT_EQ(kCloseSize, 21u);
}

TEST(WireSize, DependsOnAxesOnly) {
  std::array<std::byte, kPlaintextMax> buffer;
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    Codec codec(axes, PortSpace::kTip);
    RandomStream random(axes);
    EXPECT_EQ(codec.encode({}, StateMessage{}, buffer), state_size(axes)) << "zeros are sent as well";
    EXPECT_EQ(codec.encode({}, ForceMessage{}, buffer), force_size(axes));
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(codec.encode({}, samples::state(random, axes), buffer), state_size(axes));
      ForceMessage force = samples::force(random, axes);
      EXPECT_EQ(codec.encode({}, force, buffer), force_size(axes));
      force.slave_pull = 1;
      EXPECT_EQ(codec.encode({}, force, buffer), force_size(axes, 0));
      force.slave_pull = 1e-6;  // rounded to 0 on the wire
      EXPECT_EQ(codec.encode({}, force, buffer), force_size(axes));
    }
  }
}

TEST(WireSize, KeepsAChallengeSmallerThanItsTrigger) { EXPECT_LT(kPathSize, state_size(1)); }

}  // namespace
}  // namespace tandem::wire
