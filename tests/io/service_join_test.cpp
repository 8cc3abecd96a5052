// Clients of a service: real servers with real keys, whose directory the test sets.
#include <gtest/gtest.h>

#include "client/app/join_client.h"
#include "client/app/run_seat.h"
#include "client/app/server_addresses.h"
#include "common/auth/io/client_keystore.h"
#include "common/auth/io/control_client.h"
#include "common/io/clock.h"
#include "proto/text/service_text.h"
#include "tests/io/member_server.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using server::ControlEvent;
using server::ServerLocation;
using server::SessionLocator;
using server::test::MemberServer;

/// A service with a workstation that is enrolled at its server "a".
class ServiceJoin : public testing::Test {
 protected:
  ServiceJoin() {
    EXPECT_TRUE(auth::ServiceKeystore::init(folder.path("service")));
    EXPECT_TRUE(auth::ServiceKeystore::init(folder.path("other")));
  }
  std::unique_ptr<MemberServer> member(const std::string& name, const char* service = "service",
                                       const std::string& at = tandem::test::free_address()) {
    auto made = std::make_unique<MemberServer>(name, folder.path(service), at);
    made->enrol(own().identity());
    return made;
  }
  auth::ClientKeystore own() {
    return std::move(*auth::ClientKeystore::open_or_make(folder.path("client"), auth::wall_seconds()));
  }
  void know(const MemberServer& server) {
    EXPECT_EQ(own().store_server({server.at(), server.key.sha256, "touch-01"}), "");
  }
  JoinOptions options(const std::vector<const MemberServer*>& servers, Duration timeout = 20s) {
    JoinOptions out{.seat = "trainee", .session = MemberServer::kCode, .state = folder.path("client")};
    std::string text;
    for (const MemberServer* s : servers) text += (text.empty() ? "" : ",") + s->at();
    EXPECT_EQ(set_server_addresses(text, out), "");
    out.caps.joints = out.caps.tip_axes = 3;
    out.caps.simulated = true;
    out.timeout = timeout;
    return out;
  }
  /// State with which a seat that was joined is resumed, and the secret's hash for the next server.
  static ResumeState resume_state(const JoinedSeat& joined) {
    return {.session = joined.welcome.session_id,
            .epoch = joined.welcome.epoch,
            .secrets = {joined.welcome.resume_secret},
            .setup = joined.setup,
            .server = joined.server,
            .service = joined.service};
  }
  server::SeatReservation::Hash secret_of(const JoinedSeat& joined) {
    return server::resume_hash(joined.welcome.resume_secret.bytes, own().identity().fingerprint().sha256);
  }
  std::string reason(const JoinOptions& asking) {
    const auto joined = join_seat(asking);
    return joined ? "joined" : joined.error().reason;
  }
  /// The voucher in a member file.
  static std::vector<std::byte> text_of_member(std::span<const std::byte> file) {
    return parse_member({reinterpret_cast<const char*>(file.data()), file.size()}, "member")->voucher;
  }
  static void point(MemberServer& from, SessionLocator::Found to) {
    from.on_thread([&] { from.directory.found = std::move(to); });
  }
  auth::test::Folder folder;
};

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
