#include "proto/text/message_keys.h"

#include <gtest/gtest.h>

#include "proto/schema/scene.pb.h"

namespace tandem::text {
namespace {

struct Numbers {
  double hold = 7;
  std::optional<double> force;
  bool latch = true;
};
constexpr std::array<MessageKey<Numbers>, 3> kNumbers{
    {{"local_hold_ms", &Numbers::hold, 1e3}, {"force_max_n", &Numbers::force}, {"latch", &Numbers::latch}}};

TEST(MessageKeys, ReadsKeysThatAreSetInTheUnitOfTheStruct) {
  pb::Gate message;
  message.set_local_hold_ms(250);
  message.set_force_max_n(3);
  message.set_latch(false);
  Numbers out;
  read_keys(message, kNumbers, out);
  EXPECT_EQ(out.hold, 0.25);
  EXPECT_EQ(out.force, 3);
  EXPECT_FALSE(out.latch);
}

TEST(MessageKeys, LeavesMembersOfAbsentKeysUnchanged) {
  Numbers out;
  read_keys(pb::Gate{}, kNumbers, out);
  EXPECT_EQ(out.hold, 7);
  EXPECT_FALSE(out.force);
  EXPECT_TRUE(out.latch);
}

TEST(MessageKeys, WritesEachKeyButEmptyOptionals) {
  pb::Gate message;
  write_keys(Numbers{.hold = 0.02, .force = std::nullopt, .latch = false}, kNumbers, message);
  EXPECT_EQ(message.local_hold_ms(), 20);
  EXPECT_FALSE(message.has_force_max_n());
  EXPECT_TRUE(message.has_latch());
  EXPECT_FALSE(message.latch());
  write_keys(Numbers{.hold = 0.02, .force = 4, .latch = true}, kNumbers, message);
  EXPECT_EQ(message.force_max_n(), 4);
}

struct Mask {
  std::uint32_t bits = 0;
};
constexpr std::array<MessageKey<Mask>, 1> kMask{{{"drivers", &Mask::bits}}};

TEST(MessageKeys, CopiesWholeNumbersExactly) {
  pb::SeatSetup message;
  write_keys(Mask{4294967295U}, kMask, message);
  EXPECT_EQ(message.drivers(), 4294967295U);
  Mask out;
  read_keys(message, kMask, out);
  EXPECT_EQ(out.bits, 4294967295U);
}

}  // namespace
}  // namespace tandem::text
