#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "common/auth/enrolment.h"
#include "common/auth/ticket.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/support/process.h"

/// The procedures of SECURITY.md, with the programs as users type them.
namespace tandem::server::test {
namespace {

using tandem::test::Process;
using Words = std::vector<std::string>;

struct Ran {
  int code = -1;
  std::string out, err;
};
Ran run(const char* program, Words words) {
  words.insert(words.begin(), program);
  Process process(std::move(words));
  const auto code = process.wait();
  return {code.value_or(-1), process.out(), process.err()};
}
std::string line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// A control server with one state directory, and workstations with folders of their own.
struct School {
  School() { door.wall = auth::wall_seconds(); }
  [[nodiscard]] std::string state() const { return door.folder.path("server"); }
  Ran server(Words words) {
    words.insert(words.end(), {"--state", state()});
    return run(TANDEM_SERVER, std::move(words));
  }
  void enroll(const std::string& name) {
    const Ran given = server({"enroll", name, "--address", io::to_text(door.address)});
    ASSERT_EQ(given.code, 0) << given.err;
    const Ran taken = run(TANDEM_CLIENT, {"enroll", line(given.out), "--state", door.folder.path(name)});
    ASSERT_EQ(taken.code, 0) << taken.err;
  }
  std::string ticket(const std::string& name) {
    const Ran made = server({"ticket", "--session", auth::to_hex(door.sessions->session_id), "--seat", "trainee",
                             "--role", "trainee", "--workstation", name});
    EXPECT_EQ(made.code, 0) << made.err;
    return line(made.out);
  }
  /// Returns the keystore as the workstation's folder contains it now.
  [[nodiscard]] auth::ClientKeystore own(const std::string& name) const {
    return std::move(**auth::ClientKeystore::open(door.folder.path(name)));
  }
  auto join(const auth::Identity& who, const std::string& text) {
    door.wall = auth::wall_seconds();
    auto connected = door.connect(who);
    return connected ? connected->ask(hello_with(*auth::ticket_from_text(text)), kTimeout)
                     : std::unexpected(connected.error());
  }

  ControlServerFixture door;
};

TEST(KeyProcedures, ReplaceAWorkstationKeyAndRejectTheOldOne) {
  School school;
  school.enroll("touch-07");
  const auth::ClientKeystore old = school.own("touch-07");
  ASSERT_EQ(school.server({"revoke", "touch-07"}).code, 0);
  for (const char* file : {"workstation_key.pem", "workstation_cert.pem"})
    ASSERT_TRUE(std::filesystem::remove(school.door.folder.path("touch-07") + "/" + file));
  school.enroll("touch-07");
  const std::string ticket = school.ticket("touch-07");
  EXPECT_EQ(reason_of(school.join(old.identity(), ticket)), rpc::ErrorCode::kNotEnrolled);
  const auto joined = school.join(school.own("touch-07").identity(), ticket);
  ASSERT_TRUE(joined) << joined.error().text;
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*joined));
}

TEST(KeyProcedures, RejectANewTicketKeyWhileAServerRuns) {
  School school;
  const Ran running = school.server({"init", "--new-ticket-key"});
  EXPECT_EQ(running.code, 1);
  EXPECT_NE(running.err.find("another server runs from this folder"), std::string::npos) << running.err;
}

TEST(KeyProcedures, VoidTicketsAndKeepWorkstationsWithANewTicketKey) {
  const Folder folder;
  const std::string state = folder.path("server");
  const auto fingerprint = auth::ServerKeystore::init(state, auth::wall_seconds());
  ASSERT_TRUE(fingerprint) << fingerprint.error();
  const auto key = [&] { return folder.read("server/ticket_key"); };
  const std::string before = key(), workstations = folder.read("server/workstations.textproto");
  const Ran renewed = run(TANDEM_SERVER, {"init", "--new-ticket-key", "--state", state});
  ASSERT_EQ(renewed.code, 0) << renewed.err;
  EXPECT_NE(key(), before);
  EXPECT_EQ(folder.read("server/workstations.textproto"), workstations);
  const auto opened = auth::ServerKeystore::open(state);
  ASSERT_TRUE(opened) << opened.error();
  EXPECT_EQ(opened->identity().fingerprint(), *fingerprint) << "clients know the server by this key";
  EXPECT_NE(folder.read("server/audit.log").find("ticket_key_renewed"), std::string::npos);
  // A signature by the old key is invalid.
  const auto old_key = auth::TicketKey::from_text(std::as_bytes(std::span(before)));
  ASSERT_TRUE(old_key);
  const auto message = std::as_bytes(std::span(std::string_view("a ticket")));
  EXPECT_TRUE(old_key->verifier().verifies(message, old_key->sign(message)));
  EXPECT_FALSE(opened->ticket_key().verifier().verifies(message, old_key->sign(message)));
}

/// Two servers as members of one service, whose key is then changed, and a workstation that is enrolled at one of them.
TEST(KeyProcedures, MakeTwoServersOneServiceAndChangeItsKey) {
  const Folder folder;
  const std::string service = folder.path("service"), client = folder.path("client");
  const auto ok = [](const Ran& ran) {
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  };
  const auto word_after = [](const std::string& text, const std::string& label) {
    const auto at = text.find(label);
    return at == std::string::npos ? std::string() : line(text.substr(text.find_first_not_of(' ', at + label.size())));
  };
  ok(run(TANDEM_SERVER, {"service", "init", service}));
  int files = 0;
  const auto make_member = [&](const std::string& name, const std::string& key) {
    const std::string file = folder.path("member-" + std::to_string(++files));
    ok(run(TANDEM_SERVER, {"service", "vouch", service, "--name", name, "--key", key, "--out", file}));
    EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0600));
    ok(run(TANDEM_SERVER, {"service", "join", file, "--state", folder.path(name)}));
  };
  std::map<std::string, std::string> keys;
  for (const std::string name : {"a", "b"}) {
    keys[name] = word_after(ok(run(TANDEM_SERVER, {"init", "--state", folder.path(name)})), "server key");
    make_member(name, keys[name]);
  }
  const std::string enrolment =
      line(ok(run(TANDEM_SERVER, {"enroll", "touch-07", "--address", "127.0.0.1:1", "--state", folder.path("a")})));
  const auto start = [&](const std::string& name) {
    auto server = std::make_unique<Process>(
        Words{TANDEM_SERVER, "run", "free_motion", "--listen", "127.0.0.1:0", "--state", folder.path(name)});
    EXPECT_TRUE(server->wait_for("listening on ")) << server->err();
    return server;
  };
  const auto sessions = [&](Process& server) {
    return run(TANDEM_CLIENT, {"sessions", "--server", server.after("listening on "), "--state", client});
  };
  {
    auto given = auth::EnrolmentString::from_text(enrolment).value();
    auto a = start("a");
    given.address = a->after("listening on ");
    ok(run(TANDEM_CLIENT, {"enroll", given.to_text(), "--state", client}));
    const Ran running = run(TANDEM_SERVER, {"service", "join", folder.path("member-1"), "--state", folder.path("a")});
    EXPECT_EQ(running.code, 1);
    EXPECT_NE(running.err.find("another server runs"), std::string::npos) << running.err;
  }
  const std::string first = word_after(ok(run(TANDEM_SERVER, {"service", "show", service})), "service key");
  EXPECT_NE(folder.read("client/servers.textproto").find(first), std::string::npos);
  // Both servers have the same registry, as members with one directory do.
  std::filesystem::copy_file(folder.path("a") + "/workstations.textproto", folder.path("b") + "/workstations.textproto",
                             std::filesystem::copy_options::overwrite_existing);
  {
    auto b = start("b");
    EXPECT_NE(ok(sessions(*b)).find("free_motion"), std::string::npos);
  }
  ok(run(TANDEM_SERVER, {"service", "rotate", service}));
  make_member("b", keys["b"]);
  const std::string second = word_after(ok(run(TANDEM_SERVER, {"service", "show", service})), "service key");
  EXPECT_NE(second, first);
  {
    auto b = start("b");
    EXPECT_NE(ok(sessions(*b)).find("free_motion"), std::string::npos);
  }
  EXPECT_NE(folder.read("client/servers.textproto").find("service_key: \"" + second), std::string::npos);
  const Ran refused = run(TANDEM_SERVER, {"service", "vouch", service, "--name", "a b", "--key", "00"});
  EXPECT_EQ(refused.code, 2);
  for (const char* word : {"--name", "--key", "--out"}) EXPECT_NE(refused.err.find(word), std::string::npos);
  const Ran twice = run(TANDEM_SERVER, {"service", "vouch", service, "--name", "a", "--key", keys["b"], "--out",
                                        folder.path("member-twice")});
  EXPECT_EQ(twice.code, 0) << twice.err;
  for (const std::string& words : {std::string("warning: the name a has a voucher until"), keys["a"]})
    EXPECT_NE(twice.err.find(words), std::string::npos) << twice.err;
  EXPECT_EQ(run(TANDEM_SERVER, {"service", "init", service}).code, 1);
  EXPECT_EQ(run(TANDEM_SERVER, {"service", "grow"}).code, 2);
  const std::string revoked = ok(run(TANDEM_SERVER, {"revoke", "touch-07", "--state", folder.path("a")}));
  EXPECT_NE(revoked.find("other servers of the service learn of it"), std::string::npos) << revoked;
}

TEST(KeyProcedures, RequireAnInitialisedFolderForANewTicketKey) {
  const Folder folder;
  const Ran ran = run(TANDEM_SERVER, {"init", "--new-ticket-key", "--state", folder.path("none")});
  EXPECT_EQ(ran.code, 1);
  EXPECT_NE(ran.err.find("tandem-server init"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace tandem::server::test
