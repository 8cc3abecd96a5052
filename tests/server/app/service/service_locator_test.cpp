#include "server/app/service/service_locator.h"

#include <gtest/gtest.h>

namespace tandem::server {
namespace {

directory::ServerRecord at(const std::string& address) {
  directory::ServerRecord record;
  record.address = address;
  return record;
}

TEST(MemberAddresses, BeginWithTheServerItselfThenThePresentOnes) {
  EXPECT_EQ(member_addresses("b", {{"a", at("a:1")}, {"b", at("b:1")}}, {{"a", "a:1"}, {"b", "b:1"}, {"c", "c:1"}}),
            (std::vector<std::string>{"b:1", "a:1", "c:1"}));
  EXPECT_EQ(member_addresses("b", {{"b", at("b:2")}}, {{"b", "b:1"}}), (std::vector<std::string>{"b:2", "b:1"}))
      << "its new address before the one that it had";
}

TEST(MemberAddresses, BeginWithTheServerItselfAlsoWhileItsRecordIsMissing) {
  EXPECT_EQ(member_addresses("b", {{"a", at("a:1")}}, {{"a", "a:1"}, {"b", "b:1"}}),
            (std::vector<std::string>{"b:1", "a:1"}));
  EXPECT_EQ(member_addresses("b", {}, {}), std::vector<std::string>{});
}

TEST(MemberAddresses, AreLimitedAndThePresentOnesStay) {
  std::map<std::string, std::string> seen;
  for (int n = 10; n < 40; ++n) seen["old" + std::to_string(n)] = "old:" + std::to_string(n);
  const auto addresses = member_addresses("z", {{"y", at("y:1")}, {"z", at("z:1")}}, seen);
  ASSERT_EQ(addresses.size(), ServiceLocator::kMembersMax);
  EXPECT_EQ(addresses[0], "z:1");
  EXPECT_EQ(addresses[1], "y:1");
  EXPECT_EQ(addresses[2], "old:10");
}

}  // namespace
}  // namespace tandem::server
