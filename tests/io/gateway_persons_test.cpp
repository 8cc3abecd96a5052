// Persons named in tickets, from `tandem-server ticket --person` to the audit log, notes and pages; consoles that only
// watch; the lesson desk. Real programs on loopback.
#include <gtest/gtest.h>
#include <signal.h>

#include <memory>
#include <vector>

#include "tests/io/multi_client_fixture.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

/// A server with a session "a", and browsers that sign in.
struct Lesson : MultiClientFixture {
  explicit Lesson(const std::string& keys = "reports: \".\" scenes: \".\" ")
      : MultiClientFixture(keys + "session { name: \"a\" scene: \"one_axis\" }") {}

  [[nodiscard]] std::string ticket_for(Words more) const {
    Words words{"ticket", "--session", "a", "--workstation", "desk", "--state", state};
    words.insert(words.end(), more.begin(), more.end());
    Process made = server(std::move(words));
    EXPECT_EQ(made.wait(), 0) << made.err();
    return first_line(made.out());
  }
  [[nodiscard]] static WebPage page(const WebGateway& gateway, const std::string& ticket,
                                    const std::string& name = "") {
    Json body{{"ticket", ticket}};
    if (!name.empty()) body["name"] = name;
    const HttpReply reply = http_post(gateway.at, "/join", "application/json", body.dump(), gateway.at.origin());
    EXPECT_EQ(reply.status, 200U) << reply.body;
    return WebPage(gateway.at, cookie_of(reply));
  }
  [[nodiscard]] WebGateway gateway(Words more = {}) const {
    more.insert(more.end(), {"--sign-in", "--state", own});
    return WebGateway(address, more);
  }
  [[nodiscard]] bool audited(const std::string& text) const {
    return folder.read("state/audit.log").find(text) != std::string::npos;
  }
};

Json said(WebPage& page, Json message) {
  message["id"] = 8;
  page.send(message);
  return page.next("reply");
}
Json notes_where(WebPage& page, std::size_t marks, std::size_t sheets) {
  return page.until([=](const Json& m) {
    return m["type"] == "notes" && m["marks"].size() == marks && m["sheets"].size() == sheets;
  });
}
Json goals(int points, bool closed) {
  return {{"type", "sheet"},
          {"sheet", "GOALS"},
          {"of", "trainer"},
          {"scores", {{"efficiency", points}}},
          {"closed", closed}};
}

TEST(GatewayPersons, HaveTheNameOfTheirTicketNotTheChosenOne) {
  const Lesson lesson;
  const WebGateway gateway = lesson.gateway({"--allow-browser-seats"});
  WebPage ann = Lesson::page(gateway, lesson.ticket_for({"--role", "instructor", "--person", "ann"}), "otto");
  WebPage bob = Lesson::page(gateway, lesson.ticket_for({"--role", "operator"}), "ann");
  const Json ann_hello = ann.next("hello"), bob_hello = bob.next("hello");
  EXPECT_EQ(ann_hello["person"], "ann");
  EXPECT_EQ(ann_hello["proved"], true);
  EXPECT_EQ(bob_hello["proved"], false) << "a name given at sign-in proves nothing";
  const std::string seat = lesson.ticket_for({"--seat", "trainer", "--person", "ted"});
  EXPECT_EQ(said(ann, {{"type", "take"}, {"seat", "trainer"}, {"ticket", seat}})["ok"], true);
  for (WebPage* page : {&ann, &bob})
    EXPECT_FALSE(state_where(*page, [](const Json& s) { return s["seats"][0]["person"] == "ted"; }).is_null());
  EXPECT_EQ(ann.order({{"order", "stop"}, {"why", "fire drill"}})["ok"], true);
  const Json stopped = state_where(bob, [](const Json& s) { return s["stop"].is_object(); });
  EXPECT_EQ(stopped["stop"]["person"], "ann");
  EXPECT_EQ(stopped["stop"]["by"], "desk");
  EXPECT_TRUE(lesson.audited("ann at desk (instructor) stop 1")) << lesson.folder.read("state/audit.log");
  EXPECT_TRUE(lesson.audited(" trainer; by ted\"")) << "the join of the seat";
  EXPECT_TRUE(lesson.audited(" instructor for ann\"")) << "the ticket itself";
  EXPECT_TRUE(said(ann, {{"type", "leave"}})["ok"]);
  EXPECT_FALSE(state_where(bob, [](const Json& s) { return s["seats"][0]["person"].is_null(); }).is_null());
}

TEST(GatewayPersons, WatchWithoutASeatAndGiveNoOrder) {
  const Lesson lesson;
  const WebGateway gateway = lesson.gateway();
  for (const std::string role : {"trainee", "observer"}) {
    WebPage page = Lesson::page(gateway, lesson.ticket_for({"--role", role, "--person", "ted"}));
    const Json hello = page.next("hello");
    EXPECT_EQ(hello["may"], Json::array()) << role;
    EXPECT_EQ(hello["person"], "ted");
    EXPECT_FALSE(state_where(page, [](const Json& s) { return s["age_ms"].is_number(); }).is_null()) << "sees it live";
    for (Json order : {Json{{"order", "stop"}, {"why", ""}}, Json{{"order", "pause"}, {"why", ""}},
                       Json{{"order", "resume"}, {"stop", 1}}, Json{{"order", "drain"}, {"grace_s", 1}},
                       Json{{"order", "authority"}, {"tool", 0}, {"version", 1}, {"alpha", {1}}},
                       Json{{"order", "remove"}, {"seat", "trainer"}, {"why", ""}}}) {
      const Json refused = page.order(order);
      EXPECT_EQ(refused["ok"], false) << role << order;
    }
    EXPECT_EQ(said(page, goals(4, true))["ok"], false);
    EXPECT_EQ(said(page, {{"type", "mark"}, {"t", 1}, {"text", "x"}})["ok"], false);
  }
}

/// Without a service a ticket admits once, so that only a new one helps.
TEST(GatewayPersons, AndTheLogHearThatTheServerIsGoneForGood) {
  Lesson lesson;
  WebGateway own(lesson.address, {"--state", lesson.own, "--ticket", lesson.ticket_for({"--role", "operator"})});
  WebGateway shared = lesson.gateway();
  WebPage page = Lesson::page(shared, lesson.ticket_for({"--role", "operator"}));
  EXPECT_FALSE(page.next("scene").is_null());
  for (const WebGateway* gateway : {&own, &shared}) EXPECT_EQ(http_get(gateway->at, "/healthz").status, 200U);
  lesson.host.signal(SIGKILL);
  EXPECT_EQ(lesson.host.wait(), -SIGKILL);
  const Json gone = page.until([](const Json& m) { return m["type"] == "notice" && m["server"] == "gone"; });
  EXPECT_NE(gone["text"].get<std::string>().find("sign in again with a new ticket"), std::string::npos) << gone;
  const auto ends = [](WebGateway& gateway, const std::string& remedy) {
    EXPECT_TRUE(gateway.process.wait_for("; " + remedy + "\n")) << gateway.process.err();
    EXPECT_NE(gateway.process.err().find("the connection to the server is gone ("), std::string::npos)
        << gateway.process.err();
    const HttpReply health = http_get(gateway.at, "/healthz");
    EXPECT_EQ(health.status, 503U);
    EXPECT_NE(health.body.find("; a new ticket is needed\n"), std::string::npos) << health.body;
  };
  ends(own, "start this program again with a new ticket");
  ends(shared, "persons must sign in again with a new ticket");
}

TEST(GatewayPersons, SeeLiveValuesAfterTheFirstOneLeft) {
  const Lesson lesson;
  const WebGateway gateway = lesson.gateway({"--return-within", "1"});
  auto ann =
      std::make_unique<WebPage>(Lesson::page(gateway, lesson.ticket_for({"--role", "instructor", "--person", "ann"})));
  const auto is_live = [](const Json& s) { return s["age_ms"].is_number(); };
  ASSERT_FALSE(state_where(*ann, is_live).is_null());
  WebPage bob = Lesson::page(gateway, lesson.ticket_for({"--role", "operator", "--person", "bob"}));
  ASSERT_FALSE(state_where(bob, is_live).is_null());
  ann.reset();
  unsigned seen = 0;  // of 4 s; the cookie of ann ends after 1 s
  const Json dead = state_where(bob, [&](const Json& s) { return !is_live(s) || ++seen == 240; });
  EXPECT_TRUE(is_live(dead)) << "values end with the person who joined first";
  // The server has eight places of watching consoles. The ninth person sees live values too.
  std::vector<WebPage> others;
  for (int i = 0; i < 8; ++i) {
    others.push_back(Lesson::page(gateway, lesson.ticket_for({"--role", "operator"})));
    EXPECT_FALSE(state_where(others.back(), is_live).is_null()) << "person " << i + 1 << " after ann had left";
  }
}

TEST(GatewayNotes, SurviveTheGatewayWithTheirVisibility) {
  const Lesson lesson;
  const auto evaluator = [&](const WebGateway& gateway, const std::string& name) {
    return Lesson::page(gateway, lesson.ticket_for({"--role", "evaluator", "--person", name}));
  };
  {
    const WebGateway gateway = lesson.gateway();
    WebPage ann = evaluator(gateway, "ann"), bob = evaluator(gateway, "bob");
    EXPECT_EQ(said(ann, {{"type", "mark"}, {"t", 1.5}, {"text", "slips"}})["ok"], true);
    EXPECT_EQ(said(ann, goals(4, true))["ok"], true);
    EXPECT_EQ(said(bob, goals(2, false))["ok"], true);
    EXPECT_FALSE(notes_where(ann, 1, 1).is_null());
  }
  const WebGateway gateway = lesson.gateway();
  WebPage ann = evaluator(gateway, "ann"), bob = evaluator(gateway, "bob"), eva = evaluator(gateway, "eva");
  const Json mine = notes_where(ann, 1, 1), draft = notes_where(bob, 1, 1), none = notes_where(eva, 1, 0);
  ASSERT_FALSE(mine.is_null() || draft.is_null() || none.is_null());
  EXPECT_EQ(mine["marks"][0]["person"], "ann");
  EXPECT_EQ(mine["marks"][0]["proved"], true);
  EXPECT_EQ(mine["sheets"][0]["yours"], true);
  EXPECT_EQ(draft["sheets"][0]["person"], "bob") << "not ann's: the own sheet is open";
  const Json refused = said(ann, goals(5, true));
  EXPECT_EQ(refused["ok"], false) << "a closed sheet is final, also for another gateway";
  EXPECT_NE(refused["text"].get<std::string>().find("final"), std::string::npos) << refused;
  EXPECT_EQ(said(bob, goals(2, true))["ok"], true);
  EXPECT_FALSE(notes_where(bob, 1, 2).is_null()) << "both are closed now";
  EXPECT_FALSE(notes_where(ann, 1, 2).is_null());
  std::string files;
  for (const auto& entry : std::filesystem::directory_iterator(lesson.folder.file(".")))
    if (entry.path().filename().string().ends_with(".notes.jsonl"))
      files += lesson.folder.read(entry.path().filename().string());
  EXPECT_NE(files.find("\"person\":\"ann\""), std::string::npos) << files;
}

/// @return the notes file of the fixture's state folder
std::filesystem::path notes_file(const MultiClientFixture& fixture) {
  for (const auto& entry : std::filesystem::directory_iterator(fixture.state))
    if (entry.path().filename().string().ends_with(".notes.jsonl")) return entry.path();
  return {};
}

TEST(GatewayNotes, SurviveTheEndOfAServerWithoutReports) {
  Lesson lesson("");
  {
    const WebGateway gateway = lesson.gateway();
    WebPage ann = Lesson::page(gateway, lesson.ticket_for({"--role", "evaluator", "--person", "ann"}));
    EXPECT_EQ(said(ann, {{"type", "mark"}, {"t", 1.5}, {"text", "slips"}})["ok"], true);
    EXPECT_EQ(said(ann, goals(4, true))["ok"], true);
  }
  for (const int signal : {SIGKILL, SIGTERM}) {
    SCOPED_TRACE(signal);
    lesson.host.signal(signal);
    EXPECT_EQ(lesson.host.wait(), signal == SIGKILL ? -SIGKILL : 0) << lesson.host.err();
    lesson.host = serving(lesson.folder.file("s.textproto"));
    lesson.address = address_of(lesson.host);
    ASSERT_NE(lesson.host.err().find("RESTORED from its checkpoint"), std::string::npos) << lesson.host.err();
    const WebGateway gateway = lesson.gateway();
    WebPage ann = Lesson::page(gateway, lesson.ticket_for({"--role", "evaluator", "--person", "ann"}));
    const Json notes = notes_where(ann, 1, 1);
    ASSERT_FALSE(notes.is_null());
    EXPECT_EQ(notes["marks"][0]["text"], "slips");
    EXPECT_EQ(notes["sheets"][0]["closed"], true);
    EXPECT_EQ(said(ann, goals(5, true))["ok"], false) << "a closed sheet is final";
  }
  const std::filesystem::path file = notes_file(lesson);
  ASSERT_FALSE(file.empty()) << "no notes in the state folder";
  EXPECT_EQ(std::filesystem::status(file).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(LessonDesk, OffersScenesAndGivesTicketsToPersonsWithoutASeat) {
  const Lesson lesson;
  const std::string other = lesson.enrolled("desk-2");
  lesson.folder.write("mine.textproto", "version: 1\n");
  const WebGateway gateway = lesson.gateway();
  WebPage desk = Lesson::page(gateway, lesson.ticket_for({"--role", "operator", "--person", "otto"}));
  const Json hello = desk.until([](const Json& m) { return m["type"] == "hello" && !m["scenes"].empty(); });
  ASSERT_FALSE(hello.is_null());
  for (const char* scene : {"contact", "free_motion", "mine"})
    EXPECT_NE(std::ranges::find(hello["scenes"], scene), hello["scenes"].end()) << hello["scenes"];
  EXPECT_EQ(hello["scene_seats"]["free_motion"],
            Json({{{"name", "trainer"}, {"role", "INSTRUCTOR"}}, {{"name", "trainee"}, {"role", "TRAINEE"}}}));
  EXPECT_FALSE(hello["scene_seats"].contains("mine")) << "a file that is no scene has no seats";
  EXPECT_TRUE(hello["workstation"].is_null()) << "only the server knows the name";
  EXPECT_EQ(desk.next("state")["no_recording"],
            "this server has no place for recordings; write a key `record` in its configuration and restart it");
  WebPage ann = Lesson::page(gateway, lesson.ticket_for({"--role", "instructor"}));
  EXPECT_EQ(ann.next("hello")["scenes"], Json::array()) << "for those who may create sessions";
  const auto create = [&desk](const Json& people) {
    desk.send({{"type", "order"},
               {"id", 3},
               {"order", "create"},
               {"scene", "free_motion"},
               {"name", "exam"},
               {"people", people}});
    return desk.next("reply");
  };
  const Json raised = create({{{"name", "max"}, {"workstation", "desk"}, {"role", "OPERATOR"}, {"seat", ""}}});
  EXPECT_EQ(raised["ok"], false);
  EXPECT_NE(raised["text"].get<std::string>().find("no ticket for a console has the role operator"), std::string::npos);
  EXPECT_EQ(create({{{"name", "ted"}, {"workstation", "desk"}, {"role", "TRAINEE"}, {"seat", "trainee"}},
                    {{"name", "eva"}, {"workstation", "desk"}, {"role", "EVALUATOR"}, {"seat", ""}},
                    {{"name", "oda"}, {"workstation", "desk"}, {"role", "OBSERVER"}, {"seat", ""}},
                    {{"name", "rob"}, {"workstation", "desk"}, {"role", "RECORDER"}, {"seat", ""}},
                    {{"name", "zoe"}, {"workstation", "desk-2"}, {"role", "OBSERVER"}, {"seat", ""}}})["ok"],
            true);
  const Json made = desk.next("tickets");
  ASSERT_EQ(made["tickets"].size(), 5U) << made;
  EXPECT_EQ(made["tickets"][4]["here"], false) << "no browser at this gateway can use a ticket for desk-2";
  const std::string expected[][2] = {
      {"ted", "TRAINEE"}, {"eva", "EVALUATOR"}, {"oda", "OBSERVER"}, {"rob", "RECORDER"}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(made["tickets"][i]["person"], expected[i][0]);
    EXPECT_EQ(made["tickets"][i]["role"], expected[i][1]);
    EXPECT_EQ(made["tickets"][i]["workstation"], "desk");
    EXPECT_EQ(made["tickets"][i]["here"], true) << "the gateway has the key of desk";
  }
  EXPECT_EQ(made["server"], lesson.address);
  for (const std::size_t i : {1U, 2U}) {
    WebPage page = Lesson::page(gateway, made["tickets"][i]["ticket"]);
    const Json joined = page.next("hello");
    EXPECT_EQ(joined["person"], expected[i][0]);
    EXPECT_EQ(joined["role"], expected[i][1]);
    EXPECT_EQ(joined["sessions"][0]["name"], "exam");
  }
  Process trainee = client(lesson.address, "trainee",
                           {"--session", "exam", "--state", lesson.own, "--ticket", made["tickets"][0]["ticket"]});
  ASSERT_TRUE(trainee.wait_for("seat trainee at")) << trainee.err();
  Process status({TANDEM_CLIENT, "control", "--server", lesson.address, "--state", lesson.own, "--ticket",
                  made["tickets"][3]["ticket"], "--json", "status"});
  EXPECT_EQ(status.wait(), 0) << status.err();
  EXPECT_NE(status.out().find("\"name\": \"trainee\", \"role\": \"trainee\", \"taken\": true"), std::string::npos);
  EXPECT_NE(status.out().find("\"person\": \"ted\""), std::string::npos) << status.out();
}

}  // namespace
}  // namespace tandem::test
