#include "common/auth/exporter_context.h"

#include <gtest/gtest.h>

#include "common/transport/digest.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

TEST(ExporterContext, DependsOnEachPartAndHasTheDocumentedLayout) {
  const ExporterContext context{test::counting<16>(1), 0x0102030405060708, 0x0a0b0c0d, AccessRole::kEvaluator, "seat"};
  const auto id = test::counting<16>(1);
  std::vector<std::byte> by_hand(id.begin(), id.end());
  for (const unsigned b : {8u, 7u, 6u, 5u, 4u, 3u, 2u, 1u, 0x0du, 0x0cu, 0x0bu, 0x0au, 2u, 4u, unsigned{'s'},
                           unsigned{'e'}, unsigned{'a'}, unsigned{'t'}})
    by_hand.push_back(static_cast<std::byte>(b));
  EXPECT_EQ(digest_of(context), transport::sha256(by_hand));
  const auto other = [&](auto change) {
    ExporterContext c = context;
    change(c);
    return digest_of(c) != digest_of(context);
  };
  EXPECT_TRUE(other([](ExporterContext& c) { c.session_id[3] ^= std::byte{1}; }));
  EXPECT_TRUE(other([](ExporterContext& c) { ++c.epoch; }));
  EXPECT_TRUE(other([](ExporterContext& c) { ++c.server_cid; }));
  EXPECT_TRUE(other([](ExporterContext& c) { c.role = AccessRole::kInstructor; }));
  EXPECT_TRUE(other([](ExporterContext& c) { c.seat = "sea"; }));
}

}  // namespace
}  // namespace tandem::auth
