#include "client/app/server_addresses.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tandem::client {
namespace {

std::vector<std::string> texts(const std::vector<io::SocketAddress>& list) {
  std::vector<std::string> out;
  for (const io::SocketAddress& address : list) out.push_back(io::to_text(address));
  return out;
}

TEST(ServerAddresses, TakeSeveralSeparatedByCommasAndEachOnce) {
  JoinOptions options;
  ASSERT_EQ(set_server_addresses("127.0.0.1:7000,[::1]:7001,127.0.0.1:7000,127.0.0.2:7000", options), "");
  EXPECT_EQ(io::to_text(options.server), "127.0.0.1:7000");
  EXPECT_EQ(texts(options.alternatives), (std::vector<std::string>{"[::1]:7001", "127.0.0.2:7000"}));
  EXPECT_EQ(options.unresolved, "");
}

TEST(ServerAddresses, OfANameAreAllOfItsAddressesWithIPv4First) {
  const auto all = io::resolve_addresses("localhost:7000", 1);
  ASSERT_TRUE(all) << all.error();
  JoinOptions options;
  ASSERT_EQ(set_server_addresses("localhost:7000", options), "");
  EXPECT_EQ(io::to_text(options.server), "127.0.0.1:7000");
  EXPECT_EQ(options.alternatives.size() + 1, all->size());
  EXPECT_EQ(options.typed, std::vector<std::string>{"localhost:7000"});
  for (std::size_t i = 1; i < all->size(); ++i) EXPECT_LE((*all)[i - 1].family(), (*all)[i].family());
}

TEST(ServerAddresses, NameEveryMistakeOfTheFormAndKeepUnresolvedNamesForErrors) {
  JoinOptions options;
  for (const char* wrong :
       {"", "lab", "127.0.0.1:7000,", "127.0.0.1:7000,lab", "127.0.0.1:0", "::1:7000", "127.0.0.1:70000"})
    EXPECT_NE(set_server_addresses(wrong, options), "") << wrong;
  EXPECT_NE(set_server_addresses("no-such-host.invalid:7000", options).find("no-such-host.invalid"), std::string::npos);
  JoinOptions half;
  ASSERT_EQ(set_server_addresses("no-such-host.invalid:7000,127.0.0.1:7000", half), "");
  EXPECT_EQ(io::to_text(half.server), "127.0.0.1:7000");
  EXPECT_NE(half.unresolved.find("no-such-host.invalid"), std::string::npos);
}

TEST(ServerAddresses, GoOnWithTheMembersThatWereLearntFromOneOfThem) {
  JoinOptions options;
  ASSERT_EQ(set_server_addresses("127.0.0.1:7000", options), "");
  std::vector<ServerRow> known{{"127.0.0.9:7000", {}, "a", ServicePin{}, {"127.0.0.1:7000", "127.0.0.2:7000"}},
                               {"127.0.0.8:7000", {}, "a", ServicePin{}, {"127.0.0.3:7000"}}};
  EXPECT_EQ(texts(addresses_to_try(options, known)), (std::vector<std::string>{"127.0.0.1:7000", "127.0.0.2:7000"}));
  known[1].address = "127.0.0.1:7000";
  EXPECT_EQ(texts(addresses_to_try(options, known)).size(), 3U);
  options.typed = {"lab:7000"};
  known = {{"lab:7000", {}, "a", ServicePin{}, {"127.0.0.4:7000"}}};
  EXPECT_EQ(texts(addresses_to_try(options, known)).back(), "127.0.0.4:7000");
  for (int i = 0; i < 100; ++i)
    options.alternatives.push_back(*io::parse_address("127.0.1." + std::to_string(i) + ":7", 1));
  EXPECT_EQ(addresses_to_try(options, known).size(), kAddressesTried);
}

}  // namespace
}  // namespace tandem::client
