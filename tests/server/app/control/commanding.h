#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/app/control/session_commands.h"
#include "server/session/connection_id.h"
#include "tests/server/app/control/registry_fixture.h"

namespace tandem::server::test {

/// A session "lesson" and an operator's console at the workstation "office".
struct Commanding : RegistryFixture {
  Commanding() {
    joined.session_id = id_of(1);
    joined.session_name = "lesson";
    joined.role = AccessRole::kOperator;
    joined.server_cid = connection_id(1, 0, 0);
    EXPECT_EQ(keys.registry().enroll_without_code(office), "");
  }
  /// Executes a command. @return its reply, once it is there
  rpc::Body ask(rpc::Body command) {
    std::optional<rpc::Body> reply;
    commands.execute(joined, office, std::move(command), [&](rpc::Body body) { reply = std::move(body); });
    wait_until([&] { return reply.has_value(); });
    return reply.value_or(rpc::Body{});
  }
  /// Texts of the notices for all participants.
  [[nodiscard]] std::vector<std::string> notices() const {
    std::vector<std::string> texts;
    for (const rpc::StatusEvent& event : lesson.notices.events()) texts.push_back(event.text);
    return texts;
  }

  SessionEntry& lesson = add("lesson", 1);
  const WorkstationRow office{"office", {std::byte{7}}, 0};
  auth::ServerKeystore keys = auth::ServerKeystore::ephemeral(auth::wall_seconds());
  std::vector<std::string> messages;
  SessionCommands commands{registry, keys, [this](const std::string& line) { messages.push_back(line); }};
  rpc::Welcome joined;
};

}  // namespace tandem::server::test
