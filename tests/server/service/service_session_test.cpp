#include "server/service/service_session.h"

#include <gtest/gtest.h>

#include "server/directory/model_store.h"
#include "server/service/fenced_writer.h"
#include "server/service/service_catalogue.h"
#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

TEST(ServiceSession, ComesBackFromItsText) {
  ServiceSession spec = session_spec(200, "scene \"x\"\n{ }");
  spec.duration_s = 12.5;
  spec.tickets_only = spec.restart = spec.created = true;
  spec.ends_s = 1'800'000'000;
  EXPECT_EQ(parse_service_session(to_text(spec)), spec);
}

TEST(ServiceSession, RejectsEveryOtherText) {
  const std::string good = to_text(session_spec(1));
  for (std::size_t n = 0; n < good.size(); ++n) EXPECT_FALSE(parse_service_session(good.substr(0, n))) << n;
  for (const char* bad : {"", "[]", "1", "{}", "{\"id\":1}"}) EXPECT_FALSE(parse_service_session(bad)) << bad;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"duration_s\":0.0", "\"duration_s\":-1.0"},
                                                        {"\"duration_s\":0.0", "\"duration_s\":4e6"},
                                                        {"\"ends_s\":0", "\"ends_s\":-1"},
                                                        {"\"ends_s\":0", "\"ends_s\":0.5"},
                                                        {"\"restart\":false", "\"restart\":0"},
                                                        {"\"id\":\"01", "\"id\":\"0G"},
                                                        {"\"id\":\"01", "\"id\":\""},
                                                        {"scene text", ""}}) {
    ASSERT_NE(good.find(from), std::string::npos) << from;
    EXPECT_FALSE(parse_service_session(with(from, to))) << to;
  }
  EXPECT_FALSE(parse_service_session(std::string(kServiceSessionMax + 1, ' ')));
}

TEST(ListedText, ComesBackAndRejectsEveryPrefix) {
  rpc::ListedSession session{{}, "lab", rpc::SessionPhase::kPaused, {{"left", AccessRole::kTrainee, true, true}}};
  rpc::ListedSession read{{}, "lab", {}, {}};
  const std::string text = listed_text(session);
  ASSERT_TRUE(read_listed(text, read));
  EXPECT_EQ(read, session);
  for (std::size_t n = 0; n < text.size(); ++n) EXPECT_FALSE(read_listed(text.substr(0, n), read)) << n;
  EXPECT_EQ(read, session);
}

TEST(ListedText, GivesAHeldSessionAWordThatOlderServersKnow) {
  const rpc::ListedSession held{{}, "lab", rpc::SessionPhase::kHeld, {}};
  rpc::ListedSession read{{}, "lab", {}, {}};
  ASSERT_TRUE(read_listed(listed_text(held), read));
  EXPECT_EQ(read, held);
  EXPECT_NE(listed_text(held).find(R"("phase":"running")"), std::string::npos) << listed_text(held);
  EXPECT_FALSE(read_listed(R"({"phase":"running","held":1,"seats":[]})", read));
  EXPECT_TRUE(read_listed(R"({"phase":"running","held":false,"seats":[]})", read));
  EXPECT_EQ(read.phase, rpc::SessionPhase::kRunning);
}

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
  FencedWriter writer_{names_, 100ms};
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

TEST(ServiceCatalogue, IgnoresForeignAndDamagedKeys) {
  directory::ModelStore store;
  directory::ModelDirectory through(store);
  for (const char* key : {"/p/catalogue/x", "/p/catalogue/a b/spec", "/p/catalogue/a/spec/b", "/p/catalogue//spec"})
    static_cast<void>(store.execute(1, directory::Transaction{{}, {directory::Put{key, "x"}}, {}}));
  static_cast<void>(store.execute(1, directory::Transaction{{}, {directory::Put{"/p/catalogue/bad/spec", "{"}}, {}}));
  static_cast<void>(store.execute(
      1, directory::Transaction{{}, {directory::Put{"/p/catalogue/ok/spec", to_text(session_spec(1))}}, {}}));
  ServiceCatalogue catalogue{ServiceKeys("/p/")};
  for (directory::OperationId n = 1; n < 4; ++n) {
    if (const auto request = catalogue.poll_request(Time{}, n, 1s)) through.begin(n, *request);
    while (const auto reply = through.poll()) catalogue.on_reply(*reply);
  }
  EXPECT_TRUE(catalogue.follows());
  EXPECT_EQ(catalogue.rejected(), 5u);
  EXPECT_NE(catalogue.find("ok"), nullptr);
  EXPECT_EQ(catalogue.find("bad"), nullptr);
  EXPECT_EQ(catalogue.name_of({}), "ok");
  EXPECT_EQ(catalogue.name_of(rpc::SessionChoice{std::string("CODE000001")}), "ok");
  EXPECT_EQ(catalogue.name_of(rpc::SessionChoice{rpc::Id{}}), "");
}

}  // namespace
}  // namespace tandem::server::test
