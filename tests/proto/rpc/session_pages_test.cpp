// The list of sessions that comes in pages.
#include "proto/rpc/session_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace tandem::rpc {
namespace {

/// A server with numbered sessions; session n has name "sN".
struct PagedServer {
  std::uint32_t first = 1, end = 1;  ///< numbers of the open sessions: first ... end - 1
  std::size_t requests = 0;

  std::optional<SessionList> ask(const SessionListRequest& request) {
    ++requests;
    SessionList page;
    for (std::uint32_t n = std::max(first, request.after + 1); n < end; ++n) {
      if (page.sessions.size() == kListedSessionsMax) {
        page.more = true;
        page.last = n - 1;
        break;
      }
      page.sessions.push_back({{}, "s" + std::to_string(n), SessionPhase::kWaiting, {}});
    }
    return page;
  }
};

TEST(SessionPages, GiveEverySessionOnceInOrder) {
  for (const std::uint32_t sessions : {0U, 1U, 48U, 49U, 96U, 97U, 150U, 256U}) {
    SCOPED_TRACE(sessions);
    PagedServer server{1, 1 + sessions};
    const auto all = all_sessions([&](const SessionListRequest& page) { return server.ask(page); });
    ASSERT_TRUE(all);
    EXPECT_FALSE(all->more);
    ASSERT_EQ(all->sessions.size(), sessions);
    for (std::uint32_t i = 0; i < sessions; ++i) EXPECT_EQ(all->sessions[i].name, "s" + std::to_string(i + 1));
    EXPECT_EQ(server.requests, std::max<std::size_t>(1, (sessions + kListedSessionsMax - 1) / kListedSessionsMax));
  }
}

TEST(SessionPages, MissNoSessionIfEarlierOnesEndBetweenTwoPages) {
  PagedServer server{1, 101};
  const auto all = all_sessions([&](const SessionListRequest& page) {
    auto list = server.ask(page);
    server.first = 60;  // sessions 1 to 59 end after the first page, which names 1 to 48
    return list;
  });
  ASSERT_TRUE(all);
  ASSERT_EQ(all->sessions.size(), 48U + 41U);
  EXPECT_EQ(all->sessions[47].name, "s48");
  EXPECT_EQ(all->sessions[48].name, "s60");
  EXPECT_EQ(all->sessions.back().name, "s100");
}

TEST(SessionPages, EndAfterABoundedNumberOfRequestsToAServerThatAlwaysAnnouncesMore) {
  std::size_t requests = 0;
  const auto all = all_sessions([&](const SessionListRequest&) -> std::optional<SessionList> {
    ++requests;
    return SessionList{{}, true, 7};
  });
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->more);
  EXPECT_EQ(requests, kSessionPagesMax);
}

TEST(SessionPages, OfAServiceHoldMoreAndTellOfOneOldPage) {
  std::size_t requests = 0;
  const auto all = all_sessions(
      [&](const SessionListRequest& page) -> std::optional<SessionList> {
        EXPECT_TRUE(page.service);
        ++requests;
        return SessionList{{}, requests < 12, 7, requests == 3};
      },
      true);
  ASSERT_TRUE(all);
  EXPECT_FALSE(all->more);
  EXPECT_TRUE(all->old);
  EXPECT_EQ(requests, 12U);
}

TEST(SessionPages, FailIfOnePageFails) {
  std::size_t requests = 0;
  const auto all = all_sessions([&](const SessionListRequest&) -> std::optional<SessionList> {
    return ++requests == 2 ? std::nullopt : std::optional(SessionList{{}, true, 7});
  });
  EXPECT_FALSE(all);
  EXPECT_EQ(requests, 2U);
}

}  // namespace
}  // namespace tandem::rpc
