// Access to tandem-console: tokens, cookies, origins, tickets, TLS. Real programs on loopback.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/common/auth/io/from_address.h"
#include "tests/io/multi_client_fixture.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

TEST(GatewayAccess, IsByAOneTimeTokenThenACookie) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  ASSERT_NE(gateway.at.port, 0) << gateway.process.err();
  EXPECT_EQ(http_get(gateway.at, "/healthz").status, 200U);
  const HttpReply none = http_get(gateway.at, "/");
  EXPECT_EQ(none.status, 200U) << "the page has no secret; it asks for a ticket";
  EXPECT_EQ(cookie_of(none), "");
  for (const std::string& wrong : {std::string("00"), gateway.token.substr(1), gateway.token + "0"})
    EXPECT_EQ(http_get(gateway.at, "/?token=" + wrong).status, 403U);
  const HttpReply first = http_get(gateway.at, "/?token=" + gateway.token);
  EXPECT_EQ(first.status, 303U);
  EXPECT_EQ(first.fields.at("location"), "/") << "no secret in the URL after the first load";
  for (const char* part : {"HttpOnly", "SameSite=Strict"})
    EXPECT_NE(first.fields.at("set-cookie").find(part), std::string::npos) << part;
  EXPECT_EQ(http_get(gateway.at, "/?token=" + gateway.token).status, 403U) << "second use";
  const std::string cookie = cookie_of(first);
  const HttpReply page = http_get(gateway.at, "/", {{"Cookie", cookie}});
  EXPECT_EQ(page.status, 200U);
  EXPECT_TRUE(page.fields.at("content-security-policy").starts_with("default-src 'none'; script-src 'self';"));
  EXPECT_EQ(http_get(gateway.at, "/", {{"Cookie", "tandem=" + std::string(64, '0')}}).status, 200U);
  EXPECT_EQ(http_get(gateway.at, "/../../etc/passwd", {{"Cookie", cookie}}).status, 404U);
}

TEST(GatewayAccess, GivesBrowsersItsIcon) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  for (const char* path : {"/favicon.ico", "/assets/icon.svg"}) {
    const HttpReply icon = http_get(gateway.at, path);
    EXPECT_EQ(icon.status, 200U) << path;
    EXPECT_EQ(icon.fields.at("content-type"), "image/svg+xml") << path;
  }
  EXPECT_NE(http_get(gateway.at, "/join").body.find("href=\"/assets/icon.svg\""), std::string::npos);
}

TEST(GatewayAccess, RefusesForeignHostsAndOrigins) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  for (const char* name : {"evil.example", "127.0.0.1.evil.example", ""}) {
    WebAddress foreign = gateway.at;
    foreign.host = name;
    EXPECT_EQ(http_get(foreign, "/", {{"Cookie", gateway.cookie}}).status, 421U) << name << ": DNS rebinding";
  }
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1"})
    EXPECT_EQ(WebPage(gateway.at, gateway.cookie, origin).status(), 403U) << origin;
  WebPage none(gateway.at, "");
  EXPECT_EQ(none.status(), 101U);
  EXPECT_TRUE(none.read().is_null()) << "nothing without a cookie";
  EXPECT_EQ(none.close_code(), 4401U);
  EXPECT_NE(none.close_reason().find("/join"), std::string::npos);
  EXPECT_EQ(gateway.page().status(), 101U);
}

// All of 127.0.0.0/8 is this computer, so that 127.0.0.2 acts as another one.
TEST(GatewayAccess, IsPossibleBesideAComputerWithManyConnections) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host), {"--audience", "20"});
  gateway.open_url();
  const auto at = *io::parse_address("127.0.0.1:" + std::to_string(gateway.at.port), 1);
  const std::string request = "GET / HTTP/1.1\r\nHost: " + gateway.at.host_header() + "\r\n\r\n";
  for (const std::string& sent : {std::string(), request.substr(0, 20), request}) {
    std::vector<io::Fd> others;
    for (int n = 0; n < 400; ++n) {
      others.push_back(server::test::silent_from("127.0.0.2", at));
      static_cast<void>(::send(others.back().get(), sent.data(), sent.size(), MSG_NOSIGNAL));
    }
    for (int n = 0; n < 10; ++n) EXPECT_EQ(http_get(gateway.at, "/").status, 200U) << n << " beside " << sent;
    EXPECT_EQ(gateway.page().status(), 101U);
  }
}

TEST(GatewayAccess, IsPossibleBesideManyWebSocketsWithoutACookie) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  std::vector<WebPage> others;
  for (int n = 0; n < 80; ++n) others.emplace_back(gateway.at, "");
  EXPECT_EQ(others.back().status(), 503U);
  EXPECT_EQ(gateway.page().status(), 101U);
}

std::string console_ticket(const MultiClientFixture& fixture, const std::string& role, Words more = {}) {
  Words words{"ticket", "--session", "a", "--role", role, "--workstation", "desk", "--state", fixture.state};
  words.insert(words.end(), more.begin(), more.end());
  Process made = server(std::move(words));
  EXPECT_EQ(made.wait(), 0) << made.err();
  return first_line(made.out());
}

constexpr const char *kForm = "application/x-www-form-urlencoded", *kJson = "application/json";

std::string json_body(const std::string& ticket, const std::string& name = "") {
  Json body{{"ticket", ticket}};
  if (!name.empty()) body["name"] = name;
  return body.dump();
}

TEST(GatewayAccess, GivesEachPersonTheRightsOfTheirTicket) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway(fixture.address, {"--sign-in", "--state", fixture.own});
  EXPECT_EQ(gateway.token, "") << "only persons with tickets have access";
  const std::string instructor = console_ticket(fixture, "instructor"), desk = console_ticket(fixture, "operator");
  const HttpReply ann = http_post(gateway.at, "/join", kJson, json_body(instructor, "ann"), gateway.at.origin());
  ASSERT_EQ(ann.status, 200U) << ann.body << gateway.process.err();
  EXPECT_EQ(Json::parse(ann.body), Json({{"ok", true}, {"text", ""}}));
  const HttpReply bob = http_post(gateway.at, "/join", kForm, "ticket=" + desk + "&name=ann", gateway.at.origin());
  ASSERT_EQ(bob.status, 303U) << bob.body;
  EXPECT_EQ(bob.fields.at("location"), "/");

  WebPage ann_page(gateway.at, cookie_of(ann)), bob_page(gateway.at, cookie_of(bob));
  const Json ann_hello = ann_page.next("hello"), bob_hello = bob_page.next("hello");
  EXPECT_EQ(ann_hello["role"], "INSTRUCTOR");
  EXPECT_EQ(ann_hello["person"], "ann");
  EXPECT_EQ(bob_hello["role"], "OPERATOR");
  EXPECT_NE(bob_hello["person"], "ann") << "two persons are never taken for one";
  ASSERT_EQ(bob_hello["sessions"].size(), 1U);
  for (WebPage* page : {&ann_page, &bob_page})
    EXPECT_FALSE(state_where(*page, [](const Json& state) { return state["age_ms"].is_number(); }).is_null());
  const Json drain = ann_page.order({{"order", "drain"}, {"grace_s", 1}});
  EXPECT_EQ(drain["ok"], false);
  const Json shift = bob_page.order({{"order", "authority"}, {"tool", 0}, {"version", 1}, {"alpha", {1}}});
  EXPECT_EQ(shift["ok"], false);
  EXPECT_NE(shift["text"].get<std::string>().find("operator may not move authority"), std::string::npos) << shift;
  EXPECT_EQ(bob_page.order({{"order", "stop"}, {"why", "fire drill"}})["ok"], true);
  const Json stopped = state_where(ann_page, [](const Json& state) { return state["stop"].is_object(); });
  EXPECT_EQ(stopped["stop"]["why"], "fire drill");
  EXPECT_EQ(stopped["stop"]["by"], "desk");
  const Json yours = state_where(ann_page, [](const Json& state) { return state["stop"]["yours"] == true; });
  EXPECT_EQ(ann_page.order({{"order", "resume"}, {"stop", yours["stop"]["number"]}})["ok"], true);
  EXPECT_FALSE(state_where(bob_page, [](const Json& state) { return state["stop"].is_object(); }).is_null());
  EXPECT_FALSE(state_where(bob_page, [](const Json& state) { return state["stop"].is_null(); }).is_null());
  const auto audited = [&fixture](const std::string& text) {
    return fixture.folder.read("state/audit.log").find(text) != std::string::npos;
  };
  EXPECT_TRUE(audited("fire drill")) << fixture.folder.read("state/audit.log");

  const HttpReply again = http_post(gateway.at, "/join", kJson, json_body(desk), gateway.at.origin());
  EXPECT_EQ(again.status, 403U) << "a ticket is valid once";
  EXPECT_EQ(cookie_of(again), "");
  const std::string all = gateway.process.out() + gateway.process.err();
  for (const std::string& ticket : {instructor, desk})
    EXPECT_EQ(all.find(ticket), std::string::npos) << "a ticket in a log";
}

TEST(BrowserSeats, NeedATicketOfPersonsWhoSignedInByTicket) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway(fixture.address, {"--sign-in", "--allow-browser-seats", "--state", fixture.own});
  const HttpReply ann = http_post(gateway.at, "/join", kJson, json_body(console_ticket(fixture, "instructor"), "ann"),
                                  gateway.at.origin());
  ASSERT_EQ(ann.status, 200U) << ann.body;
  WebPage page(gateway.at, cookie_of(ann));
  const auto said = [&page](Json message) {
    message["id"] = 9;
    page.send(message);
    return page.next("reply");
  };
  EXPECT_NE(said({{"type", "invite"}})["text"].get<std::string>().find("ticket"), std::string::npos);
  const Json refused = said({{"type", "take"}, {"seat", "trainer"}});
  EXPECT_EQ(refused["ok"], false);
  EXPECT_NE(refused["text"].get<std::string>().find("a ticket for this seat is needed"), std::string::npos);
  EXPECT_EQ(said({{"type", "take"}, {"seat", "trainer"}, {"ticket", fixture.ticket("a", "trainer")}})["ok"], true);
  EXPECT_FALSE(state_where(page, [](const Json& state) { return state["seats"][0]["engaged"] == true; }).is_null());
}

TEST(GatewayNotes, OfTwoEvaluatorsAreStoredAndHiddenUntilBothClosed) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway(fixture.address, {"--sign-in", "--state", fixture.own});
  const auto signed_in = [&](const std::string& role, const std::string& name) {
    const HttpReply reply =
        http_post(gateway.at, "/join", kJson, json_body(console_ticket(fixture, role), name), gateway.at.origin());
    EXPECT_EQ(reply.status, 200U) << reply.body;
    return WebPage(gateway.at, cookie_of(reply));
  };
  WebPage ann = signed_in("evaluator", "ann"), bob = signed_in("evaluator", "bob"), log = signed_in("recorder", "log");
  const Json hello = ann.next("hello");
  EXPECT_EQ(hello["role"], "EVALUATOR");
  EXPECT_NE(hello["may"].dump().find("score"), std::string::npos);
  const auto said = [](WebPage& page, Json message) {
    message["id"] = 8;
    page.send(message);
    return page.next("reply");
  };
  const Json moves{{"type", "order"}, {"order", "authority"}, {"tool", 0}, {"version", 1}, {"alpha", {1}}};
  EXPECT_EQ(said(ann, moves)["ok"], false) << "an evaluator moves no authority";
  EXPECT_EQ(said(ann, {{"type", "mark"}, {"t", 1.5}, {"text", "slips"}})["ok"], true);
  const Json notes = bob.next("notes");
  EXPECT_EQ(notes["marks"][0]["text"], "slips");
  EXPECT_EQ(notes["marks"][0]["person"], "ann");
  Json sheet{
      {"type", "sheet"}, {"sheet", "GOALS"}, {"of", "trainer"}, {"scores", {{"efficiency", 4}}}, {"closed", true}};
  EXPECT_EQ(said(ann, sheet)["ok"], true);
  EXPECT_TRUE(bob.next("notes")["sheets"].empty());
  EXPECT_EQ(said(ann, sheet)["ok"], false) << "closed";
  sheet["scores"]["efficiency"] = 2;
  EXPECT_EQ(said(bob, sheet)["ok"], true);
  const Json both = bob.until([](const Json& m) { return m["type"] == "notes" && m["sheets"].size() == 2; });
  ASSERT_FALSE(both.is_null());
  EXPECT_EQ(said(log, {{"type", "mark"}, {"t", 1.5}, {"text", "x"}})["ok"], false);
  EXPECT_EQ(said(log, sheet)["ok"], false);
  const std::string audit = fixture.folder.read("state/audit.log");
  EXPECT_NE(audit.find("evaluator"), std::string::npos) << audit;
}

TEST(GatewayAccess, RefusesSigningInWithWords) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway(fixture.address, {"--sign-in", "--state", fixture.own});
  const std::string origin = gateway.at.origin(), good = console_ticket(fixture, "operator");
  EXPECT_EQ(http_post(gateway.at, "/join", kJson, json_body(good), {}).status, 403U) << "without an Origin";
  EXPECT_EQ(http_post(gateway.at, "/join", kJson, json_body(good), "http://evil.example").status, 403U);
  EXPECT_EQ(http_post(gateway.at, "/join", "text/plain", json_body(good), origin).status, 400U);
  EXPECT_EQ(http_post(gateway.at, "/join", kJson, std::string(5000, ' '), origin).status, 413U);
  EXPECT_EQ(http_post(gateway.at, "/live", kJson, json_body(good), origin).status, 404U);
  const HttpReply form = http_get(gateway.at, "/join");
  EXPECT_EQ(form.status, 200U);
  EXPECT_NE(form.body.find("<form method=\"post\" action=\"/join\""), std::string::npos);
  EXPECT_EQ(form.body.find("<script"), std::string::npos);

  // The server judges these: a seat's ticket does not serve at a console.
  const HttpReply seated = http_post(gateway.at, "/join", kJson, json_body(fixture.ticket("a", "trainer")), origin);
  EXPECT_EQ(seated.status, 403U);
  EXPECT_NE(seated.body.find("seat"), std::string::npos) << seated.body;
  std::string bent = good;
  bent[20] = bent[20] == 'A' ? 'B' : 'A';
  EXPECT_NE(http_post(gateway.at, "/join", kJson, json_body(bent), origin).status, 200U);
  const HttpReply markup = http_post(gateway.at, "/join", kForm, "ticket=%3Cscript%3E", origin);
  EXPECT_EQ(markup.body.find("<script"), std::string::npos) << markup.body;
  EXPECT_EQ(markup.status, 400U) << "no ticket";
  EXPECT_EQ(http_post(gateway.at, "/join", kJson, json_body(good), origin).status, 200U) << "still valid";

  unsigned refused = 0;
  for (int n = 0; n < 30; ++n)
    refused += http_post(gateway.at, "/join", kJson, json_body("ticket:AAAA"), origin).status == 429U ? 1 : 0;
  EXPECT_GT(refused, 0U) << "the rate of joins is limited";
}

TEST(GatewayAccess, NeedsTlsBeyondLoopback) {
  const Process host = hosting("one_axis");
  const Folder folder;
  const std::string certificate = folder.file("page.pem"), key = folder.file("page.key");
  write_certificate("lab.example", certificate, key);
  Process open({TANDEM_CONSOLE, "--server", address_of(host), "--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.wait(), 2);
  EXPECT_NE(open.err().find("needs TLS; give --certificate FILE and --key FILE"), std::string::npos) << open.err();
  Process half({TANDEM_CONSOLE, "--server", address_of(host), "--certificate", certificate});
  EXPECT_EQ(half.wait(), 2);
  EXPECT_NE(half.err().find("--key belong together"), std::string::npos) << half.err();
  Process swapped({TANDEM_CONSOLE, "--server", address_of(host), "--certificate", key, "--key", certificate});
  EXPECT_EQ(swapped.wait(), 2);
  EXPECT_NE(swapped.err().find("--certificate: " + key), std::string::npos) << swapped.err();

  WebGateway gateway(address_of(host), {"--listen", "0.0.0.0:0", "--certificate", certificate, "--key", key}, true);
  ASSERT_EQ(gateway.at.host, "lab.example") << gateway.process.out() << gateway.process.err();
  const HttpReply first = http_get(gateway.at, "/?token=" + gateway.token);
  EXPECT_EQ(first.status, 303U);
  EXPECT_NE(first.fields.at("set-cookie").find("; Secure"), std::string::npos);
  const std::string cookie = cookie_of(first);
  EXPECT_EQ(http_get(gateway.at, "/", {{"Cookie", cookie}}).status, 200U);
  WebAddress foreign = gateway.at, plain = gateway.at;
  foreign.host = "other.example";
  EXPECT_EQ(http_get(foreign, "/", {{"Cookie", cookie}}).status, 421U) << "the certificate does not cover it";
  plain.tls = false;
  EXPECT_EQ(http_get(plain, "/", {{"Cookie", cookie}}).status, 0U) << "no reply without TLS";
  EXPECT_EQ(WebPage(gateway.at, cookie, "http://" + gateway.at.host_header()).status(), 403U) << "http, not https";
  WebPage page(gateway.at, cookie);
  EXPECT_EQ(page.status(), 101U);
  EXPECT_FALSE(page.next("state").is_null());
}

TEST(GatewayAccess, EndsByCtrlCAndNamesMistakes) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage page = gateway.page();
  EXPECT_FALSE(page.next("state").is_null());
  Process second(
      {TANDEM_CONSOLE, "--server", address_of(host), "--listen", "127.0.0.1:" + std::to_string(gateway.at.port)});
  EXPECT_EQ(second.wait(), 1);
  EXPECT_NE(second.err().find("choose another port"), std::string::npos) << second.err();
  gateway.process.signal(SIGINT);
  EXPECT_EQ(gateway.process.wait(), 0) << gateway.process.err();
  EXPECT_TRUE(page.until([](const Json&) { return false; }).is_null()) << "closed";
  Process wrong({TANDEM_CONSOLE, "--listen", "here", "--role", "trainee"});
  EXPECT_EQ(wrong.wait(), 2) << wrong.err();
  Process none({TANDEM_CONSOLE, "--server", "127.0.0.1:9", "--timeout", "0.3"});
  EXPECT_EQ(none.wait(), 1);
  EXPECT_NE(none.err().find("no server at 127.0.0.1:9"), std::string::npos) << none.err();
}

}  // namespace
}  // namespace tandem::test
