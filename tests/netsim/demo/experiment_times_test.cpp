#include "netsim/demo/experiment_times.h"

#include <gtest/gtest.h>

namespace tandem::netsim::demo {
namespace {

TEST(ExperimentTimes, MarksPushesAndAuthorityOfFreeMotion) {
  plot::Panel panel;
  mark_times(panel, Task::kFreeMotion, 18, {.trainer_pushes = "b"});
  ASSERT_TRUE(panel.x);
  EXPECT_EQ(panel.x->hi, 18);
  ASSERT_EQ(panel.bands.size(), 2u);
  EXPECT_EQ(panel.bands[0].label, "");
  EXPECT_EQ(panel.bands[1].label, "b");
  ASSERT_EQ(panel.verticals.size(), 1u);
  EXPECT_EQ(panel.verticals[0].at, 11.5);
}

TEST(ExperimentTimes, MarksWallAndAlignmentOfContact) {
  plot::Panel panel;
  mark_times(panel, Task::kContact, 20, {.reaches_wall = "wall", .aligned = "aligned"});
  EXPECT_TRUE(panel.bands.empty());
  ASSERT_EQ(panel.verticals.size(), 2u);
  EXPECT_EQ(panel.verticals[0].at, 3);
  EXPECT_EQ(panel.verticals[1].label, "aligned");
}

}  // namespace
}  // namespace tandem::netsim::demo
