#include "common/io/name_resolver.h"

#include <gtest/gtest.h>

#include "common/io/event_fd.h"
#include "tests/io/blocked_lookup.h"

namespace tandem::io {
namespace {

using namespace std::chrono_literals;
using Kind = NameResolver::Failure::Kind;

constexpr Duration kLong = 1h;

const SocketAddress& address() {
  static const SocketAddress one = *numeric_address("192.0.2.1:7000", 1);
  return one;
}

TEST(NameResolver, NeedsNoLookupForAnAddress) {
  test::BlockedLookup dns;
  for (const char* text : {"127.0.0.1:7000", "[::1]:7000"}) {
    const auto found = dns.resolver().resolve(text, 0s, -1);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(to_text(found->front()), text);
  }
  EXPECT_TRUE(dns.names().empty());
}

TEST(NameResolver, EndsTheWaitAtASignal) {
  test::BlockedLookup dns;
  const EventFd signal;
  signal.signal();
  const auto found = dns.resolver().resolve("lab:7000", kLong, signal.get());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().kind, Kind::kInterrupted);
}

TEST(NameResolver, KeepsAResultThatComesAfterTheWaitForTheNextCall) {
  test::BlockedLookup dns;
  const NameResolver resolver = dns.resolver();
  const auto early = resolver.resolve("lab:7000", 1ms, -1);
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().kind, Kind::kPending);
  EXPECT_NE(early.error().text.find("\"lab:7000\""), std::string::npos) << early.error().text;
  dns.wait_for(1);
  dns.answer(NameResolver::Addresses{address()});
  const auto late = resolver.resolve("lab:7000", kLong, -1);
  ASSERT_TRUE(late);
  EXPECT_EQ(to_text(late->front()), "192.0.2.1:7000");
  EXPECT_EQ(dns.names().size(), 1U);
  EXPECT_TRUE(resolver.resolve("lab:7000", kLong, -1));
  EXPECT_EQ(dns.names().size(), 2U) << "a result is used once, because addresses change";
}

TEST(NameResolver, PassesOnWhyANameHasNoAddress) {
  test::BlockedLookup dns;
  dns.answer(std::unexpected(std::string("no such host")));
  const auto found = dns.resolver().resolve("lab:7000", kLong, -1);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().kind, Kind::kUnknown);
  EXPECT_EQ(found.error().text, "no such host");
}

TEST(NameResolver, HasAtMostSomeLookupsAtATime) {
  test::BlockedLookup dns;
  const NameResolver resolver = dns.resolver();
  const auto ask = [&](std::size_t i, Duration wait) {
    return resolver.resolve("lab-" + std::to_string(i) + ":7000", wait, -1);
  };
  for (std::size_t i = 0; i < 3 * NameResolver::kLookupsMax; ++i) {
    const auto found = ask(i, 0s);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().kind, Kind::kPending);
  }
  dns.wait_for(NameResolver::kLookupsMax);
  EXPECT_EQ(dns.names().size(), NameResolver::kLookupsMax);
  dns.answer(NameResolver::Addresses{address()});
  EXPECT_TRUE(ask(0, kLong));
  EXPECT_TRUE(ask(NameResolver::kLookupsMax, kLong)) << "takes the place of the first";
}

}  // namespace
}  // namespace tandem::io
