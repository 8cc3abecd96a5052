#include "client/app/join_hello.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

TEST(JoinHello, NamesTheSeatAndItsDevice) {
  JoinOptions options;
  options.seat = "trainer";
  options.caps.joints = options.caps.tip_axes = 3;
  const rpc::Hello hello = base_hello(options);
  EXPECT_EQ(hello.seat, "trainer");
  EXPECT_FALSE(hello.link_test);
  EXPECT_EQ(hello.device.joints, 3U);
}

TEST(JoinHello, RequestsALinkTestWithoutASeatAndAConsoleWithoutADevice) {
  JoinOptions options;
  options.caps.joints = 3;
  EXPECT_TRUE(base_hello(options).link_test);
  options.console = AccessRole::kInstructor;
  EXPECT_FALSE(base_hello(options).link_test);
  EXPECT_EQ(base_hello(options).device.joints, rpc::DeviceFacts{}.joints);
}

TEST(JoinHello, DrawsAConnectionIdThatIsNeverZero) {
  std::uint32_t all = 0, common = ~0U;
  for (int k = 0; k < 64; ++k) {
    const std::uint32_t cid = base_hello({}).client_cid;
    EXPECT_EQ(cid & 1U, 1U);
    all |= cid;
    common &= cid;
  }
  EXPECT_EQ(all, ~0U);
  EXPECT_EQ(common, 1U);
}

}  // namespace
}  // namespace tandem::client
