#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include "proto/schema/limits.pb.h"
#include "proto/schema/scene.pb.h"
#include "proto/wire/wire_messages.h"

// Tests that the setup message of a seat fits into its buffer for every valid scene.
namespace tandem {
namespace {

/// Returns the size in bytes of the longest message within the limits of its fields. The size follows from the wire
/// format, not from our encoder: tag, 8 bytes for a double, 10 for an integer, a length before a string.
std::size_t longest(const google::protobuf::Descriptor& message) {
  constexpr std::size_t kTag = 2, kDouble = 8, kWhole = 10, kLength = 3;
  std::size_t bytes = 0;
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    const std::size_t times = field.is_repeated() ? field.options().GetExtension(pb::limit).items() : 1;
    EXPECT_GT(times, 0u) << field.full_name() << " has no limit";
    std::size_t one = kTag;
    switch (field.cpp_type()) {
      case google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE:
        one += kLength + longest(*field.message_type());
        break;
      case google::protobuf::FieldDescriptor::CPPTYPE_STRING:
        one += kLength + wire::kSeatNameMax;
        break;
      case google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE:
        one += kDouble;
        break;
      default:
        one += kWhole;
        break;
    }
    bytes += times * one;
  }
  return bytes;
}

TEST(SeatSetup, FitsTheLongestSetupOfAnyScene) { EXPECT_LE(longest(*pb::SeatSetup::descriptor()), wire::kSetupMax); }

}  // namespace
}  // namespace tandem
