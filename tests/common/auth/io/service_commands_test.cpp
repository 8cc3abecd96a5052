// `tandem-server ticket` and `sessions` beside a server of a service, for sessions of its other servers.
#include <gtest/gtest.h>

#include <optional>

#include "common/auth/ticket.h"
#include "proto/text/registry_text.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/support/process.h"

namespace tandem::server::test {
namespace {

using tandem::test::Process;
using Words = std::vector<std::string>;

constexpr const char* kExamId = "0a000000000000000000000000000000";

struct Beside : ::testing::Test {
  void SetUp() override {
    state = door.folder.path("server");
    write("serving.textproto",
          print_serving({"lab:7000", {{door.sessions->session_id, "ABCDE12345", "contact", 3, {}}}}));
    (void)door.enrolled("w", auth::wall_seconds());
  }
  void write(const char* file, const std::string& text) const {
    EXPECT_EQ(auth::StateDirectory::open(state, auth::StateDirectory::Missing::kIsAnError)
                  ->replace(file, std::string_view(text)),
              "");
  }
  /// Writes the list of the service, as the running server does.
  void know(const std::string& directory, const std::string& sessions) const {
    write("service_sessions", "{\"directory\":\"" + directory + "\",\"sessions\":[" + sessions + "]}");
  }
  static std::string exam() {
    return std::string("{\"id\":\"") + kExamId +
           "\",\"name\":\"exam\",\"code\":\"ZZZZZ12345\",\"server\":\"desk-b\",\"seats\":[{\"name\":\"trainer\","
           "\"role\":"
           "\"instructor\",\"required\":true}]}";
  }
  int run(Words words) {
    words.insert(words.begin(), TANDEM_SERVER);
    words.insert(words.end(), {"--state", state});
    process.emplace(std::move(words));
    return process->wait().value_or(-1);
  }
  int ticket(const std::string& session, const std::string& seat) {
    return run({"ticket", "--session", session, "--seat", seat, "--workstation", "w"});
  }
  ControlServerFixture door;
  std::string state;
  std::optional<Process> process;
};

TEST_F(Beside, TicketsNameSessionsOfOtherServersByNameAndCode) {
  know("now", exam());
  auth::Id16 id;
  ASSERT_TRUE(auth::from_hex(kExamId, id));
  for (const char* session : {"exam", "ZZZZZ12345", "zzzzz-12345", kExamId}) {
    ASSERT_EQ(ticket(session, "trainer"), 0) << session << process->err();
    const auto made = auth::ticket_from_text(process->out().substr(0, process->out().find('\n')));
    ASSERT_TRUE(made) << session;
    EXPECT_EQ(auth::claimed_session(*made), id) << session;
    EXPECT_EQ(auth::claimed_role(*made), AccessRole::kInstructor) << session;
  }
  EXPECT_EQ(ticket("exam", "trainr"), 2);
  EXPECT_NE(process->err().find("did you mean trainer"), std::string::npos) << process->err();
}

TEST_F(Beside, UnknownSessionsAreReportedWithWhatIsKnown) {
  know("now", exam());
  EXPECT_EQ(ticket("exan", "trainer"), 2);
  EXPECT_NE(process->err().find("of the service; did you mean exam?"), std::string::npos) << process->err();
  know("nothing", "");
  EXPECT_EQ(ticket("exam", "trainer"), 2);
  EXPECT_NE(process->err().find("has not answered this server yet"), std::string::npos) << process->err();
  know("old", exam());
  EXPECT_EQ(ticket("newer", "trainer"), 2);
  EXPECT_NE(process->err().find("does not answer now"), std::string::npos) << process->err();
  write("service_sessions", "{");
  EXPECT_EQ(ticket("exam", "trainer"), 1);
  EXPECT_NE(process->err().find("service_sessions: is no list"), std::string::npos) << process->err();
}

TEST_F(Beside, SessionsShowsTheWholeServiceAndWhatTheDirectoryHasTold) {
  know("now", exam());
  ASSERT_EQ(run({"sessions"}), 0);
  for (const char* words : {"contact: ", "other sessions of the service:\nexam: code ZZZZZ-12345", "server desk-b"})
    EXPECT_NE(process->out().find(words), std::string::npos) << process->out();
  ASSERT_EQ(run({"sessions", "--json"}), 0);
  EXPECT_NE(process->out().find("\"service\": {\"directory\":\"now\",\"sessions\":[{\"code\":\"ZZZZZ12345\""),
            std::string::npos)
      << process->out();
  std::string held = exam();
  held.insert(1, "\"phase\":\"held\",");
  know("now", held);
  ASSERT_EQ(run({"sessions"}), 0);
  EXPECT_NE(process->out().find("\nexam: held, code ZZZZZ-12345"), std::string::npos) << process->out();
  write("serving.textproto", print_serving({"lab:7000", {}}));
  know("nothing", "");
  ASSERT_EQ(run({"sessions"}), 0);
  for (const char* words : {"this server serves no session now", "has not answered this server yet"})
    EXPECT_NE(process->out().find(words), std::string::npos) << process->out();
  EXPECT_EQ(process->out().find("no session is open"), std::string::npos) << process->out();
}

}  // namespace
}  // namespace tandem::server::test
