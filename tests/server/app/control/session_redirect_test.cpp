// Requests for sessions of other servers of the service, with a locator that the test sets.
#include "server/app/control/session_redirect.h"

#include <poll.h>

#include <algorithm>

#include "server/app/control/session_joins.h"
#include "tests/server/app/control/registry_fixture.h"

namespace tandem::server {
namespace {

using namespace test;
using rpc::ErrorCode;

/// A directory with the answers that a test sets.
struct SetLocator final : SessionLocator {
  Found locate(const rpc::SessionChoice& choice) override {
    asked.push_back(choice);
    return found;
  }
  std::vector<Elsewhere> elsewhere() const override { return others; }
  std::vector<std::string> members() const override { return addresses; }
  bool fresh() const noexcept override { return is_fresh; }

  Found found = None{};
  std::vector<Elsewhere> others;
  std::vector<std::string> addresses{"lab-a:7000", "lab-b:7000"};
  std::vector<rpc::SessionChoice> asked;
  bool is_fresh = true;
};

ServerLocation location() { return {"lab-b:7000", {std::byte{9}}, {std::byte{1}}, "exam", 77}; }
SessionLocator::Elsewhere other(const std::string& name, unsigned id) {
  return {{id_of(id), name, rpc::SessionPhase::kRunning, {}}, "desk-b"};
}

struct Redirecting : RegistryFixture {
  Redirecting() { redirect.set_locator(&locator, "desk-a"); }
  rpc::ErrorReply error(const rpc::SessionChoice& choice, bool understands = true) {
    const auto reply = redirect.find(choice, understands);
    return reply ? error_of(*reply) : rpc::ErrorReply{};
  }
  SetLocator locator;
  SessionRedirect redirect{registry};
  SessionEntry& lesson = add("lesson", 1, "ABCDE12345");
};

TEST(SessionRedirect, LeavesSessionsOfThisServerAndServersWithoutServiceAlone) {
  Redirecting r;
  r.locator.found = location();
  EXPECT_FALSE(r.redirect.find(id_of(1), true));
  EXPECT_FALSE(r.redirect.find("ABCDE12345", true));
  EXPECT_FALSE(r.redirect.find(std::monostate{}, true));
  EXPECT_TRUE(r.locator.asked.empty());
  SessionRedirect alone{r.registry};
  EXPECT_FALSE(alone.find(id_of(2), true));
  EXPECT_TRUE(alone.members().empty());
  EXPECT_EQ(alone.list({0, true}), r.registry.list());
}

TEST(SessionRedirect, NamesTheServerOfASessionByIdAndByCode) {
  Redirecting r;
  r.locator.found = location();
  const rpc::Elsewhere expected{"lab-b:7000", {std::byte{9}}, {std::byte{1}}, "exam", id_of(2), 77};
  EXPECT_EQ(std::get<rpc::Elsewhere>(*r.redirect.find(id_of(2), true)), expected);
  rpc::Elsewhere by_code = expected;
  by_code.id.reset();
  EXPECT_EQ(std::get<rpc::Elsewhere>(*r.redirect.find("ZZZZZ12345", true)), by_code);
  const rpc::ErrorReply old = r.error(id_of(2), false);
  EXPECT_EQ(old.code, ErrorCode::kNoSession);
  EXPECT_NE(old.text.find("lab-b:7000"), std::string::npos);
}

TEST(SessionRedirect, LetsClientsAskAgainWhileASessionComesOrTheDirectoryIsSilent) {
  Redirecting r;
  for (const SessionLocator::Found& found :
       {SessionLocator::Found{SessionLocator::Coming{}}, SessionLocator::Found{SessionLocator::Here{}}}) {
    r.locator.found = found;
    EXPECT_EQ(r.error(id_of(2)).code, ErrorCode::kNotNow);
    EXPECT_EQ(r.error(id_of(2)).retry_after_s, 1U);
    EXPECT_TRUE(r.redirect.is_coming(id_of(2)));
    EXPECT_FALSE(r.redirect.is_coming(id_of(1))) << "it is served here";
    EXPECT_FALSE(r.redirect.is_coming(rpc::SessionChoice{})) << "none is named";
  }
  r.locator.found = SessionLocator::Unknown{"etcd does not answer"};
  EXPECT_FALSE(r.redirect.is_coming(id_of(2)));
  EXPECT_EQ(r.error(id_of(2)).code, ErrorCode::kInternal);
  EXPECT_NE(r.error(id_of(2)).text.find("etcd does not answer"), std::string::npos);
  r.locator.found = SessionLocator::Unknown{std::string(1000, 'x')};
  EXPECT_EQ(r.error(id_of(2)).text.size(), rpc::kTextMax);
  r.locator.found = SessionLocator::None{};
  EXPECT_FALSE(r.redirect.find(id_of(2), true)) << "this server's own error names the open sessions";
}

TEST(SessionRedirect, FindsTheOnlySessionOfTheServiceAndNamesSeveral) {
  Redirecting r;
  r.locator.found = location();
  r.locator.others = {other("exam", 2)};
  const rpc::ErrorReply several = r.error(std::monostate{});
  EXPECT_EQ(several.code, ErrorCode::kNoSession);
  EXPECT_EQ(several.text, "this service has several sessions: lesson, exam; choose one with --session");
  r.registry.remove(id_of(1), [] {});
  r.wait_until([&] { return r.registry.entries().empty(); });
  EXPECT_TRUE(std::holds_alternative<rpc::Elsewhere>(*r.redirect.find(std::monostate{}, true)));
  EXPECT_EQ(r.locator.asked.back(), (rpc::SessionChoice{id_of(2)}));
}

TEST(SessionRedirect, RefusesUnknownSessionsWithThoseOfTheService) {
  Redirecting r;
  const auto refused = [&](const rpc::SessionChoice& choice) {
    EXPECT_FALSE(r.redirect.find(choice, true));
    return r.redirect.refusal(choice, error_of(r.registry.choose(choice)));
  };
  r.locator.others = {other("exam", 2)};
  EXPECT_EQ(refused(id_of(3)),
            (rpc::ErrorReply{ErrorCode::kNoSession,
                             "this service has no such session; sessions of the service: lesson, exam", 0}));
  r.registry.remove(id_of(1), [] {});
  r.wait_until([&] { return r.registry.entries().empty(); });
  const rpc::ErrorReply code = refused("ZZZZZ12345");
  EXPECT_EQ(code.code, ErrorCode::kCode) << "an attempt at the code, also at a server without sessions";
  EXPECT_NE(code.text.find("sessions of the service: exam"), std::string::npos) << code.text;
  for (unsigned i = 0; i < 100; ++i) r.locator.others.push_back(other(std::string(32, 'n'), 100 + i));
  EXPECT_LE(refused("ZZZZZ12345").text.size(), rpc::kTextMax);
  r.locator.others.clear();
  EXPECT_EQ(refused(id_of(3)), (rpc::ErrorReply{ErrorCode::kNoSession, "no session is open in this service", 0}));
  EXPECT_EQ(refused(std::monostate{}).text, "no session is open in this service");
  r.locator.is_fresh = false;
  EXPECT_EQ(refused(std::monostate{}).code, ErrorCode::kInternal);
  EXPECT_NE(refused(std::monostate{}).text.find("does not reach the directory"), std::string::npos);
  SessionRedirect alone{r.registry};
  const rpc::ErrorReply own{ErrorCode::kNoSession, "no session is open on this server", 0};
  EXPECT_EQ(alone.refusal(std::monostate{}, own), own);
  EXPECT_EQ(r.redirect.refusal(id_of(3), {ErrorCode::kSessionOver, "over", 0}).text, "over");
  EXPECT_NE(r.redirect.draining().text.find("other servers of the service"), std::string::npos);
  EXPECT_NE(alone.draining().text.find("until it has restarted"), std::string::npos);
}

TEST(SessionRedirect, ListsTheWholeServiceInPagesAndSaysWhenItIsOld) {
  Redirecting r;
  for (unsigned i = 0; i < 100; ++i) r.locator.others.push_back(other("s" + std::to_string(199 - i), 100 + i));
  r.locator.others.push_back(other("lesson", 1));  // it has just moved here
  r.locator.is_fresh = false;
  EXPECT_EQ(r.redirect.list({0, false}), r.registry.list()) << "a client of version 2";
  std::vector<std::string> names;
  std::uint32_t after = 0;
  for (int pages = 0; pages < 3; ++pages) {
    const rpc::SessionList page = r.redirect.list({after, true});
    EXPECT_TRUE(page.old);
    EXPECT_EQ(page.more, pages < 2);
    EXPECT_LE(page.sessions.size(), rpc::kListedSessionsMax);
    for (const auto& session : page.sessions) {
      names.push_back(session.name);
      EXPECT_EQ(session.server, session.name == "lesson" ? "desk-a" : "desk-b");
    }
    after = page.last;
  }
  EXPECT_EQ(names.size(), 101U);
  EXPECT_EQ(names.front(), "lesson");
  EXPECT_TRUE(std::is_sorted(names.begin() + 1, names.end()));
  EXPECT_TRUE(r.redirect.list({0xffff'ffffU, true}).sessions.empty());
}

/// A client finds a session by its name in the list.
TEST(SessionRedirect, ListsASessionThatIsHandedOverAtEachMomentOnce) {
  Redirecting r;
  r.serve();
  r.locator.others = {other("lesson", 1)};
  const auto names = [&] {
    std::string all;
    for (const auto& session : r.redirect.list({0, true}).sessions) all += session.name + " ";
    return all;
  };
  EXPECT_EQ(names(), "lesson ");
  r.registry.end(id_of(1), wire::CloseReason::kServerReturns);
  EXPECT_EQ(names(), "lesson ");
  pollfd over{r.lesson.session().over_fd(), POLLIN, 0};
  ASSERT_EQ(poll(&over, 1, 30'000), 1);
  ASSERT_TRUE(r.lesson.session().over());
  EXPECT_EQ(names(), "lesson ") << "it is over here, and not removed yet";
  r.registry.remove(id_of(1), [] {});
  EXPECT_EQ(names(), "lesson ");
}

TEST(SessionRedirect, SendsAtMostSixteenUsableAddresses) {
  Redirecting r;
  r.locator.addresses.assign(20, "lab:1");
  EXPECT_EQ(r.redirect.members().size(), rpc::kMembersMax);
  r.locator.addresses = {"lab a:1", "", "lab-b:7000"};
  EXPECT_EQ(r.redirect.members(), std::vector<std::string>{"lab-b:7000"});
}

TEST(SessionRedirect, AnswersJoinsBeforeTheDrainAndCommandsOfASessionThatMovedAway) {
  Redirecting r;
  auth::ServerKeystore keys = auth::ServerKeystore::ephemeral(auth::wall_seconds());
  SessionCommands commands{r.registry, keys};
  SessionJoins joins{r.registry, commands, keys};
  joins.set_locator(&r.locator, "desk-a");
  r.locator.found = location();
  r.registry.drain().begin();
  JoinRequest request;
  request.hello.session = id_of(2);
  request.hello.seat = "trainee";
  const auto admitted = [&] {
    std::optional<JoinReply> reply;
    joins.admit(request, [&](JoinReply decided) { reply = std::move(decided); });
    return reply.value();
  };
  EXPECT_TRUE(std::holds_alternative<rpc::Elsewhere>(admitted()));
  request.version = 2;
  EXPECT_EQ(error_of(admitted()).code, ErrorCode::kNoSession);

  rpc::Welcome joined;
  joined.session_id = id_of(2);
  const auto command = [&] {
    std::optional<rpc::Body> reply;
    joins.command(joined, {}, rpc::StatusRequest{id_of(2)}, [&](rpc::Body body) { reply = std::move(body); });
    return reply.value();
  };
  EXPECT_TRUE(std::holds_alternative<rpc::Elsewhere>(command()));
  std::optional<rpc::Body> ended;
  joins.command(joined, {}, rpc::EndSession{id_of(3), ""}, [&](rpc::Body body) { ended = std::move(body); });
  EXPECT_EQ(std::get<rpc::Elsewhere>(ended.value()).id, id_of(3));
  joined.version = 2;
  EXPECT_EQ(std::get<rpc::ErrorReply>(command()).code, ErrorCode::kNoSession);
  r.locator.found = SessionLocator::None{};
  EXPECT_EQ(std::get<rpc::ErrorReply>(command()).code, ErrorCode::kSessionOver);
}

/// A resume secret counts at another server of the service: it is bound to the key of the workstation alone.
TEST(SessionRedirect, ServersOfAServiceBindResumeSecretsToTheWorkstationOnly) {
  const Secret<32> secret{};
  const SeatReservation::Hash spki{std::byte{7}};
  EXPECT_EQ(resume_hash(secret.bytes, spki), resume_hash(secret.bytes, spki));
  EXPECT_NE(resume_hash(secret.bytes, spki), resume_hash(secret.bytes, SeatReservation::Hash{}));
}

}  // namespace
}  // namespace tandem::server
