#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/proto/wire/wire_samples.h"

namespace tandem::wire {
namespace {

/// Sealed sizes by axes and tools, as in the table of ARCHITECTURE.md ("Datagrams"). They are written down here and not
/// computed: a change is a change of the protocol.
struct Row {
  std::size_t axes;
  bool copies;
  std::size_t state, state_telemetry, force;
};
constexpr Row kRows[]{{1, false, 91, 196, 110},  {1, true, 97, 202, 110},   {2, false, 111, 228, 130},
                      {2, true, 121, 238, 130},  {3, false, 131, 260, 150}, {3, true, 145, 274, 150},
                      {6, false, 191, 357, 210}, {7, false, 211, 389, 230}};

TEST(WireSize, MatchesTheDocuments) {
  for (const Row& row : kRows) {
    SCOPED_TRACE(std::to_string(row.axes) + (row.copies ? " axes, replica" : " axes"));
    const BodyLayout layout{.axes = row.axes,
                            .port = row.axes > 3 ? PortSpace::kJoint : PortSpace::kTip,
                            .tool_copies = row.copies,
                            .environment = false};
    const Codec codec(layout);
    std::array<std::byte, kPlaintextMax> buffer;
    StateMessage state;
    EXPECT_EQ(codec.encode({}, state, buffer) + kDatagramOverhead, row.state_telemetry);
    state.with_telemetry = false;
    EXPECT_EQ(codec.encode({}, state, buffer) + kDatagramOverhead, row.state);
    EXPECT_EQ(codec.encode({}, ForceMessage{}, buffer) + kDatagramOverhead, row.force);
    std::printf("[ measured ] %zu axes%s: STATE %zu, with telemetry %zu, FORCE %zu bytes sealed\n", row.axes,
                row.copies ? ", replica" : "", row.state, row.state_telemetry, row.force);
  }
  const BodyLayout slave{.axes = 3, .port = PortSpace::kTip, .tool_copies = false};
  EXPECT_EQ(state_size(slave, true) - state_size(slave, false), 150u);
  EXPECT_EQ(kContactSize, 51u);
  EXPECT_EQ(force_size(3, 4), 327u);
  EXPECT_EQ(kGhostSize, 33u);
  EXPECT_EQ(tool_state_size(3), 84u);
  EXPECT_EQ(tool_force_size(3), 80u);
  EXPECT_EQ(kPathSize, 25u);
  EXPECT_EQ(kAuthoritySize, 162u);
  EXPECT_EQ(kCloseSize, 21u);
}

/// Asked: three axes, one tool, no streamed contacts, at 1 kHz.
TEST(WireSize, SealsStateAndForceOfThreeAxesInto150Bytes) {
  for (const bool copies : {false, true}) {
    const BodyLayout layout{.axes = 3, .port = PortSpace::kTip, .tool_copies = copies};
    const Codec codec(layout);
    std::array<std::byte, kPlaintextMax> buffer;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      RandomStream random(seed);
      StateMessage state = samples::state(random, 3);
      state.with_telemetry = false;
      EXPECT_LE(codec.encode({}, state, buffer) + kDatagramOverhead, 150u);
      EXPECT_LE(codec.encode({}, samples::force(random, 3), buffer) + kDatagramOverhead, 150u);
    }
  }
}

TEST(WireSize, DependsOnTheLayoutOnly) {
  std::array<std::byte, kPlaintextMax> buffer;
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    const BodyLayout layout = samples::tip(axes);
    const Codec codec(layout);
    RandomStream random(axes);
    EXPECT_EQ(codec.encode({}, StateMessage{}, buffer), state_size(layout, true)) << "zeros are sent as well";
    EXPECT_EQ(codec.encode({}, ForceMessage{}, buffer), force_size(axes));
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(codec.encode({}, samples::state(random, axes), buffer), state_size(layout, true));
      ForceMessage force = samples::force(random, axes);
      EXPECT_EQ(codec.encode({}, force, buffer), force_size(axes));
      force.slave_pull = 1;
      EXPECT_EQ(codec.encode({}, force, buffer), axes <= 3 ? force_size(axes, 0) : 0u);
      force.slave_pull = 1e-6;  // rounded to 0 on the wire
      EXPECT_EQ(codec.encode({}, force, buffer), force_size(axes));
    }
  }
}

/// A link test carries the traffic of a seat; one length cannot be reached by padding.
TEST(WireSize, GivesLinkTestsTheSizesOfASeat) {
  std::array<std::byte, kPlaintextMax> buffer;
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes)
    for (std::size_t further = 0; further <= kFurtherToolsMax; ++further)
      for (const bool copies : {false, true}) {
        const BodyLayout layout = BodyLayout{axes, PortSpace::kTip, further, copies, false}.valid();
        const Codec codec(layout);
        const std::size_t probe = codec.encode({}, LinkProbe{}, buffer);
        EXPECT_EQ(probe, probe_size(layout));
        EXPECT_TRUE(probe == state_size(layout, false) || probe == state_size(layout, false) + 1);
        const std::size_t report = codec.encode({}, LinkReport{}, buffer);
        EXPECT_EQ(report, report_size(layout));
        EXPECT_TRUE(report == force_size(layout) || report == force_size(layout) + 1);
        EXPECT_GT(probe, kPathSize);
      }
}

TEST(WireSize, KeepsAChallengeSmallerThanItsTrigger) {
  EXPECT_LT(kPathSize, state_size(BodyLayout{.axes = 1, .tool_copies = false}, false));
}

}  // namespace
}  // namespace tandem::wire
