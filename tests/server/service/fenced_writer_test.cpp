#include "server/service/fenced_writer.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/rng.h"
#include "server/directory/model_store.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

class FencedWriterTest : public testing::Test {
 protected:
  directory::Revision own(const std::string& session) {
    const auto reply = store_.execute(1, directory::Transaction{{}, {directory::Put{names_.owner(session), "a"}}, {}});
    return reply.revision;
  }
  void settle() {
    for (int n = 0; n < 100; ++n, now_ += 100ms)
      if (const auto request = writer_.poll_request(now_, ++operation_, 1s))
        writer_.on_reply(store_.execute(operation_, *request));
  }
  std::string value(const std::string& key) {
    const auto found = store_.entries().find(key);
    return found == store_.entries().end() ? "" : found->second.value;
  }
  directory::ModelStore store_;
  directory::DirectoryKeys names_;
  FencedWriter writer_{names_, "/writes/a", 100ms};
  directory::OperationId operation_ = 100;
  Time now_{};
};

TEST_F(FencedWriterTest, WritesTheNewestValuesOfManySessionsInFewTransactions) {
  for (int n = 0; n < 64; ++n) {
    const std::string name = "s" + std::to_string(n);
    const auto revision = own(name);
    writer_.set(name, "/v/" + name, "old", revision);
    writer_.set(name, "/v/" + name, "new", revision);
  }
  settle();
  EXPECT_EQ(writer_.counters().batches, 2u);
  EXPECT_EQ(writer_.counters().written, 64u);
  EXPECT_EQ(value("/v/s63"), "new");
}

TEST_F(FencedWriterTest, LostSessionStopsNoOther) {
  for (int n = 0; n < 4; ++n)
    writer_.set("s" + std::to_string(n), "/v/" + std::to_string(n), "x", own("s" + std::to_string(n)));
  static_cast<void>(store_.execute(1, directory::Transaction{{}, {directory::Erase{names_.owner("s2")}}, {}}));
  own("s2");  // another server owns it now
  settle();
  EXPECT_EQ(writer_.counters().written, 3u);
  EXPECT_EQ(writer_.counters().refused, 1u);
  EXPECT_EQ(value("/v/2"), "");
  EXPECT_EQ(value("/v/3"), "x");
  EXPECT_FALSE(writer_.pending("s2"));
}

TEST_F(FencedWriterTest, LostAnswerWritesAgainAndALargeValueIsCounted) {
  writer_.set("s", "/v", "1", own("s"));
  ASSERT_TRUE(writer_.poll_request(now_, ++operation_, 1s));
  EXPECT_TRUE(writer_.pending("s"));
  writer_.set("s", "/v", std::string(FencedWriter::kValueMax + 1, 'x'), 2);
  EXPECT_EQ(writer_.counters().overflowed, 1u);
  settle();
  EXPECT_EQ(writer_.counters().unknown, 1u);
  EXPECT_EQ(value("/v"), "1");
}

TEST_F(FencedWriterTest, ReportsTheMarkOfAValueThatIsWrittenAndOfNoOther) {
  const directory::Revision owned = own("s");
  writer_.set("s", "/v", "before", owned, 1);
  const auto request = writer_.poll_request(now_, ++operation_, 1s);
  ASSERT_TRUE(request);
  writer_.set("s", "/v", "stopped", owned, 2);
  EXPECT_EQ(writer_.poll_written(), std::nullopt) << "no answer yet";
  writer_.on_reply(store_.execute(operation_, *request));
  EXPECT_EQ(writer_.poll_written(), 1u) << "the value of before; the stop waits";
  EXPECT_EQ(writer_.poll_written(), std::nullopt);
  settle();
  EXPECT_EQ(writer_.poll_written(), 2u);
  EXPECT_EQ(value("/v"), "stopped");
  // An answer that is lost.
  writer_.set("s", "/v", "resumed", owned, 3);
  ASSERT_TRUE(writer_.poll_request(now_, ++operation_, 1s));
  EXPECT_EQ(writer_.problem(), "");
  now_ += 2s;
  const auto again = writer_.poll_request(now_, ++operation_, 1s);
  ASSERT_TRUE(again);
  EXPECT_EQ(writer_.problem(), "no answer in time");
  EXPECT_EQ(writer_.poll_written(), std::nullopt);
  directory::Reply refused;
  refused.operation = operation_;
  refused.outcome = directory::Outcome::kRefused;
  refused.reason = "out of space";
  writer_.on_reply(refused);
  EXPECT_EQ(writer_.problem(), "out of space");
  EXPECT_EQ(writer_.poll_written(), std::nullopt);
  now_ += 2s;
  ASSERT_TRUE(writer_.poll_request(now_, ++operation_, 1s));
  directory::Reply unreachable;
  unreachable.operation = operation_;
  unreachable.outcome = directory::Outcome::kUnknown;
  unreachable.reason = "failed to connect to all addresses; last error: UNKNOWN: ipv4:10.0.0.1:2379";
  unreachable.unreachable = true;
  writer_.on_reply(unreachable);
  EXPECT_EQ(writer_.problem(), "no server of it can be reached") << "participants read it";
  settle();
  EXPECT_EQ(writer_.poll_written(), 3u);
  EXPECT_EQ(writer_.problem(), "");
  // Another server owns the session.
  static_cast<void>(store_.execute(1, directory::Transaction{{}, {directory::Erase{names_.owner("s")}}, {}}));
  own("s");
  writer_.set("s", "/v", "too late", owned, 4);
  settle();
  EXPECT_EQ(writer_.counters().refused, 1u);
  EXPECT_EQ(writer_.poll_written(), std::nullopt);
  EXPECT_EQ(value("/v"), "resumed");
}

TEST_F(FencedWriterTest, WritesAHurriedValueFirstAndWithoutThePause) {
  for (int n = 0; n < 64; ++n) {
    const std::string name = "s" + std::to_string(n);
    writer_.set(name, "/v/" + name, "x", own(name));
  }
  const auto write = [&] {
    const auto request = writer_.poll_request(now_, ++operation_, 1s);
    if (request) writer_.on_reply(store_.execute(operation_, *request));
    return request.has_value();
  };
  EXPECT_TRUE(write());
  EXPECT_FALSE(write()) << "the pause";
  EXPECT_EQ(value("/v/s9"), "");
  writer_.hurry("/v/s9");
  EXPECT_TRUE(write());
  EXPECT_EQ(value("/v/s9"), "x");
}

/// Each of 48 sessions has a snapshot twice a second, and the directory takes a second for 32 of them.
TEST_F(FencedWriterTest, NoSessionWaitsForEverInADirectoryThatIsTooSlowForAll) {
  constexpr int kSessions = 48;
  directory::Revision owned[kSessions];
  for (int n = 0; n < kSessions; ++n) owned[n] = own("s" + std::to_string(n));
  std::optional<directory::Request> sent;
  for (int half_second = 0; half_second < 120; ++half_second, now_ += 500ms) {
    for (int n = 0; n < kSessions; ++n) {
      const std::string name = "s" + std::to_string(n);
      std::string text = std::to_string(half_second);
      text.resize(n % 2 == 0 ? 4 : std::size_t{48} << 10, ' ');  // a transaction has room for ten long ones
      writer_.set(name, "/v/" + name, std::move(text), owned[n]);
    }
    if (half_second % 2 == 0) {
      if (sent) writer_.on_reply(store_.execute(operation_, *sent));
      sent = writer_.poll_request(now_, ++operation_, 3s);
      ASSERT_TRUE(sent);
    }
  }
  for (int n = 0; n < kSessions; ++n)
    EXPECT_GT(std::stoi("0" + value("/v/s" + std::to_string(n))), 120 - 2 * 6) << "s" << n << ": at most 6 s old";
}

TEST_F(FencedWriterTest, TransactionThatIsExecutedAfterALaterOneChangesNothing) {
  const directory::Revision owned = own("s");
  writer_.set("s", "/v", "runs", owned, 1);
  const auto late = writer_.poll_request(now_, ++operation_, 1s);
  ASSERT_TRUE(late);
  now_ += 2s;
  writer_.set("s", "/v", "stopped", owned, 2);
  settle();
  ASSERT_EQ(writer_.poll_written(), 2u);
  EXPECT_FALSE(store_.execute(1, *late).held);
  EXPECT_EQ(value("/v"), "stopped");
  // Executed before the later one, but its answer is lost.
  writer_.set("s", "/v", "resumed", owned, 3);
  const auto early = writer_.poll_request(now_, ++operation_, 1s);
  ASSERT_TRUE(early);
  EXPECT_TRUE(store_.execute(operation_, *early).held);
  now_ += 2s;
  writer_.set("s", "/v", "stopped again", owned, 4);
  settle();
  EXPECT_EQ(writer_.counters().reordered, 1u);
  EXPECT_EQ(writer_.counters().refused, 0u) << "the session is not lost";
  EXPECT_EQ(writer_.poll_written(), 4u);
  EXPECT_EQ(value("/v"), "stopped again");
}

TEST_F(FencedWriterTest, ServerThatReturnsGoesOnAfterTheWritesOfItsFormerRun) {
  writer_.set("s", "/v", "1", own("s"));
  settle();
  writer_ = {names_, "/writes/a", 100ms};
  writer_.set("s2", "/v", "2", own("s2"));
  settle();
  EXPECT_EQ(value("/v"), "2");
  EXPECT_EQ(writer_.counters().refused, 0u);
}

/// Requests are executed at once, late and in any order, or never; answers are lost.
TEST_F(FencedWriterTest, NoOrderOfExecutionPutsAValueBackOfBeforeAWrittenOne) {
  std::uint64_t late = 0, reordered = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomStream rng(seed);
    store_ = {};
    writer_ = {names_, "/writes/a", 10ms};
    const directory::Revision owned[] = {own("s0"), own("s1")};
    std::uint64_t written[2] = {}, marked = 0;
    std::vector<directory::Request> away;
    for (int n = 0; n < 200; ++n, now_ += 20ms) {
      const std::size_t which = rng.below(2);
      ++marked;
      writer_.set("s" + std::to_string(which), "/v" + std::to_string(which), std::to_string(marked), owned[which],
                  2 * marked + which);
      if (const auto request = writer_.poll_request(now_, ++operation_, 50ms)) {
        if (rng.uniform() < 0.4) {
          away.push_back(*request);
        } else if (const auto reply = store_.execute(operation_, *request); rng.uniform() < 0.8) {
          writer_.on_reply(reply);
        }
      }
      if (!away.empty() && rng.uniform() < 0.3) {
        const std::size_t one = rng.below(away.size());
        late += store_.execute(1, away[one]).held ? 0 : 1;
        away.erase(away.begin() + static_cast<std::ptrdiff_t>(one));
      }
      while (const auto mark = writer_.poll_written()) written[*mark % 2] = *mark / 2;
      for (std::size_t s = 0; s < 2; ++s) {
        const std::string stored = value("/v" + std::to_string(s));
        ASSERT_GE(stored.empty() ? 0 : std::stoull(stored), written[s]) << "seed " << seed << ", step " << n;
      }
    }
    reordered += writer_.counters().reordered;
    ASSERT_EQ(writer_.counters().refused, 0u);
    settle();
    ASSERT_FALSE(writer_.pending("s0") || writer_.pending("s1"));
  }
  EXPECT_GT(late, 1000u);
  EXPECT_GT(reordered, 1000u);
}

}  // namespace
}  // namespace tandem::server
