// Clients of a service: real servers with real keys, whose directory the test sets.
#include <gtest/gtest.h>

#include "client/app/run_seat.h"
#include "common/auth/io/control_client.h"
#include "common/io/clock.h"
#include "tests/io/service_join_fixture.h"

namespace tandem::client {
namespace {

using server::ControlEvent;

TEST_F(ServiceJoin, FollowsToTheOwnerAndRemembersTheService) {
  const auto a = member("desk-a"), b = member("desk-b");
  know(*a);
  b->serve(77);
  point(*a, b->location(77));
  b->on_thread([&] { b->directory.addresses = {b->at(), a->at()}; });
  const auto joined = join_seat(options({a.get()}));
  ASSERT_TRUE(joined) << joined.error().reason;
  EXPECT_EQ(io::to_text(joined->udp), b->at());
  EXPECT_EQ(joined->welcome.epoch, 77U);
  EXPECT_EQ(joined->server, b->key);
  EXPECT_EQ(a->count(ControlEvent::kElsewhere), 1U);
  const auto row = own().servers().value().front();
  ASSERT_TRUE(row.service);
  EXPECT_EQ(row.members, (std::vector<std::string>{b->at(), a->at()}));
  // The list of the service has the name of the other server.
  a->on_thread([&] {
    a->directory.others = {b->listed()};
    a->directory.is_fresh = false;
  });
  const auto list = list_sessions(options({a.get()}));
  ASSERT_TRUE(list) << list.error().reason;
  ASSERT_EQ(list->sessions.size(), 1U);
  EXPECT_EQ(list->sessions[0].server, "desk-b");
  EXPECT_TRUE(list->old);
}

TEST_F(ServiceJoin, RefusesEveryWrongVoucherBeforeItShowsItsTicket) {
  const auto a = member("desk-a"), b = member("desk-b"), c = member("desk-c"), foreign = member("desk-x", "other");
  know(*a);
  b->serve(77);
  foreign->serve(77);
  ASSERT_NE(reason(options({a.get()}, 2s)), "joined");  // pins the service; nothing is served there
  const auto refused = [&](ServerLocation to) {
    point(*a, std::move(to));
    return reason(options({a.get()}, 3s));
  };
  ServerLocation wrong = b->location(77);
  wrong.voucher[wrong.voucher.size() - 1] ^= std::byte{1};
  EXPECT_NE(refused(wrong).find("changed after it was signed"), std::string::npos);
  wrong = b->location(77);
  wrong.voucher = c->voucher();  // replayed
  EXPECT_NE(refused(wrong).find("issued for another key"), std::string::npos);
  EXPECT_NE(refused(foreign->location(77)).find("another service"), std::string::npos);
  // The voucher is right, but another server answers at that address.
  wrong = b->location(77);
  wrong.address = c->at();
  EXPECT_NE(refused(wrong).find("another key than the one that its service vouches for"), std::string::npos);
  const auto expired = auth::ServiceKeystore::open(folder.path("service"))
                           ->vouch({"desk-b", b->key, auth::wall_seconds() - 86400, auth::wall_seconds() - 3600});
  const auto text = text_of_member(expired->bytes());
  wrong = b->location(77);
  wrong.voucher = text;
  EXPECT_NE(refused(wrong).find("expired"), std::string::npos);
  EXPECT_EQ(b->count(ControlEvent::kWelcomed) + foreign->count(ControlEvent::kWelcomed), 0U);
  EXPECT_EQ(refused(b->location(77)), "joined");
}

TEST_F(ServiceJoin, EndsAfterFourHopsAndObeysNoOlderOwner) {
  const auto a = member("desk-a"), b = member("desk-b");
  know(*a);
  point(*a, b->location(5));
  point(*b, a->location(5));
  EXPECT_NE(reason(options({a.get()}, 10s)).find("the 5th server"), std::string::npos);
  EXPECT_EQ(a->count(ControlEvent::kElsewhere) + b->count(ControlEvent::kElsewhere), 5U);
  point(*b, a->location(4));
  EXPECT_NE(reason(options({a.get()}, 10s)).find("that server had it earlier"), std::string::npos);
}

TEST_F(ServiceJoin, TriesAllAddressesAndNamesEachFailure) {
  const auto a = member("desk-a"), b = member("desk-b"), foreign = member("desk-x", "other");
  know(*a);
  b->serve(77);
  ASSERT_NE(reason(options({a.get()}, 2s)), "joined");  // pins the service
  JoinOptions asking = options({foreign.get(), b.get()});
  EXPECT_EQ(reason(asking), "joined") << "the first one is of another service";
  // An address where nothing listens, and one of another service.
  asking = options({foreign.get()}, 2s);
  asking.alternatives.push_back(*io::parse_address("127.0.0.1:1", 1));
  asking.unresolved = "\"lab:1\": no address";
  const std::string why = reason(asking);
  EXPECT_NE(why.find(foreign->at() + ": "), std::string::npos) << why;
  EXPECT_NE(why.find("another service"), std::string::npos) << why;
  EXPECT_NE(why.find("127.0.0.1:1: 127.0.0.1:1 cannot be reached"), std::string::npos) << why;
  EXPECT_NE(why.find("\"lab:1\": no address"), std::string::npos) << why;
}

TEST_F(ServiceJoin, FindsTheServiceByAMemberThatItLearntWhenTheEnrolledServerIsGone) {
  auto a = member("desk-a");
  const auto b = member("desk-b");
  know(*a);
  a->serve(3);
  a->on_thread([&] { a->directory.addresses = {a->at(), b->at()}; });
  const JoinOptions asking = options({a.get()});
  ASSERT_EQ(reason(asking), "joined");
  a.reset();
  b->serve(4);
  EXPECT_EQ(reason(asking), "joined");
}

TEST_F(ServiceJoin, ADrainGoesToNoServerThatTheUserHasNotNamed) {
  auto a = member("desk-a");
  const auto b = member("desk-b");
  know(*a);
  b->serve(77);
  point(*a, b->location(77));
  b->on_thread([&] { b->directory.addresses = {b->at(), a->at()}; });
  a->on_thread([&] { a->directory.others = {b->listed()}; });
  const auto why = [&](const std::vector<const MemberServer*>& servers) {
    JoinOptions asking = options(servers, 2s);
    asking.seat.clear();
    asking.console = AccessRole::kOperator;
    asking.drains = true;
    const auto joined = join_console(asking);
    return joined ? "joined" : joined.error().reason;
  };
  EXPECT_NE(why({a.get()}).find("--server names " + a->at() + ", but session lesson is served by server desk-b at " +
                                b->at() + ", and a drain ends"),
            std::string::npos)
      << why({a.get()});
  EXPECT_NE(why({a.get(), b.get()}).find("--server names several servers"), std::string::npos);
  const JoinOptions asking = options({a.get()});
  ASSERT_EQ(reason(asking), "joined");  // a seat, which learns the address of the other server
  const std::string gone = a->at();
  a.reset();
  JoinOptions drain = asking;
  drain.drains = true;
  drain.timeout = 500ms;
  EXPECT_NE(reason(drain).find("no server at " + gone), std::string::npos) << reason(drain);
  EXPECT_EQ(b->count(ControlEvent::kWelcomed), 1U) << "the drain came to a server that was not named";
}

TEST_F(ServiceJoin, WorksOverIpv6) {
  const auto a = member("desk-a", "service", "[::1]:0"), b = member("desk-b", "service", "[::1]:0");
  know(*a);
  b->serve(77);
  point(*a, b->location(77));
  const auto joined = join_seat(options({a.get()}));
  ASSERT_TRUE(joined) << joined.error().reason;
  EXPECT_EQ(io::to_text(joined->udp), b->at());
  EXPECT_TRUE(b->at().starts_with("[::1]:"));
}

TEST_F(ServiceJoin, WaitsForASessionThatIsAboutToBeServed) {
  const auto a = member("desk-a");
  know(*a);
  point(*a, SessionLocator::Coming{});
  EXPECT_NE(reason(options({a.get()}, 1s)).find("about to serve"), std::string::npos);
  std::thread later([&] {
    std::this_thread::sleep_for(600ms);
    a->serve(9);
  });
  EXPECT_EQ(reason(options({a.get()})), "joined");
  later.join();
}

/// A class behind one address: its clients may open 100 connections at once, then 10 a second.
TEST_F(ServiceJoin, ThirtyClientsOfOneAddressWaitForTheirSessionWithinItsLimitOfConnections) {
  auto gone = member("desk-b");
  const ServerLocation owner = gone->location(5);
  gone.reset();
  for (const SessionLocator::Found& found : {SessionLocator::Found{SessionLocator::Coming{}}, {owner}}) {
    SCOPED_TRACE(found.index());
    MemberServer a("desk-a", folder.path("service"), tandem::test::free_address(), auth::AcceptLimits{});
    a.enrol(own().identity());
    know(a);
    point(a, found);
    const JoinOptions asking = options({&a}, 3s);
    std::vector<std::thread> clients;
    for (int i = 0; i < 30; ++i)
      clients.emplace_back([&] {
        const std::string why = reason(asking);
        EXPECT_TRUE(why.find("about to serve") != why.npos || why.find(owner.address) != why.npos) << why;
      });
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(a.count(ControlEvent::kTooFast), 0U);
    // Each asks again over its connection. The server closes some of these, because all have the same key.
    EXPECT_LE(a.count(ControlEvent::kAccepted), 60U);
  }
}

TEST_F(ServiceJoin, ResumesAtTheNewOwnerInOneAttemptOnceItServes) {
  auto a = member("desk-a");
  const auto b = member("desk-b"), c = member("desk-c");
  know(*a);
  a->serve(5);
  a->on_thread([&] { a->directory.addresses = {a->at(), b->at(), c->at()}; });
  const JoinOptions asking = options({a.get()}, 3s);
  const auto joined = join_seat(asking);
  ASSERT_TRUE(joined) << joined.error().reason;
  ASSERT_TRUE(joined->service);
  ResumeState own_state{.session = joined->welcome.session_id,
                        .epoch = joined->welcome.epoch,
                        .secrets = {joined->welcome.resume_secret},
                        .setup = joined->setup,
                        .server = joined->server,
                        .service = joined->service,
                        .members = joined->welcome.members,
                        .last = joined->udp};
  a.reset();
  const auto resume = [&] { return resume_seat(asking, own_state, [] { return true; }); };
  point(*b, SessionLocator::Unknown{"the directory does not answer"});
  point(*c, SessionLocator::Coming{});
  const auto early = resume();
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().kind, ResumeError::Kind::kAgain);
  EXPECT_TRUE(early.error().coming);
  EXPECT_EQ(io::to_text(early.error().answered.value()), c->at());
  EXPECT_NE(early.error().reason.find("the directory does not answer"), std::string::npos);
  // An old copy of the directory: it names a revision below the one that the seat had.
  c->serve(9, server::resume_hash(joined->welcome.resume_secret.bytes, own().identity().fingerprint().sha256));
  point(*b, c->location(4));
  own_state.members = {b->at()};
  const auto outdated = resume();
  ASSERT_FALSE(outdated);
  EXPECT_EQ(outdated.error().kind, ResumeError::Kind::kAgain);
  point(*b, c->location(9));
  const auto back = resume();
  ASSERT_TRUE(back) << back.error().reason;
  EXPECT_EQ(io::to_text(back->udp), c->at());
  EXPECT_EQ(back->welcome.epoch, 9U);
}

/// A whole client keeps its seat when its server dies, and another one serves the session 3.3 s later, as with a lease
/// of 3 s. Its datagrams go to the new server.
TEST_F(ServiceJoin, BringsTheSeatOfARunningClientToTheNewOwner) {
  auto a = member("desk-a");
  const auto b = member("desk-b"), c = member("desk-c");
  know(*a);
  a->serve(5);
  a->on_thread([&] { a->directory.addresses = {a->at(), b->at(), c->at()}; });
  for (MemberServer* other : {b.get(), c.get()}) point(*other, SessionLocator::Coming{});
  SeatOptions plan;
  plan.join = options({a.get()}, 5s);
  plan.device = "sim";
  plan.duration_s = 10;
  plan.quiet = true;
  std::thread person([&] { static_cast<void>(run_seat(plan)); });
  const server::SeatReservation::Hash secret = a->resume_hash_of_trainee();
  while (!a->hears_trainee()) std::this_thread::sleep_for(20ms);
  a->silence();
  a.reset();
  const Time died = io::monotonic_now();
  std::this_thread::sleep_for(3300ms);
  c->serve(9, secret);
  point(*b, c->location(9));
  const Time served = io::monotonic_now();
  while (!c->hears_trainee() && io::monotonic_now() - served < 12s) std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(c->hears_trainee());
  EXPECT_EQ(c->count(ControlEvent::kWelcomed), 1U);
  std::printf("[ measured ] seat back %.2f s after its server died, %.2f s after another one serves the session\n",
              seconds(io::monotonic_now() - died), seconds(io::monotonic_now() - served));
  person.join();
}

TEST_F(ServiceJoin, ResumesNowhereElseWithoutService) {
  auto a = member("desk-a");
  const auto foreign = member("desk-x", "other");
  know(*a);
  know(*foreign);  // an enrolment there is no right to a seat of this service
  a->serve(5);
  const JoinOptions asking = options({a.get(), foreign.get()}, 3s);
  const auto joined = join_seat(asking);
  ASSERT_TRUE(joined) << joined.error().reason;
  a.reset();
  foreign->serve(9, secret_of(*joined));
  const auto back = resume_seat(asking, resume_state(*joined), [] { return true; });
  ASSERT_FALSE(back);
  EXPECT_EQ(foreign->count(ControlEvent::kWelcomed), 0U);
  EXPECT_NE(back.error().distrust.find("another service"), std::string::npos) << back.error().distrust;
}

TEST_F(ServiceJoin, ResumesAtAServerOfTheNewestKeyAfterSeveralRotationsWithoutGrace) {
  auto a = member("desk-a");
  know(*a);
  a->serve(5);
  const auto joined = join_seat(options({a.get()}));
  ASSERT_TRUE(joined) << joined.error().reason;
  a.reset();
  const auto old = member("desk-b");  // keeps the voucher of the first key
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(auth::ServiceKeystore::rotate(folder.path("service"), auth::wall_seconds(), 0, false));
    const auto server = member("desk-" + std::to_string(i));
    server->serve(9, secret_of(*joined));
    const JoinOptions asking = options({server.get()}, 3s);
    const auto back = resume_seat(asking, resume_state(*joined), [] { return true; });
    ASSERT_TRUE(back) << i << ": " << back.error().reason;
    EXPECT_EQ(back->server, server->key);
  }
  // A key that the service has withdrawn proves nothing: neither to a hand that knows the newer key, nor to the next.
  old->serve(10, secret_of(*joined));
  auto refused = resume_seat(options({old.get()}, 3s), resume_state(*joined), [] { return true; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(old->count(ControlEvent::kWelcomed), 0U);
  for (const char* words : {"another service", "rotated its key", "service vouch", "enrol there"})
    EXPECT_NE(refused.error().distrust.find(words), std::string::npos) << refused.error().distrust;
}

/// A client of version 2 reads neither Elsewhere nor the members.
TEST_F(ServiceJoin, GivesAClientOfVersion2NothingThatItCannotRead) {
  const auto a = member("desk-a"), b = member("desk-b");
  point(*a, b->location(77));
  b->serve(77);
  b->on_thread([&] { b->directory.addresses = {b->at()}; });
  const auto keys = own();
  const auto ask = [&](const MemberServer& server, std::vector<std::uint32_t> versions) {
    auto client = auth::ControlClient::connect(
        server.address,
        [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> {
          return &keys.identity();
        },
        20s, -1);
    EXPECT_TRUE(client) << client.error().text;
    rpc::Hello hello;
    hello.versions = std::move(versions);
    hello.session = std::string(MemberServer::kCode);
    hello.credential = rpc::CodeCredential{MemberServer::kCode};
    hello.seat = "trainee";
    hello.device = {3, 3, true, false, 0, 0, 0};
    return client->ask(hello, 20s).value();
  };
  const rpc::Body old = ask(*a, {2});
  ASSERT_TRUE(std::holds_alternative<rpc::ErrorReply>(old));
  EXPECT_NE(std::get<rpc::ErrorReply>(old).text.find(b->at()), std::string::npos);
  const rpc::Body welcome = ask(*b, {2});
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(welcome));
  EXPECT_EQ(std::get<rpc::Welcome>(welcome).version, 2U);
  EXPECT_TRUE(std::get<rpc::Welcome>(welcome).members.empty());
  EXPECT_TRUE(std::holds_alternative<rpc::Elsewhere>(ask(*a, {2, 3, 4})));
  EXPECT_TRUE(std::holds_alternative<rpc::ErrorReply>(ask(*a, {4})));
}

}  // namespace
}  // namespace tandem::client
