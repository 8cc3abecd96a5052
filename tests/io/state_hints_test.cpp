// Commands that are given another state folder than the one that counts say so. Real programs on loopback.
#include <gtest/gtest.h>

#include "server/app/commands/state_option.h"
#include "tests/io/multi_client_fixture.h"

namespace tandem::test {
namespace {

TEST(StateHints, NameTheOptionWhereTheWrongFolderIsUsed) {
  const MultiClientFixture f{"session { name: \"lab\" scene: \"free_motion\" }"};
  const std::string other = f.folder.file("other");
  Process init = server({"init", "--state", other});
  ASSERT_EQ(init.wait(), 0) << init.err();
  const auto hint = [&](Process asked, const char* text) {
    EXPECT_NE(asked.wait(), 0);
    EXPECT_NE(asked.err().find(text), std::string::npos) << asked.err();
  };
  const char* const server_hint = "if it has another folder, name that with --state";
  hint(server({"sessions", "--state", other}), server_hint);
  hint(server({"stop", "--state", other}), server_hint);
  hint(server({"enroll", "desk", "--state", other}), server_hint);
  Process ticket =
      server({"ticket", "--session", "lab", "--role", "operator", "--workstation", "desk", "--state", other});
  EXPECT_EQ(ticket.wait(), 2);
  EXPECT_NE(ticket.err().find(server_hint), std::string::npos) << ticket.err();
  EXPECT_NE(ticket.err().find("if the server has another folder, name that with --state"), std::string::npos)
      << ticket.err();
  hint(Process({TANDEM_CLIENT, "sessions", "--server", f.address, "--state", f.folder.file("none")}),
       "name the folder of this workstation's keys with --state");
}

TEST(StateHints, DoNotAskToRepeatACommandThatIsDone) {
  const std::string text = tandem::server::audit_failure_text(
      "st/audit.log cannot be written: the disk is full (x); free some space there, then repeat");
  EXPECT_NE(text.find("do not repeat it"), std::string::npos) << text;
  EXPECT_EQ(text.find("then repeat"), std::string::npos) << text;
}

}  // namespace
}  // namespace tandem::test
