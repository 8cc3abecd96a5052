#include <gtest/gtest.h>

#include <cstdlib>

#include "common/auth/ticket.h"
#include "proto/text/registry_text.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/support/process.h"

/// The commands as users type them, against a control server of this test in the same state directory.
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
Ran server(Words words) { return run(TANDEM_SERVER, std::move(words)); }
Ran client(Words words) { return run(TANDEM_CLIENT, std::move(words)); }

std::string line(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(AuthCommands, SetUpAServerTwoWorkstationsAndATicket) {
  ControlServerFixture door;
  door.wall = auth::wall_seconds();  // the commands read the real clock
  const std::string state = door.folder.path("server"), address = io::to_text(door.address);
  for (const std::string name : {"touch-07", "touch-08"}) {
    const Ran given = server({"enroll", name, "--address", address, "--state", state});
    ASSERT_EQ(given.code, 0) << given.err;
    const Ran taken = client({"enroll", line(given.out), "--state", door.folder.path(name)});
    ASSERT_EQ(taken.code, 0) << taken.err;
    EXPECT_EQ(taken.out, "enrolled at " + address + " as " + name + "\n");
    const Ran again = client({"enroll", line(given.out), "--state", door.folder.path(name)});
    EXPECT_EQ(again.code, 1) << "a string is valid once";
    EXPECT_NE(again.err.find("refused: this code is not valid"), std::string::npos) << again.err;
  }
  const std::string id = auth::to_hex(door.sessions->session_id);
  const Ran made = server({"ticket", "--session", id, "--seat", "trainee", "--role", "trainee", "--workstation",
                           "touch-07", "--state", state});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto ticket = auth::ticket_from_text(line(made.out));
  ASSERT_TRUE(ticket) << ticket.error();
  const auto join = [&](const std::string& name) {
    door.wall = auth::wall_seconds();
    const auto own = auth::ClientKeystore::open(door.folder.path(name));
    EXPECT_TRUE(own && *own);
    auto connected = door.connect((*own)->identity());
    return connected ? connected->ask(hello_with(*ticket), kTimeout) : std::unexpected(connected.error());
  };
  EXPECT_EQ(reason_of(join("touch-08")), rpc::ErrorCode::kTicket);
  const auto joined = join("touch-07");
  ASSERT_TRUE(joined) << joined.error().text;
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*joined));

  const Ran gone = server({"revoke", "touch-07", "--state", state});
  EXPECT_EQ(gone.code, 0) << gone.err;
  EXPECT_EQ(reason_of(join("touch-07")), rpc::ErrorCode::kNotEnrolled);
  EXPECT_EQ(server({"ticket", "--session", id, "--seat", "trainee", "--role", "trainee", "--workstation", "touch-07",
                    "--state", state})
                .code,
            2);
  const std::string audit = door.folder.read("server/audit.log");
  for (const char* word : {"code_given_out", "enrolled", "\"ticket\"", "revoked", "touch-08"})
    EXPECT_NE(audit.find(word), std::string::npos) << word << "\n" << audit;
  EXPECT_EQ(audit.find(line(made.out).substr(7, 20)), std::string::npos) << "the ticket itself is in no log";
}

TEST(AuthCommands, KnowTheRunningServersAddressSessionsAndSeats) {
  ControlServerFixture door;
  const std::string state = door.folder.path("server");
  const ServingSpec serving{"lab:7000",
                            {{door.sessions->session_id,
                              "ABCDE12345",
                              "contact",
                              3,
                              {{"trainer", AccessRole::kInstructor}, {"trainee", AccessRole::kTrainee}}}}};
  // The control server holds the serving lock and publishes its sessions and seats in a file.
  ASSERT_EQ(auth::StateDirectory::open(state, auth::StateDirectory::Missing::kIsAnError)
                ->replace("serving.textproto", std::string_view(print_serving(serving))),
            "");
  const Ran given = server({"enroll", "a", "--state", state});
  ASSERT_EQ(given.code, 0) << given.err;
  EXPECT_EQ(auth::EnrolmentString::from_text(line(given.out))->address, "lab:7000");
  const Ran none = server({"revoke", "w", "--state", state});
  EXPECT_NE(none.err.find("`tandem-server enroll --state " + state + " w --address HOST:PORT`"), std::string::npos)
      << none.err;
  (void)door.enrolled("w", auth::wall_seconds());
  for (const std::string session : {"contact", "ABCDE12345", "abcde-12345"}) {
    const Ran made =
        server({"ticket", "--session", session, "--seat", "trainer", "--workstation", "w", "--state", state});
    ASSERT_EQ(made.code, 0) << session << made.err;
    EXPECT_EQ(auth::claimed_role(*auth::ticket_from_text(line(made.out))), AccessRole::kInstructor)
        << "the seat's role, instructor";
  }
  (void)door.enrolled("ahead", auth::wall_seconds() + 3600);
  const Ran ahead =
      server({"ticket", "--session", "contact", "--seat", "trainer", "--workstation", "ahead", "--state", state});
  EXPECT_EQ(ahead.code, 2);
  EXPECT_NE(ahead.err.find(" s later than now"), std::string::npos) << ahead.err;
  EXPECT_NE(ahead.err.find("`tandem-server revoke ahead`"), std::string::npos) << ahead.err;
  const Ran wrong = server(
      {"ticket", "--session", "contakt", "--seat", "trainer", "--workstation", "v", "--hours", "13", "--state", state});
  EXPECT_EQ(wrong.code, 2);
  for (const char* word : {"--hours", "did you mean contact", "no workstation is called \"v\"", "3 mistakes"})
    EXPECT_NE(wrong.err.find(word), std::string::npos) << word << wrong.err;
  EXPECT_EQ(server({"ticket", "--session", "contact", "--seat", "trainee", "--role", "instructor", "--workstation", "w",
                    "--state", state})
                .code,
            2)
      << "the seat is a trainee's";
  EXPECT_EQ(server({"ticket", "--session", "contact", "--seat", "nosuch", "--workstation", "w", "--state", state}).code,
            2);
}

TEST(AuthCommands, RequireInitExactlyOnce) {
  const Folder folder;
  const std::string state = folder.path("s");
  for (const Words& words : {Words{"enroll", "a", "--address", "h:1"}, Words{"revoke", "a"},
                             Words{"ticket", "--session", "x", "--seat", "y", "--workstation", "z"}}) {
    Words with = words;
    with.insert(with.end(), {"--state", state});
    const Ran ran = server(with);
    EXPECT_EQ(ran.code, 1) << words[0];
    EXPECT_NE(ran.err.find("tandem-server init"), std::string::npos) << ran.err;
  }
  const Ran first = server({"init", "--state", state});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find(auth::ServerKeystore::open(state)->identity().fingerprint().hex()), std::string::npos);
  const Ran second = server({"init", "--state", state});
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.err.find("exists already"), std::string::npos) << second.err;
}

TEST(AuthCommands, ReportAllMistakesInTheArguments) {
  const Folder folder;
  ASSERT_EQ(server({"init", "--state", folder.path("s")}).code, 0);
  const Ran given = server({"enroll", "a b", "--address", "nowhere", "--hours", "nan", "--state", folder.path("s")});
  EXPECT_EQ(given.code, 2);
  for (const char* word : {"NAME", "--address", "--hours", "3 mistakes"})
    EXPECT_NE(given.err.find(word), std::string::npos) << word << given.err;
  EXPECT_EQ(server({"enroll", "a", "--address", "0.0.0.0:7000", "--state", folder.path("s")}).code, 2);
  EXPECT_EQ(server({"enroll", "a", "--state", folder.path("s")}).code, 2)
      << "no server runs that could tell its address";
  const Ran unknown = server({"revoke", "a", "--state", folder.path("s")});
  EXPECT_EQ(unknown.code, 2);
  const Ran typed = client({"enroll", "tandem:0000", "--timeout", "-1", "--state", folder.path("c")});
  EXPECT_EQ(typed.code, 2);
  for (const char* word : {"STRING", "--timeout", "2 mistakes"})
    EXPECT_NE(typed.err.find(word), std::string::npos) << word << typed.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("c"))) << "nothing was done";
}

TEST(AuthCommands, SendNothingToAServerWithAnotherKey) {
  ControlServerFixture door;
  auth::EnrolmentString wrong{io::to_text(door.address), auth::KeyFingerprint{auth::test::counting<32>(1)},
                              auth::test::secret_from<16>(1)};
  const Ran ran = client({"enroll", wrong.to_text(), "--state", door.folder.path("c")});
  EXPECT_EQ(ran.code, 1);
  EXPECT_NE(ran.err.find("another key than the string names, so nothing was sent to it"), std::string::npos) << ran.err;
  EXPECT_TRUE(door.told(ControlEvent::kHandshakeFailed));
  EXPECT_EQ(ran.err.find(wrong.to_text().substr(60, 20)), std::string::npos) << "the string is in no message";
}

TEST(AuthCommands, RejectAFolderReadableByOthersAndNameTheRemedy) {
  const Folder folder;
  ASSERT_EQ(server({"init", "--state", folder.path("s")}).code, 0);
  std::filesystem::permissions(folder.path("s/ticket_key"), std::filesystem::perms(0644));
  const Ran ran = server({"revoke", "a", "--state", folder.path("s")});
  EXPECT_EQ(ran.code, 1);
  EXPECT_NE(ran.err.find("chmod 0600"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace tandem::server::test
