#include "client/app/server_addresses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/io/blocked_lookup.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

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
  EXPECT_EQ(texts(addresses_to_try(options, known).known()),
            (std::vector<std::string>{"127.0.0.1:7000", "127.0.0.2:7000"}));
  known[1].address = "127.0.0.1:7000";
  EXPECT_EQ(addresses_to_try(options, known).size(), 3U);
  options.typed = {"lab:7000"};
  known = {{"lab:7000", {}, "a", ServicePin{}, {"127.0.0.4:7000"}}};
  EXPECT_EQ(texts(addresses_to_try(options, known).known()).back(), "127.0.0.4:7000");
  for (int i = 0; i < 100; ++i)
    options.alternatives.push_back(*io::parse_address("127.0.1." + std::to_string(i) + ":7", 1));
  EXPECT_EQ(addresses_to_try(options, known).size(), kAddressesTried);
}

TEST(ServerAddresses, AreResolvedOneAtATimeAfterAllThatAreKnown) {
  std::vector<std::string> asked;
  JoinOptions options{.server = *io::numeric_address("127.0.0.1:7000", 1)};
  options.names = io::NameResolver([&](const std::string& name) {
    asked.push_back(name);
    return io::resolve_addresses(name == "lab-b:7000" ? "127.0.0.5:7000" : "wrong", 1);
  });
  auto list = addresses_to_try(options, {{"127.0.0.1:7000", {}, "a", {}, {"lab-a:7", "lab-b:7000", "127.0.0.2:7"}}});
  list.begin(10s);
  EXPECT_TRUE(list.has(1));
  EXPECT_EQ(texts(list.known()), (std::vector<std::string>{"127.0.0.1:7000", "127.0.0.2:7"}));
  EXPECT_TRUE(asked.empty()) << "the known ones come first";
  EXPECT_TRUE(list.has(2));
  EXPECT_EQ(io::to_text(list[2]), "127.0.0.5:7000");
  EXPECT_EQ(asked, (std::vector<std::string>{"lab-a:7", "lab-b:7000"}));
  EXPECT_FALSE(list.has(3));
  EXPECT_NE(list.unresolved(), "");
  EXPECT_FALSE(list.pending());
  list.begin(10s);
  EXPECT_FALSE(list.has(3));
  EXPECT_EQ(asked.back(), "lab-a:7") << "only names without address are asked for again";
  EXPECT_EQ(asked.size(), 3U);
}

TEST(ServerAddresses, ShareTheWaitForNamesAndSayThatALookupLasts) {
  tandem::test::BlockedLookup dns;
  JoinOptions options;
  options.names = dns.resolver();
  ServerAddresses list{options};
  list.add("lab-a:7000");
  list.add("lab-b:7000");
  list.begin(1ms);
  EXPECT_FALSE(list.has(0));
  EXPECT_TRUE(list.pending());
  EXPECT_FALSE(list.interrupted());
  dns.wait_for(2);
  dns.answer(io::NameResolver::Addresses{*io::numeric_address("127.0.0.5:7000", 1)});
  list.begin(1h);
  EXPECT_TRUE(list.has(0));
  EXPECT_FALSE(list.has(1)) << "both names have one address";
  EXPECT_FALSE(list.pending());
}

}  // namespace
}  // namespace tandem::client
