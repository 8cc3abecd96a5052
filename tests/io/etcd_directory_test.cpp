#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>

#include "common/auth/tls_key.h"
#include "server/directory/ownership.h"
#include "tests/io/etcd_process.h"

#ifdef __SANITIZE_THREAD__
// gRPC's threads pass TLS connections to etcd among them, and the sanitizer sees neither gRPC's locks nor its frames
// (tests/support/tsan.supp). Only this program suppresses OpenSSL: nothing else in it uses TLS.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "race:libcrypto.so\nrace:libssl.so\n"; }
#endif

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;
using tandem::test::Etcd;
using tandem::test::wait_for_reply;

TEST(EtcdOptions, EveryMistakeIsNamed) {
  const auto problem = [](auto change) {
    EtcdOptions options;
    options.endpoints = {"10.0.0.1:2379"};
    change(options);
    return options.problem().value_or("");
  };
  EXPECT_EQ(problem([](EtcdOptions&) {}), "");
  EXPECT_EQ(problem([](EtcdOptions& o) { o.endpoints = {"host.example:1", "[::1]:65535"}; }), "");
  EXPECT_NE(problem([](EtcdOptions& o) { o.endpoints.clear(); }), "");
  EXPECT_NE(problem([](EtcdOptions& o) { o.endpoints.assign(10, "a:1"); }), "");
  for (const char* bad : {"", "host", ":1", "host:0", "host:65536", "host:x", "http://host:1", "a:1,b:2"})
    EXPECT_NE(problem([&](EtcdOptions& o) { o.endpoints = {bad}; }).find("HOST:PORT"), std::string::npos) << bad;
  EXPECT_NE(problem([](EtcdOptions& o) { o.certificate = "x"; }), "");
  EXPECT_NE(problem([](EtcdOptions& o) { o.answer_limit = 0s; }), "");
}

class EtcdDirectoryTest : public testing::Test {
 protected:
  void SetUp() override {
    if (tandem::test::etcd_program("etcd").empty()) GTEST_SKIP() << tandem::test::kNoEtcd;
  }
  static EtcdOptions to(std::vector<std::string> endpoints) {
    EtcdOptions options;
    options.endpoints = std::move(endpoints);
    return options;
  }
};

/// A server's core in real time.
struct Server {
  Server(const std::string& name, const EtcdOptions& options) : core(name, "text", times()), directory(options) {}
  /// Twice the usual times, for machines that are busy with other tests.
  static LeaseTimes times() {
    LeaseTimes times;
    times.ttl = 6s;
    times.hold_after = 4s;
    times.renew_every = 1s;
    return times;
  }
  void step() {
    const Time now = Time{} + std::chrono::steady_clock::now().time_since_epoch();
    while (auto operation = core.poll_operation(now)) directory.begin(operation->id, operation->request);
    while (auto reply = directory.poll()) core.on_reply(now, *reply);
    while (auto notice = core.poll_notice()) notices.push_back(*notice);
  }
  [[nodiscard]] SessionState state() const {
    return core.state("s", Time{} + std::chrono::steady_clock::now().time_since_epoch());
  }
  [[nodiscard]] bool has(Notice::Kind kind) const {
    return std::ranges::any_of(notices, [kind](const Notice& n) { return n.kind == kind; });
  }
  Ownership core;
  EtcdDirectory directory;
  std::vector<Notice> notices;
};

template <class Condition>
bool reach(std::initializer_list<Server*> servers, Condition condition) {
  const auto end = std::chrono::steady_clock::now() + tandem::test::Process::kTimeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    for (Server* server : servers) server->step();
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

TEST_F(EtcdDirectoryTest, CarriesOwnershipMovesTicketsAndTheDeathOfAServer) {
  Etcd etcd;
  auto a = std::make_unique<Server>("a", to({etcd.endpoint()}));
  Server b("b", to({etcd.endpoint()}));
  Server* const first = a.get();
  ASSERT_TRUE(reach({first, &b}, [&] { return first->core.view().server("b") && b.core.view().server("a"); }));
  first->core.claim("s");
  ASSERT_TRUE(reach({first, &b}, [&] { return first->state() == SessionState::kServing; }));
  const Revision owned = first->core.revision("s");
  b.core.claim("s");
  ASSERT_TRUE(reach({first, &b}, [&] { return b.has(Notice::Kind::kElsewhere); }));
  first->core.use_ticket("s", "t");
  first->core.use_ticket("s", "t");
  ASSERT_TRUE(reach({first, &b}, [&] {
    return first->has(Notice::Kind::kTicketAccepted) && first->has(Notice::Kind::kTicketRefused);
  }));
  first->core.move("s", "b");
  ASSERT_TRUE(reach({first, &b}, [&] { return b.state() == SessionState::kServing; }));
  EXPECT_EQ(first->state(), SessionState::kNone);
  EXPECT_GT(b.core.revision("s"), owned);
  b.core.set_standby("s", "a");
  ASSERT_TRUE(reach({first, &b}, [&] { return b.has(Notice::Kind::kStandbySet); }));
  // b is stopped: a takes over when b's lease has ended, not before b has ramped out.
  ASSERT_TRUE(reach({first}, [&] { return first->state() == SessionState::kServing; }));
  EXPECT_FALSE(b.core.may_act("s", Time{} + std::chrono::steady_clock::now().time_since_epoch()));
  ASSERT_TRUE(reach({first, &b}, [&] { return b.state() == SessionState::kLost; }));
}

TEST_F(EtcdDirectoryTest, GoesToTheNextEndpointAndReportsWhatItDoesNotKnow) {
  Etcd first, second;
  for (Etcd* member : {&first, &second}) {
    EtcdDirectory alone(to({member->endpoint()}));
    member->wait_until_ready(alone);
  }
  EtcdDirectory directory(to({first.endpoint(), second.endpoint()}));
  directory.begin(1, Watch{"", 0});
  EXPECT_EQ(wait_for_reply(directory, 1).outcome, Outcome::kDone);
  first.process().signal(SIGKILL);
  // The watch ends. Calls succeed after some tries, at the other member; here it has a store of its own.
  EXPECT_EQ(wait_for_reply(directory, 1).outcome, Outcome::kUnknown);
  second.wait_until_ready(directory, 2);
  EXPECT_GT(directory.counters().endpoint_changes, 0U);
  EXPECT_GT(directory.counters().unknown, 0U);
}

TEST_F(EtcdDirectoryTest, WaitsBetweenFailuresWhileNoMemberAnswers) {
  EtcdDirectory directory(to({"127.0.0.1:1", "127.0.0.1:2"}));
  const auto began = std::chrono::steady_clock::now();
  constexpr OperationId kTries = 12;
  for (OperationId n = 1; n <= kTries; ++n) {
    directory.begin(n, Transaction{});
    const Reply reply = wait_for_reply(directory, n);
    EXPECT_EQ(reply.outcome, Outcome::kUnknown);
    EXPECT_TRUE(reply.unreachable) << reply.reason;
  }
  EXPECT_GE(std::chrono::steady_clock::now() - began, 900ms) << "a tenth of a second each, but for the first members";
  EXPECT_EQ(directory.counters().begun, kTries);
  // At once where a further member answers.
  Etcd etcd;
  EtcdDirectory other(to({"127.0.0.1:1", etcd.endpoint()}));
  etcd.wait_until_ready(other);
  other.begin(100'000, Transaction{});
  EXPECT_EQ(wait_for_reply(other, 100'000).outcome, Outcome::kDone);
}

TEST_F(EtcdDirectoryTest, AnswersUnknownWhereNothingListensAndEndsWithOpenCalls) {
  EtcdDirectory directory(to({"127.0.0.1:1"}));
  directory.begin(1, Transaction{});
  EXPECT_EQ(wait_for_reply(directory, 1).outcome, Outcome::kUnknown);
  for (OperationId n = 2; n < 2 * EtcdDirectory::kOpenMax; ++n) directory.begin(n, Watch{"", 0});
  EXPECT_GT(directory.counters().overflowed, 0U);
}

std::string text_of(const SecretBuffer& secret) {
  const auto bytes = secret.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(EtcdDirectoryTest, ProvesItselfByACertificateAndTalksToNoOtherEtcd) {
  struct Identity {
    auth::TlsKey key = auth::TlsKey::generate();
    std::string certificate =
        auth::Certificate::self_signed(key, "etcd", std::array<std::byte, 16>{std::byte{1}}, std::time(nullptr))
            .to_pem();
  };
  const Identity member, server, stranger;
  tandem::test::Folder folder;
  Etcd etcd({"--cert-file", folder.write("member.pem", member.certificate), "--key-file",
             folder.write("member.key", text_of(member.key.to_pem())), "--client-cert-auth", "--trusted-ca-file",
             folder.write("clients.pem", server.certificate)});
  const auto options = [&](const std::string& authority, const Identity& own) {
    EtcdOptions out = to({etcd.endpoint()});
    out.authority = authority;
    out.certificate = own.certificate;
    out.key = text_of(own.key.to_pem());
    out.name_in_certificate = "etcd";
    return out;
  };
  EtcdDirectory directory(options(member.certificate, server));
  etcd.wait_until_ready(directory);
  const auto outcome = [](const EtcdOptions& with) {
    EtcdDirectory other(with);
    other.begin(1, Transaction{});
    return wait_for_reply(other, 1).outcome;
  };
  EXPECT_EQ(outcome(options(member.certificate, server)), Outcome::kDone);
  EXPECT_EQ(outcome(options(member.certificate, stranger)), Outcome::kUnknown);
  EXPECT_EQ(outcome(options(stranger.certificate, server)), Outcome::kUnknown);
  EXPECT_EQ(outcome(to({etcd.endpoint()})), Outcome::kUnknown);
}

}  // namespace
}  // namespace tandem::directory
