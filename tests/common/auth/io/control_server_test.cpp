#include <gtest/gtest.h>

#include "common/auth/base32.h"
#include "common/base/raw_bytes.h"
#include "tests/common/auth/edited_ticket.h"
#include "tests/common/auth/io/control_server_fixture.h"

/// Control server: enrolment, joins and rejections.
namespace tandem::server::test {
namespace {

using rpc::ErrorCode;

TEST(ControlPlane, EnrolsAWorkstationByCodeAndRecognisesItAfterwards) {
  ControlServerFixture door;
  const auto code = auth::test::secret_from<16>(1);
  ASSERT_EQ(door.beside().registry().issue_code(code, "touch-07", kNow, kNow + 10), "");
  const auto me = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  EXPECT_EQ(client->server(), door.server_fingerprint);
  const auto answer = client->ask(rpc::Enroll{code}, kTimeout);
  ASSERT_TRUE(answer) << answer.error().text;
  const auto* ack = std::get_if<rpc::EnrollAck>(&*answer);
  ASSERT_NE(ack, nullptr);
  EXPECT_EQ(ack->workstation, "touch-07");
  EXPECT_EQ(door.beside().registry().find(me.fingerprint())->value().name, "touch-07");
  const auto list = client->ask(rpc::SessionListRequest{}, kTimeout);
  ASSERT_TRUE(list);
  EXPECT_EQ(std::get<rpc::SessionList>(*list).sessions.at(0).name, "contact");
  auto other = door.connect(auth::Identity::make("x", auth::test::counting<16>(), kNow));
  ASSERT_TRUE(other);
  EXPECT_EQ(reason_of(other->ask(rpc::Enroll{code}, kTimeout)), ErrorCode::kCode) << "a code is good once";
}

TEST(ControlPlane, RejectsCodesOneBitOffOrOneSecondTooOld) {
  ControlServerFixture door;
  const auto code = auth::test::secret_from<16>(1);
  ASSERT_EQ(door.beside().registry().issue_code(code, "touch-07", kNow, kNow + 10), "");
  const auto me = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  const auto try_code = [&](const auth::EnrolmentCode& c) {
    auto client = door.connect(me);
    return client ? client->ask(rpc::Enroll{c}, kTimeout) : std::unexpected(client.error());
  };
  for (const std::size_t bit : {0u, 64u, 127u}) {
    auto wrong = code;
    wrong.bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_EQ(reason_of(try_code(wrong)), ErrorCode::kCode);
  }
  door.wall = kNow + 11;
  const auto late = try_code(code);
  ASSERT_EQ(reason_of(late), ErrorCode::kCode);
  EXPECT_NE(std::get<rpc::ErrorReply>(*late).text.find("expired"), std::string::npos);
  EXPECT_FALSE(door.beside().registry().find(me.fingerprint())->has_value());
}

TEST(ControlPlane, AllowsUnenrolledClientsOnlyToEnrol) {
  ControlServerFixture door;
  const auto stranger = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  const std::vector<rpc::Body> all{rpc::SessionListRequest{}, rpc::Ping{1}, hello_with(door.ticket(stranger)),
                                   rpc::StopSession{}, rpc::Drain{}};
  for (const rpc::Body& body : all) {
    auto client = door.connect(stranger);
    ASSERT_TRUE(client);
    EXPECT_EQ(reason_of(client->ask(body, kTimeout)), ErrorCode::kNotEnrolled) << body.index();
    EXPECT_FALSE(client->ask(rpc::Ping{1}, kTimeout)) << "and the connection is over";
  }
}

TEST(ControlPlane, AcceptsAWorkstationThatAnotherServerOfTheServiceHasJustEnrolled) {
  ControlServerFixture door;
  const auto stranger = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  int looks = 0;
  door.sessions->on_unknown = [&] {  // the enrolment arrives between the first look and the third one
    const std::string problem =
        ++looks == 2 ? door.beside().registry().enroll_without_code({"me", stranger.fingerprint().sha256, kNow}) : "";
    EXPECT_EQ(problem, "");
    return true;
  };
  auto client = door.connect(stranger);
  ASSERT_TRUE(client);
  EXPECT_FALSE(reason_of(client->ask(rpc::SessionListRequest{}, kTimeout)));
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(door.plane->count(ControlEvent::kNotEnrolled), 0U);
  ASSERT_TRUE(door.beside().registry().revoke("me"));
  EXPECT_EQ(reason_of(client->ask(rpc::SessionListRequest{}, kTimeout)), ErrorCode::kNotEnrolled);
  EXPECT_EQ(looks, 2) << "a revoked workstation does not wait";
}

TEST(ControlPlane, RejectsAnUnknownWorkstationAfterABoundedWait) {
  ControlServerFixture door;
  const auto stranger = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  int looks = 0;
  door.sessions->on_unknown = [&] { return ++looks > 0; };
  auto client = door.connect(stranger);
  ASSERT_TRUE(client);
  EXPECT_EQ(reason_of(client->ask(rpc::SessionListRequest{}, kTimeout)), ErrorCode::kNotEnrolled);
  EXPECT_GE(looks, 1);
  EXPECT_LE(looks, 4) << "0.4 s, a look each 0.1 s";
  EXPECT_EQ(door.plane->count(ControlEvent::kNotEnrolled), 1U);
  EXPECT_FALSE(client->ask(rpc::Ping{1}, kTimeout)) << "and the connection is over";
}

TEST(ControlPlane, RejectsTheNextRequestOfARevokedWorkstation) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  auto open = door.connect(me);
  ASSERT_TRUE(open);
  ASSERT_FALSE(reason_of(open->ask(rpc::SessionListRequest{}, kTimeout)));
  ASSERT_TRUE(door.beside().registry().revoke("me"));
  EXPECT_EQ(reason_of(open->ask(rpc::SessionListRequest{}, kTimeout)), ErrorCode::kNotEnrolled);
  auto again = door.connect(me);
  ASSERT_TRUE(again);
  EXPECT_EQ(reason_of(again->ask(hello_with(door.ticket(me)), kTimeout)), ErrorCode::kNotEnrolled);
}

TEST(ControlPlane, AcceptsATicketOnceAndOnlyFromItsWorkstation) {
  ControlServerFixture door;
  const auto me = door.enrolled("me"), thief = door.enrolled("thief");
  const auto ticket = door.ticket(me);
  const auto join = [&](const auth::Identity& who, const rpc::Hello& hello) {
    auto client = door.connect(who);
    return client ? client->ask(hello, kTimeout) : std::unexpected(client.error());
  };
  const auto text_of = [](const auto& answer) {
    return answer ? std::get<rpc::ErrorReply>(*answer).text : std::string();
  };
  const auto stolen = join(thief, hello_with(ticket));
  EXPECT_EQ(reason_of(stolen), ErrorCode::kTicket);
  EXPECT_NE(text_of(stolen).find("another workstation"), std::string::npos);
  EXPECT_EQ(reason_of(join(me, hello_with(ticket, "trainer"))), ErrorCode::kTicket);
  const auto raised = auth::test::with_role(ticket, AccessRole::kInstructor);
  EXPECT_NE(text_of(join(me, hello_with(raised))).find("changed"), std::string::npos);
  const auto first = join(me, hello_with(ticket));
  ASSERT_TRUE(first) << first.error().text;
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(*first)) << text_of(first);
  EXPECT_EQ(std::get<rpc::Welcome>(*first), door.sessions->welcome("trainee"));
  EXPECT_NE(text_of(join(me, hello_with(ticket))).find("used already"), std::string::npos);
  door.wall = kNow + 3601;
  const auto late = join(me, hello_with(door.ticket(me, 2)));
  EXPECT_NE(text_of(late).find("expired 1 s ago"), std::string::npos) << text_of(late);
}

TEST(ControlPlane, RejectsUnsupportedVersions) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client);
  rpc::Hello hello = hello_with(door.ticket(me));
  hello.versions = {1, 4};
  EXPECT_EQ(reason_of(client->ask(hello, kTimeout)), ErrorCode::kVersion);
  auto again = door.connect(me);
  hello.versions = {1, 2};
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*again->ask(hello, kTimeout)));
}

TEST(ControlPlane, AcceptsRepliesFromAnotherThread) {
  ControlServerFixture door;
  door.sessions->from_another_thread = true;
  const auto me = door.enrolled("me");
  for (unsigned i = 1; i < 6; ++i) {
    auto client = door.connect(me);
    ASSERT_TRUE(client);
    const auto answer = client->ask(hello_with(door.ticket(me, i)), kTimeout);
    ASSERT_TRUE(answer) << answer.error().text;
    EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*answer));
  }
}

TEST(ControlPlane, DiscardsAJoinReplyThatComesTooLate) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.deadline = 2000ms;  // long enough for a handshake, on slow machines too
  ControlServerFixture door(limits);
  door.sessions->hold = true;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  EXPECT_FALSE(client->ask(hello_with(door.ticket(me)), kTimeout)) << "the server gives up first";
  ASSERT_TRUE(door.told(ControlEvent::kDeadline));
  // The control server was not blocked, and the slot is free again.
  auto other = door.connect(me);
  ASSERT_TRUE(other) << other.error().text;
  EXPECT_FALSE(reason_of(other->ask(rpc::SessionListRequest{}, kTimeout)));
  const auto answer = std::exchange(door.sessions->held, nullptr);
  ASSERT_TRUE(answer);
  std::thread([&] { answer(door.sessions->welcome("trainee")); }).join();
  std::unique_lock lock(door.sessions->mutex);
  EXPECT_TRUE(door.sessions->changed.wait_for(lock, kTimeout, [&] { return door.sessions->abandoned_count == 1; }));
  EXPECT_TRUE(door.sessions->seats_secrets.empty());
}

TEST(ControlPlane, RequiresAJoinBeforeCommandsAndLimitsTheirRate) {
  ControlServerFixture door;
  door.frozen = true;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client);
  ASSERT_FALSE(reason_of(client->ask(rpc::SessionListRequest{}, kTimeout)));
  EXPECT_EQ(reason_of(client->ask(rpc::StopSession{}, kTimeout)), ErrorCode::kNotAllowed);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(*client->ask(hello_with(door.ticket(me)), kTimeout)));
  const auto let_through = [&](const rpc::Body& command, int times) {
    int done = 0, fast = 0;
    for (int i = 0; i < times; ++i) {
      const auto answer = client->ask(command, kTimeout);
      EXPECT_TRUE(answer) << answer.error().text;
      done += answer && std::holds_alternative<rpc::Ok>(*answer) ? 1 : 0;
      fast += reason_of(answer) == ErrorCode::kTooFast ? 1 : 0;
    }
    EXPECT_EQ(done + fast, times);
    return done;
  };
  EXPECT_EQ(let_through(rpc::StatusRequest{}, 25), 18) << "20 at once, of which two were spent above";
  EXPECT_EQ(let_through(rpc::PauseSession{}, 25), 19)
      << "requests that stop hands have a rate limit of their own; one was spent above";
  EXPECT_EQ(let_through(rpc::SetAuthority{{}, 0, 0, {1.0}}, 130), 120) << "has its own allowance";
  EXPECT_EQ(door.plane->count(ControlEvent::kCommandTooFast), 7U + 6U + 10U);
}

TEST(ControlPlane, RejectsForbiddenCommandsAndKeepsTheConnection) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(*client->ask(hello_with(door.ticket(me)), kTimeout)));  // a trainee
  for (const rpc::Body& body :
       {rpc::Body{rpc::StopSession{}}, rpc::Body{rpc::RemoveParticipant{{}, "a", ""}}, rpc::Body{rpc::Drain{}},
        rpc::Body{hello_with(door.ticket(me, 2))}, rpc::Body{rpc::Enroll{}}})
    EXPECT_EQ(reason_of(client->ask(body, kTimeout)), ErrorCode::kNotAllowed) << body.index();
  EXPECT_EQ(door.plane->count(ControlEvent::kForbidden), 5U);
  EXPECT_TRUE(std::holds_alternative<rpc::Pong>(*client->ask(rpc::Ping{1}, kTimeout)));
  const auto news = door.news();
  const auto told = std::ranges::count_if(
      news, [](const ControlEventRecord& n) { return n.event == ControlEvent::kForbidden && !n.detail.empty(); });
  EXPECT_GE(told, 1) << "a line for the audit log";
  EXPECT_LE(told, 5);
}

TEST(ControlPlane, LimitsLogLinesForForbiddenCommands) {
  ControlServerFixture door;
  door.frozen = true;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(*client->ask(hello_with(door.ticket(me)), kTimeout)));
  for (int i = 0; i < 15; ++i) EXPECT_EQ(reason_of(client->ask(rpc::Drain{}, kTimeout)), ErrorCode::kNotAllowed);
  EXPECT_EQ(door.plane->count(ControlEvent::kForbidden), 15U);
  const auto news = door.news();
  EXPECT_EQ(
      std::ranges::count_if(
          news, [](const ControlEventRecord& n) { return n.event == ControlEvent::kForbidden && !n.detail.empty(); }),
      1)
      << "one a second";
}

TEST(ControlPlane, BlocksOnlyTheSourceOfWrongEnrolmentCodes) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.loopback_exempt = false;
  ControlServerFixture door(limits);
  const auto code = auth::test::secret_from<16>(1);
  ASSERT_EQ(door.beside().registry().issue_code(code, "touch-07", kNow, kNow + 10), "");
  const auto me = door.enrolled("me");
  const auto stranger = auth::Identity::make("x", auth::test::counting<16>(), kNow);
  const auto ask_as = [&](const auth::Identity& who, const rpc::Body& what) {
    auto client = door.connect(who);
    return client ? client->ask(what, kTimeout) : std::unexpected(client.error());
  };
  for (unsigned i = 0; i < 10; ++i) {
    // A valid code, ticket or resume secret of another workstation in between costs nothing and undoes nothing.
    rpc::Hello resume = hello_with(door.ticket(me, 90));
    resume.credential = rpc::ResumeCredential{auth::test::secret_from<32>(7)};
    EXPECT_EQ(reason_of(ask_as(me, resume)), ErrorCode::kTicket) << "this session has nothing to resume";
    EXPECT_EQ(reason_of(ask_as(stranger, rpc::Enroll{auth::test::secret_from<16>(100 + i)})), ErrorCode::kCode) << i;
  }
  const auto blocked = ask_as(stranger, rpc::Enroll{code});
  EXPECT_EQ(reason_of(blocked), ErrorCode::kBlocked) << "the right code too, so that the reply reveals nothing";
  EXPECT_NE(std::get<rpc::ErrorReply>(*blocked).text.find("wait 300 s"), std::string::npos)
      << std::get<rpc::ErrorReply>(*blocked).text;
  EXPECT_EQ(std::get<rpc::ErrorReply>(*blocked).retry_after_s, 300u);
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*ask_as(me, hello_with(door.ticket(me))))) << "a ticket is no code";
}

TEST(ControlPlane, RevealsNoSecrets) {
  ControlServerFixture door;
  const auto code = auth::test::secret_from<16>(1);
  ASSERT_EQ(door.beside().registry().issue_code(code, "touch-07", kNow, kNow + 10), "");
  const auto me = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  auto client = door.connect(me);
  ASSERT_TRUE(client && client->ask(rpc::Enroll{code}, kTimeout));
  const auto ticket = door.ticket(me);
  const auto joined = client->ask(hello_with(ticket), kTimeout);
  ASSERT_TRUE(joined && std::holds_alternative<rpc::Welcome>(*joined));
  auto again = door.connect(me);
  ASSERT_TRUE(again && again->ask(hello_with(ticket), kTimeout));  // rejected, with a reason
  std::string all = door.folder.read("server/audit.log");
  for (const ControlEventRecord& news : door.news())
    all += news.address + " " + news.workstation + " " + news.detail + "\n";
  EXPECT_NE(all.find("touch-07"), std::string::npos);
  const auto secrets = [&] {
    const std::lock_guard lock(door.sessions->mutex);
    return door.sessions->seats_secrets.at("trainee");
  }();
  const auto resume = door.sessions->welcome("trainee").resume_secret;
  const auto signature = std::span(ticket).last(64);
  for (const std::span<const std::byte> secret :
       {std::span<const std::byte>(code.bytes), std::span<const std::byte>(resume.bytes),
        std::span<const std::byte>(secrets), std::span<const std::byte>(signature)}) {
    EXPECT_EQ(all.find(auth::to_hex(secret.first(8))), std::string::npos);
    EXPECT_EQ(all.find(auth::to_base32(secret).substr(0, 8)), std::string::npos);
    EXPECT_EQ(all.find(std::string(text_of(secret.first(8)))), std::string::npos);
  }
  EXPECT_EQ(all.find("PRIVATE KEY"), std::string::npos);
}

TEST(ControlPlane, SelectsTheLocalServersKeysDuringTheHandshake) {
  ControlServerFixture door;
  const auto local = door.enrolled("local");
  const auto key = auth::TlsKey::from_pem(std::as_const(*std::make_unique<SecretBuffer>(local.key.to_pem())).bytes());
  ASSERT_TRUE(key);
  auto beside = door.beside();
  const auto published = auth::RuntimeDirectory::publish(
      door.folder.path("run"), door.server_fingerprint,
      {std::move(*auth::Identity::from_pem(std::as_const(*std::make_unique<SecretBuffer>(local.key.to_pem())).bytes(),
                                           bytes_of(local.certificate.to_pem()))),
       beside.ticket_key()});
  ASSERT_TRUE(published) << published.error();
  std::optional<auth::LocalKeys> found;
  auto client = auth::ControlClient::connect(
      door.address,
      [&](const auth::KeyFingerprint& fingerprint) -> std::expected<const auth::Identity*, std::string> {
        auto keys = auth::find_local_keys(door.folder.path("run"), fingerprint);
        if (!keys) return std::unexpected(keys.error());
        if (!*keys) return std::unexpected("no local server has this key");
        found = std::move(*keys);
        return &found->workstation;
      },
      kTimeout, -1);
  ASSERT_TRUE(client) << client.error().text;
  auth::Ticket ticket = auth::test::sample_ticket();
  ticket.workstation = found->workstation.fingerprint();
  const auto own = auth::sign_ticket(ticket, found->ticket_key);
  ASSERT_TRUE(own);
  const auto answer = client->ask(hello_with(*own), kTimeout);
  ASSERT_TRUE(answer) << answer.error().text;
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*answer));
}

TEST(ControlPlane, ListensOnIpv6Too) {
  ControlServerFixture door(ControlServerFixture::patient(), "[::1]:0");
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  EXPECT_FALSE(reason_of(client->ask(rpc::SessionListRequest{}, kTimeout)));
}

}  // namespace
}  // namespace tandem::server::test
