#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include "proto/limits.pb.h"
#include "proto/scene.pb.h"
#include "proto/wire.h"

// Whether what a client is told about its seat fits into what is kept for it, whatever the scene says.
namespace tandem {
namespace {

/// Bytes of the longest message that the limits of its fields allow: by the wire format (tag, 8 bytes of a double, 10 of a whole
/// number, length before a text), not by what our writer happens to write.
std::size_t longest(const google::protobuf::Descriptor& message) {
  constexpr std::size_t kTag = 2, kDouble = 8, kWhole = 10, kLength = 3;
  std::size_t bytes = 0;
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    const std::size_t times = field.is_repeated() ? field.options().GetExtension(pb::limit).items() : 1;
    EXPECT_GT(times, 0u) << field.full_name() << " has no limit";
    std::size_t one = kTag;
    switch (field.cpp_type()) {
      case google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE: one += kLength + longest(*field.message_type()); break;
      case google::protobuf::FieldDescriptor::CPPTYPE_STRING: one += kLength + wire::kSeatNameMax; break;
      case google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE: one += kDouble; break;
      default: one += kWhole; break;
    }
    bytes += times * one;
  }
  return bytes;
}

TEST(SeatSetup, LongestThatAnySceneMakesHasRoom) { EXPECT_LE(longest(*pb::SeatSetup::descriptor()), wire::kSetupMax); }

}  // namespace
}  // namespace tandem
