// The list of a service's sessions that commands in a member's state folder read.
#include "server/service/service_list.h"

#include "tests/server/service/service_fixture.h"

namespace tandem::server {
namespace {

using namespace test;
using Known = ServiceList::Known;

ServiceList listed_of(ServiceListReader& reader, const ServiceMember& member, Time now) {
  static_cast<void>(reader.look(member, now));
  return reader.list();
}

struct ServiceListTest : ServiceTest {
  /// Publishes phase and seats of a session, as its server does.
  void list_seat(Server& server, const std::string& session, bool taken,
                 rpc::SessionPhase phase = rpc::SessionPhase::kRunning) {
    rpc::ListedSession listed;
    listed.phase = phase;
    listed.seats = {{"trainee", AccessRole::kTrainee, taken, true}};
    server.member.sessions().set_listed(session, listed_text(listed));
    pass(1s);
  }
};

TEST_F(ServiceListTest, NamesTheSessionsOfOtherServersWithTheirSeats) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  list_seat(a, "lab", true);
  ServiceListReader reader;
  EXPECT_TRUE(reader.look(b.member, now_));
  const ServiceList list = reader.list();
  EXPECT_EQ(list.known, Known::kNow);
  ASSERT_EQ(list.sessions.size(), 1U);
  EXPECT_EQ(list.sessions[0].code, "CODE000001");
  EXPECT_EQ(list.sessions[0].listed,
            (rpc::ListedSession{session_spec(1).id, "lab", {}, {{"trainee", AccessRole::kTrainee, false, true}}, "a"}));
  EXPECT_EQ(parse_service_list(to_text(list)), list);
  EXPECT_FALSE(reader.look(b.member, now_)) << "nothing changed";
  const std::string text = service_text(list, now_);
  for (const char* words : {"lab: running, code CODE0-00001", "server a"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST_F(ServiceListTest, FollowsEndsOfSessionsAndTheLossOfTheirServer) {
  Server& a = start("a", {{"lab", session_spec(1)}, {"two", session_spec(2)}});
  Server& b = start("b");
  ServiceListReader reader;
  EXPECT_EQ(listed_of(reader, b.member, now_).sessions.size(), 2U);
  a.member.sessions().end("two");
  pass(1s);
  EXPECT_TRUE(reader.look(b.member, now_));
  ASSERT_EQ(reader.list().sessions.size(), 1U);
  b.runs = false;
  a.runs = false;
  pass(5s);
  Server& c = start("c");
  ServiceListReader of_c;
  const ServiceList list = listed_of(of_c, c.member, now_);
  ASSERT_EQ(list.sessions.size(), 1U);
  EXPECT_EQ(list.sessions[0].listed.server, "");
  EXPECT_NE(service_text(list, now_).find("no server now"), std::string::npos);
}

TEST_F(ServiceListTest, SaysWhatTheDirectoryHasTold) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  ServiceListReader reader;
  EXPECT_EQ(listed_of(reader, a.member, now_).known, Known::kNow);
  a.directory.cut = true;
  pass(5s);
  const ServiceList old = listed_of(reader, a.member, now_);
  EXPECT_EQ(old.known, Known::kOld);
  EXPECT_EQ(old.sessions.size(), 1U);
  EXPECT_NE(service_text(old, now_).find("may have changed"), std::string::npos);
  directory::ModelStore store;
  Server never(store, {.server = "b"});
  never.directory.cut = true;
  never.member.step(now_);
  ServiceListReader of_never;
  const ServiceList nothing = listed_of(of_never, never.member, now_);
  EXPECT_EQ(nothing.known, Known::kNothing);
  EXPECT_NE(service_text(nothing, now_).find("has not answered this server yet"), std::string::npos);
  EXPECT_EQ(service_text({.known = Known::kNow, .sessions = {}, .answered = {}}, now_),
            "the service has no other session\n");
}

TEST_F(ServiceListTest, SaysThatASessionIsHeldOrMayBe) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  ServiceListReader reader;
  const auto text_now = [&] { return service_text(listed_of(reader, b.member, now_), now_); };
  EXPECT_NE(text_now().find("lab: code"), std::string::npos) << "nothing published yet: " << text_now();
  list_seat(a, "lab", true, rpc::SessionPhase::kHeld);
  EXPECT_NE(text_now().find("lab: held, code"), std::string::npos) << text_now();
  EXPECT_NE(service_json(listed_of(reader, b.member, now_), now_).find("\"phase\":\"held\""), std::string::npos);
  list_seat(a, "lab", true);
  EXPECT_NE(text_now().find("lab: running, code"), std::string::npos) << text_now();
  // No server reaches etcd: the owner holds its sessions, and cannot say so.
  for (Server* server : {&a, &b}) server->directory.cut = true;
  pass(12s);
  const std::string text = text_now();
  for (const char* words : {"lab: was running, code", "running ones may be held", "(last answer 1"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " not in " << text;
  const ServiceList list = listed_of(reader, b.member, now_);
  EXPECT_EQ(parse_service_list(to_text(list)), list);
  EXPECT_NE(service_json(list, now_).find("\"silent_s\":1"), std::string::npos) << service_json(list, now_);
  const std::string written = to_text(list);
  pass(5s);
  EXPECT_FALSE(reader.look(b.member, now_)) << "the file has the time of the answer, not its age";
  EXPECT_EQ(to_text(reader.list()), written);
}

// The text of its last server stays in the directory.
TEST_F(ServiceListTest, NamesNoPhaseOfASessionWithoutServer) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  list_seat(a, "lab", true);
  a.runs = false;
  pass(5s);
  Server& c = start("c");
  ServiceListReader reader;
  const std::string text = service_text(listed_of(reader, c.member, now_), now_);
  EXPECT_NE(text.find("lab: code"), std::string::npos) << text;
}

TEST_F(ServiceListTest, IsOldOnceAnAnswerOfTheDirectoryIsOverdue) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  ServiceListReader reader;
  const auto known_during = [&](Duration time, Known wanted) {
    for (const Time end = now_ + time; now_ < end; pass(20ms))
      EXPECT_EQ(listed_of(reader, a.member, now_).known, wanted);
  };
  known_during(5s, Known::kNow);
  a.directory.answers_lost = true;  // requests leave, and the watch stays open
  pass(760ms);                      // one and a half periods of renewal, rounded up to steps
  EXPECT_TRUE(reader.look_at_directory(a.member, now_));
  known_during(3s, Known::kOld);
  a.directory.answers_lost = false;
  pass(1500ms);
  known_during(1s, Known::kNow);
}

TEST(ServiceList, RejectsOtherTexts) {
  ServiceList list{.known = Known::kOld, .sessions = {}, .answered = Time{} + 7s};
  list.sessions.push_back(
      {{session_spec(3).id, "lab", {}, {{"trainer", AccessRole::kInstructor, false, true}}, "a"}, ""});
  const std::string text = to_text(list);
  ASSERT_EQ(parse_service_list(text), list);
  for (std::size_t end = 0; end + 2 < text.size(); ++end) EXPECT_FALSE(parse_service_list(text.substr(0, end))) << end;
  std::size_t rejected = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string flipped = text;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x40);
    rejected += parse_service_list(flipped) ? 0 : 1;
  }
  EXPECT_GT(rejected, text.size() / 3);
  for (const char* other : {"[]", "{\"directory\":\"old\",\"answered_s\":-1,\"sessions\":[]}",
                            "{\"directory\":\"old\",\"answered_s\":1e300,\"sessions\":[]}",
                            "{\"directory\":\"soon\",\"sessions\":[]}", "{\"directory\":\"now\",\"sessions\":[1]}",
                            "{\"directory\":\"now\",\"sessions\":[{\"id\":\"00\",\"name\":\"x\",\"seats\":[]}]}"})
    EXPECT_FALSE(parse_service_list(other)) << other;
}

TEST(ServiceList, LeavesSeatsOutBeforeTheFileIsTooLong) {
  constexpr std::size_t kWithSeats = 5000;
  ServiceList list{.known = Known::kNow, .sessions = {}, .answered = {}};
  for (std::size_t i = 0; i < ServiceCatalogue::kSessionsMax; ++i) {
    ServiceList::Session session{
        {session_spec(static_cast<int>(i)).id, std::string(60, 'n'), {}, {}, std::string(60, 's')}, "CODE000001"};
    for (std::size_t k = 0; i < kWithSeats && k < rpc::kListedSeatsMax; ++k)
      session.listed.seats.push_back({"seat-" + std::to_string(k), AccessRole::kTrainee, false, true});
    list.sessions.push_back(std::move(session));
  }
  const std::string text = to_text(list);
  EXPECT_LE(text.size(), kServiceListMax);
  const auto read = parse_service_list(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sessions.size(), list.sessions.size());
  EXPECT_EQ(read->sessions.front(), list.sessions.front());
  EXPECT_TRUE(read->sessions[kWithSeats - 1].listed.seats.empty());
}

}  // namespace
}  // namespace tandem::server
