#include "proto/recording/view_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proto/schema/foxglove.pb.h"

namespace tandem::rec {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Direction of +x after the rotation.
Triple rotated_x(const foxglove::Quaternion& q) {
  return {1 - 2 * (q.y() * q.y() + q.z() * q.z()), 2 * (q.x() * q.y() + q.w() * q.z()),
          2 * (q.x() * q.z() - q.w() * q.y())};
}

TEST(ViewMessages, DrawAForceAsAnArrowOfItsDirectionAndLength) {
  for (const Triple& force : {Triple{1, 0, 0}, Triple{-2, 0, 0}, Triple{0, 3, 0}, Triple{0, 0, -1}, Triple{1, 2, -2}}) {
    foxglove::SceneUpdate update;
    ASSERT_TRUE(update.ParseFromString(
        encode_scene_update(1'500'000'000, {{"seat a", {0.1, 0.2, 0.3}, force, 0.01, {1, 0, 0, 1}, "a"}}, {})));
    ASSERT_EQ(update.entities_size(), 1);
    const foxglove::SceneEntity& entity = update.entities(0);
    EXPECT_EQ(entity.timestamp().seconds(), 1);
    EXPECT_EQ(entity.timestamp().nanos(), 500'000'000);
    EXPECT_EQ(entity.frame_id(), kViewFrame);
    ASSERT_EQ(entity.arrows_size(), 1);
    const foxglove::ArrowPrimitive& arrow = entity.arrows(0);
    EXPECT_EQ(arrow.pose().position().y(), 0.2);
    const double norm = std::hypot(force[0], force[1], force[2]);
    EXPECT_NEAR(arrow.shaft_length() + arrow.head_length(), norm * kViewMetresPerNewton, 1e-12);
    const Triple direction = rotated_x(arrow.pose().orientation());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(direction[k], force[k] / norm, 1e-12);
  }
}

TEST(ViewMessages, LeaveOutWhatIsNotFinite) {
  foxglove::SceneUpdate update;
  ASSERT_TRUE(update.ParseFromString(encode_scene_update(0,
                                                         {{"a", {kNan, 0, 0}, {}, 0.01, {}, "a"},
                                                          {"b", {0, 0, 0}, {kNan, 0, 0}, 0.01, {}, "b"},
                                                          {"c", {0, 0, 0}, {5e-4, 0, 0}, 0.01, {}, "c"}},
                                                         {})));
  ASSERT_EQ(update.entities_size(), 2);
  EXPECT_EQ(update.entities(0).id(), "b");
  EXPECT_EQ(update.entities(0).arrows_size(), 0);
  EXPECT_EQ(update.entities(1).arrows_size(), 0);
}

TEST(ViewMessages, PlaceFramesPosesAndLines) {
  foxglove::FrameTransform transform;
  ASSERT_TRUE(transform.ParseFromString(encode_transform(2, "trainer", {1, 2, 3})));
  EXPECT_EQ(transform.parent_frame_id(), kViewFrame);
  EXPECT_EQ(transform.child_frame_id(), "trainer");
  EXPECT_EQ(transform.translation().z(), 3);
  EXPECT_EQ(transform.rotation().w(), 1);
  foxglove::PoseInFrame pose;
  ASSERT_TRUE(pose.ParseFromString(encode_pose(2, {1, 2, 3})));
  EXPECT_EQ(pose.pose().position().x(), 1);
  EXPECT_EQ(pose.pose().orientation().w(), 1);
  foxglove::Log log;
  ASSERT_TRUE(log.ParseFromString(encode_log(7, LogLevel::kWarning, "trainer", "gate tripped")));
  EXPECT_EQ(log.level(), foxglove::Log::WARNING);
  EXPECT_EQ(log.name(), "trainer");
  EXPECT_EQ(log.message(), "gate tripped");
}

}  // namespace
}  // namespace tandem::rec
