#include "proto/recording/message_schema.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

namespace tandem::rec {
namespace {

TEST(MessageSchema, IsCompleteByItself) {
  for (std::size_t k = 0; k < kMessageKinds; ++k) {
    const auto kind = static_cast<MessageKind>(k);
    SCOPED_TRACE(message_name(kind));
    google::protobuf::FileDescriptorSet set;
    ASSERT_TRUE(set.ParseFromString(message_schema(kind)));
    google::protobuf::DescriptorPool pool;  // knows nothing but the set
    for (const auto& file : set.file()) ASSERT_NE(pool.BuildFile(file), nullptr);
    EXPECT_NE(pool.FindMessageTypeByName(message_name(kind)), nullptr);
  }
}

TEST(MessageSchema, HasTheNamesThatViewersKnow) {
  EXPECT_EQ(message_name(MessageKind::kSceneUpdate), "foxglove.SceneUpdate");
  EXPECT_EQ(message_name(MessageKind::kFrameTransform), "foxglove.FrameTransform");
  EXPECT_EQ(message_name(MessageKind::kPoseInFrame), "foxglove.PoseInFrame");
  EXPECT_EQ(message_name(MessageKind::kLog), "foxglove.Log");
  EXPECT_EQ(message_name(MessageKind::kSeat), "tandem.recording.Seat");
}

}  // namespace
}  // namespace tandem::rec
