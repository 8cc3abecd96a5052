#include "server/service/service_session.h"

#include <gtest/gtest.h>

#include "server/directory/model_store.h"
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
  EXPECT_EQ(to_text(spec).find("epoch_base"), std::string::npos);
  spec.epoch_base = 1'000'000;
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
                                                        {"\"ends_s\":0", "\"ends_s\":8000000001"},
                                                        {"CODE000001", "CODE-00001"},
                                                        {"CODE000001", "\\u001b[2J"},
                                                        {"\"ends_s\":0", "\"epoch_base\":-1,\"ends_s\":0"},
                                                        {"\"ends_s\":0", "\"epoch_base\":\"1\",\"ends_s\":0"},
                                                        {"\"ends_s\":0", "\"epoch_base\":9e18,\"ends_s\":0"},
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
