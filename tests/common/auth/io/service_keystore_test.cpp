#include "common/auth/io/service_keystore.h"

#include <gtest/gtest.h>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/identity_selector.h"
#include "common/auth/io/server_keystore.h"
#include "common/auth/ticket.h"
#include "proto/text/service_text.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::Folder;

constexpr std::int64_t kDay = Voucher::kDay;

/// A service with two servers, in one folder each.
struct TwoServers {
  Folder folder;
  std::int64_t now = wall_seconds();
  KeyFingerprint a = ServerKeystore::init(folder.path("a"), now).value(),
                 b = ServerKeystore::init(folder.path("b"), now).value();

  TwoServers() { EXPECT_TRUE(ServiceKeystore::init(folder.path("service"))); }
  [[nodiscard]] SecretBuffer member(const std::string& name, const KeyFingerprint& key, std::int64_t days = 400,
                                    const char* service = "service") const {
    auto text = ServiceKeystore::open(folder.path(service))->vouch({name, key, now - 60, now - 60 + days * kDay});
    EXPECT_TRUE(text) << text.error();
    return std::move(*text);
  }
  [[nodiscard]] std::string join(const char* server, const SecretBuffer& file) const {
    const auto joined = ServerKeystore::join_service(folder.path(server), file.bytes(), "file", now);
    return joined ? "" : joined.error();
  }
  [[nodiscard]] ServerKeystore open(const char* server) const {
    auto trust = ServerKeystore::open(folder.path(server));
    EXPECT_TRUE(trust) << trust.error();
    return std::move(*trust);
  }
  [[nodiscard]] PresentedKey shown_by(const char* server) const {
    const ServerKeystore trust = open(server);
    return PresentedKey(trust.identity().fingerprint(), credential_in(trust.identity().certificate.handle()));
  }
};

TEST(ServiceKeystore, MakesServersOfOneServiceShareTicketsButNoServerKey) {
  TwoServers t;
  EXPECT_EQ(t.open("a").membership(), nullptr);
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a)), "");
  ASSERT_EQ(t.join("b", t.member("desk-b", t.b)), "");
  const ServerKeystore a = t.open("a"), b = t.open("b");
  EXPECT_EQ(a.ticket_key().verifier().key, b.ticket_key().verifier().key);
  EXPECT_EQ(a.identity().fingerprint(), t.a);
  EXPECT_EQ(b.identity().fingerprint(), t.b);
  ASSERT_NE(b.membership(), nullptr);
  EXPECT_EQ(b.membership()->name, "desk-b");
  EXPECT_EQ(b.membership()->service_key, ServiceKeystore::open(t.folder.path("service"))->public_key());
  Ticket ticket = test::sample_ticket();
  const auto bytes = sign_ticket(ticket, a.ticket_key());
  EXPECT_TRUE(check_ticket(*bytes, b.ticket_key().verifier(), test::sample_use(ticket)));
  // Nothing on a server signs for the service.
  for (const char* file : {"a/member.textproto", "b/member.textproto"})
    EXPECT_EQ(t.folder.read(file).find(t.folder.read("service/service_key").substr(22, 64)), std::string::npos);
}

TEST(ServiceKeystore, GivesAServerOnlyItsOwnMemberFile) {
  TwoServers t;
  EXPECT_NE(t.join("b", t.member("desk-a", t.a)).find("issued for another key"), std::string::npos);
  EXPECT_EQ(t.open("b").membership(), nullptr);
  SecretBuffer damaged = t.member("desk-a", t.a);
  std::string text(reinterpret_cast<const char*>(damaged.bytes().data()), damaged.size());
  text[text.find("voucher: \"") + 60] ^= 1;
  EXPECT_NE(t.join("a", SecretBuffer(std::as_bytes(std::span(text)))), "");
  EXPECT_NE(t.join("a", SecretBuffer(std::size_t{0})).find("file"), std::string::npos);
}

/// A file that was named by mistake may be a key.
TEST(ServiceKeystore, ShowsNothingOfAFileThatIsNoMemberFile) {
  TwoServers t;
  const std::string key = t.folder.read("a/server_key.pem"), secret = key.substr(key.find('\n') + 1, 20);
  for (const std::string& text : {key, "password: \"" + secret + "\"\n", secret + " " + secret + "\n",
                                  "name: \"" + secret + "\" service_key: \"" + secret + "\"\n"}) {
    const std::string why = t.join("a", SecretBuffer(std::as_bytes(std::span(text))));
    EXPECT_EQ(why.find(secret.substr(0, 8)), std::string::npos) << why;
    EXPECT_EQ(why.find("password"), std::string::npos) << why;
    EXPECT_EQ(why.find("file: is no member file of a service"), 0U) << why;
    EXPECT_NE(why.find("tandem-server service vouch"), std::string::npos) << why;
  }
}

TEST(ServiceKeystore, NamesTheRemedyForAnExpiredVoucher) {
  TwoServers t;
  t.now -= 10 * kDay;
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a, 5)), "");
  ServerKeystore a = t.open("a");  // commands still work
  const std::string problem = a.begin_serving(wall_seconds());
  EXPECT_NE(problem.find("expired 5 days ago"), std::string::npos) << problem;
  EXPECT_NE(problem.find("service vouch FOLDER --name desk-a --key " + t.a.hex()), std::string::npos);
  EXPECT_EQ(ServerKeystore::find_errors(t.folder.path("a")).size(), 1u);
  EXPECT_NE(ServerKeystore::rotate_ticket_key(t.folder.path("a"), t.now).find("service rotate"), std::string::npos);
  t.now += 10 * kDay;
  EXPECT_NE(t.join("b", t.member("desk-b", t.b, 0)), "") << "it expired a minute ago";
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a)), "");
  EXPECT_EQ(t.open("a").begin_serving(wall_seconds()), "");
}

TEST(ServiceKeystore, RefusesToJoinWhileTheServerRuns) {
  TwoServers t;
  ServerKeystore running = t.open("a");
  ASSERT_EQ(running.begin_serving(t.now), "");
  EXPECT_NE(t.join("a", t.member("desk-a", t.a)), "");
  EXPECT_EQ(t.open("a").membership(), nullptr);
}

TEST(ServiceKeystore, TakesNoMemberFileThatWouldUndoARotation) {
  TwoServers t;
  const SecretBuffer first = t.member("desk-a", t.a);
  ASSERT_EQ(t.join("a", first), "");
  ASSERT_TRUE(ServiceKeystore::rotate(t.folder.path("service"), t.now, kDay, false));
  const SecretBuffer second = t.member("desk-a", t.a);
  ASSERT_TRUE(ServiceKeystore::rotate(t.folder.path("service"), t.now, kDay, false));
  const SecretBuffer third = t.member("desk-a", t.a);
  ASSERT_EQ(t.join("a", second), "");
  ASSERT_EQ(t.join("a", second), "") << "the same again";
  ASSERT_EQ(t.join("a", third), "");
  for (const SecretBuffer* older : {&first, &second}) {
    const std::string problem = t.join("a", *older);
    for (const std::string& words : {std::string("before the key of the service was rotated"),
                                     "service vouch FOLDER --name desk-a --key " + t.a.hex(), std::string("--older")})
      EXPECT_NE(problem.find(words), std::string::npos) << problem;
  }
  EXPECT_EQ(t.open("a").membership()->service_key, ServiceKeystore::open(t.folder.path("service"))->public_key());
  EXPECT_TRUE(ServerKeystore::join_service(t.folder.path("a"), first.bytes(), "file", t.now, true));
  // A damaged member file can be replaced by any.
  ASSERT_EQ(t.join("a", third), "");
  t.folder.write("a/member.textproto", "");
  EXPECT_EQ(t.join("a", first), "");
  // A file of another service is no older one.
  ASSERT_TRUE(ServiceKeystore::init(t.folder.path("other")));
  EXPECT_EQ(t.join("a", t.member("desk-a", t.a, 400, "other")), "");
}

TEST(ServiceKeystore, NoticesASecondServerOfANameThatHasAValidVoucher) {
  TwoServers t;
  const ServiceKeystore service = std::move(*ServiceKeystore::open(t.folder.path("service")));
  const auto enter = [&](const char* name, const KeyFingerprint& key, std::int64_t from, std::int64_t until) {
    const auto other = service.enter({name, key, from, until}, from);
    EXPECT_TRUE(other) << other.error();
    return other ? *other : std::nullopt;
  };
  EXPECT_FALSE(enter("desk-a", t.a, 0, 100));
  EXPECT_FALSE(enter("desk-a", t.a, 10, 200)) << "renewed";
  EXPECT_FALSE(enter("desk-b", t.b, 10, 200));
  const auto other = enter("desk-a", t.b, 200, 300);
  ASSERT_TRUE(other) << "valid in its last second";
  EXPECT_EQ(*other, (VouchedRow{"desk-a", t.a.sha256, 200}));
  EXPECT_FALSE(enter("desk-a", t.b, 201, 400)) << "the voucher of the other key has expired";
  std::vector<VouchedRow> full(VouchedRow::kMax, {"n", {}, 5000});
  full[7].not_after = 4999;
  t.folder.write("service/vouched.textproto", print_vouched(full));
  EXPECT_FALSE(enter("last", t.a, 300, 9000));
  full.erase(full.begin() + 7);  // the first to expire
  full.push_back({"last", t.a.sha256, 9000});
  EXPECT_EQ(parse_vouched(t.folder.read("service/vouched.textproto"), "vouched"), full);
  t.folder.write("service/vouched.textproto", "server { name: 1 }");
  EXPECT_NE(service.enter({"x", t.a, 0, 1}, 0).error().find("vouched.textproto:1:"), std::string::npos);
}

TEST(ServiceKeystore, IgnoresARotationThatLostItsKey) {
  TwoServers t;
  const std::string key = t.folder.read("service/service_key");
  ASSERT_TRUE(ServiceKeystore::rotate(t.folder.path("service"), t.now, kDay, false));
  t.folder.write("service/service_key", key);
  EXPECT_TRUE(ServiceKeystore::open(t.folder.path("service"))->key_changes().empty());
}

TEST(ServiceKeystore, KeepsTheEightNewestChanges) {
  TwoServers t;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(ServiceKeystore::rotate(t.folder.path("service"), t.now, kDay, false));
  EXPECT_EQ(ServiceKeystore::open(t.folder.path("service"))->key_changes().size(), rpc::kKeyChangesMax);
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a)), "");
  EXPECT_LE(t.open("a").membership()->credential().size(), rpc::kCredentialMax);
}

/// A workstation that is enrolled at server a.
struct Workstation {
  explicit Workstation(const TwoServers& t) : path(t.folder.path("client")) {
    const auto own = ClientKeystore::open_or_make(path, t.now);
    EXPECT_EQ(own->store_server({"lab-a:7000", t.a.sha256, "touch-01"}), "");
  }
  /// Judges a server. @return why it is rejected; empty: it is accepted
  std::string judge(const PresentedKey& server, const std::vector<std::string>& members = {}) {
    IdentitySelector keys("lab-b:7000", ClientKeystore::open(path).value(), path + "-no-runtime");
    const auto got = keys(server);
    if (!got) return got.error();
    EXPECT_EQ(keys.store_service(members), "");
    return {};
  }
  [[nodiscard]] ServerRow row() const { return ClientKeystore::open(path).value()->servers().value().front(); }
  std::string path;
};

TEST(IdentitySelector, AcceptsAnotherServerOfThePinnedServiceOnly) {
  TwoServers t;
  Workstation w(t);
  EXPECT_NE(w.judge(t.shown_by("b")).find("does not know the server"), std::string::npos);
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a)), "");
  ASSERT_EQ(t.join("b", t.member("desk-b", t.b)), "");
  EXPECT_NE(w.judge(t.shown_by("b")), "") << "the service is not pinned yet";
  EXPECT_EQ(w.judge(t.shown_by("a"), {"lab-a:7000", "lab-b:7000"}), "");
  EXPECT_EQ(w.row().service->key, t.open("a").membership()->service_key);
  EXPECT_EQ(w.row().members, (std::vector<std::string>{"lab-a:7000", "lab-b:7000"}));
  EXPECT_EQ(w.judge(t.shown_by("b")), "");
  EXPECT_EQ(w.row().members.size(), 2u) << "members stay when a server names none";
  // A server of another service, and one that shows the credential of a member.
  ASSERT_TRUE(ServiceKeystore::init(t.folder.path("other")));
  ASSERT_EQ(t.join("b", t.member("desk-b", t.b, 400, "other")), "");
  EXPECT_NE(w.judge(t.shown_by("b")).find("another service"), std::string::npos);
  EXPECT_NE(w.judge(PresentedKey(t.b, t.shown_by("a").credential)).find("another key"), std::string::npos);
  EXPECT_NE(w.judge(PresentedKey(t.b)).find("does not know the server"), std::string::npos);
}

TEST(IdentitySelector, PinsARotatedKeyByItsStatementAndAcceptsOldVouchersForTheGrace) {
  TwoServers t;
  Workstation w(t);
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a)), "");
  ASSERT_EQ(t.join("b", t.member("desk-b", t.b)), "");
  ASSERT_EQ(w.judge(t.shown_by("a")), "");
  const PresentedKey old_b = t.shown_by("b");
  const auto next = ServiceKeystore::rotate(t.folder.path("service"), t.now, kDay, false);
  ASSERT_TRUE(next) << next.error();
  ASSERT_EQ(t.join("b", t.member("desk-b", t.b)), "");
  EXPECT_EQ(w.judge(t.shown_by("b")), "");
  EXPECT_EQ(w.row().service->key, *next);
  EXPECT_EQ(w.row().service->previous_until, t.now + kDay);
  EXPECT_EQ(w.judge(old_b), "") << "its voucher counts for a day";
  // A change without grace: only the new voucher counts.
  ASSERT_TRUE(ServiceKeystore::rotate(t.folder.path("service"), t.now - 10, 0, true));
  const PresentedKey replaced = t.shown_by("b");
  ASSERT_EQ(t.join("b", t.member("desk-b", t.b)), "");
  EXPECT_EQ(w.judge(t.shown_by("b")), "");
  EXPECT_NE(w.judge(replaced).find("--grace-days"), std::string::npos);
}

TEST(IdentitySelector, KeepsThePinIfAnEnrolledServerShowsAnUnrelatedService) {
  TwoServers t;
  Workstation w(t);
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a)), "");
  ASSERT_EQ(w.judge(t.shown_by("a")), "");
  const auto pinned = w.row().service;
  ASSERT_TRUE(ServiceKeystore::init(t.folder.path("other")));
  ASSERT_EQ(t.join("a", t.member("desk-a", t.a, 400, "other")), "");
  EXPECT_EQ(w.judge(t.shown_by("a")), "") << "its own key is known";
  EXPECT_EQ(w.row().service, pinned);
}

}  // namespace
}  // namespace tandem::auth
