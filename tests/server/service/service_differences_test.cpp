// Configurations of servers that differ from what their service runs.
#include "server/service/service_differences.h"

#include "tests/server/service/service_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

TEST(ServiceDifferences, NameWhatDiffersAndIgnoreIdsAndCodes) {
  const ServiceSession running = session_spec(1, "duration: 5\nseat {\n  name: \"a\"\n}\n");
  EXPECT_EQ(difference_text(session_spec(2, running.scene), running), "");
  ServiceSession other = running;
  other.scene = "duration: 5\nseat {\n  name: \"b\"\n}\n";
  EXPECT_EQ(difference_text(other, running), "scene contact (`name: \"b\"` here, `name: \"a\"` in the service)");
  other.scene = running.scene + "dof: 3\n";
  EXPECT_EQ(difference_text(other, running), "scene contact (`dof: 3` here, nothing in the service)");
  other = running;
  other.duration_s = 60;
  other.restart = true;
  EXPECT_EQ(difference_text(other, running),
            "duration 60 s here, that of the scene in the service, restart true here, false in the service");
  other = running;
  other.tickets_only = true;
  other.scene_name = "lesson";
  EXPECT_EQ(difference_text(other, running),
            "scene lesson here, contact in the service, tickets_only true here, false in the service");
  other = running;
  other.scene = std::string(10'000, 'x') + "\x1b[2J";
  EXPECT_LE(difference_text(other, running).size(), 300U);
  EXPECT_EQ(difference_text(other, running).find('\x1b'), std::string::npos);
}

struct ServiceDifferencesTest : ServiceTest {};

TEST_F(ServiceDifferencesTest, AreReportedOnceForSessionsOfOtherServers) {
  start("a", {{"lab", session_spec(1)}, {"same", session_spec(2)}});
  const std::map<std::string, ServiceSession> configured{
      {"lab", session_spec(3, "another scene")}, {"same", session_spec(4)}, {"own", session_spec(5)}};
  Server& b = start("b", configured);
  ServiceDifferences differences("b", configured);
  const auto found = differences.update(b.member);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].session, "lab");
  for (const char* words :
       {"at server a", "`another scene` here, `scene text` in the service", "holds", "same `session` blocks"})
    EXPECT_NE(found[0].text.find(words), std::string::npos) << found[0].text;
  EXPECT_TRUE(differences.update(b.member).empty());
  // Before the directory has answered, nothing is known.
  directory::ModelStore store;
  Server never(store, {.server = "b"});
  EXPECT_TRUE(ServiceDifferences("b", configured).update(never.member).empty());
}

}  // namespace
}  // namespace tandem::server
