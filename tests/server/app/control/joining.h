#pragma once

#include <optional>
#include <string>
#include <utility>

#include "server/app/control/session_joins.h"
#include "tests/server/app/control/registry_fixture.h"

namespace tandem::server::test {

inline constexpr const char* kCode = "ABCDE12345";

/// A session "lesson" with a code, and a workstation "touch-07".
struct Joining : RegistryFixture {
  [[nodiscard]] static JoinRequest request(const std::string& seat, const rpc::Credential& credential = {}) {
    JoinRequest join;
    join.hello.seat = seat;
    join.hello.credential = credential;
    join.hello.client_cid = 7;
    join.hello.device = {3, 3, true, false, 0, 0, 0};
    join.workstation = {"touch-07", {std::byte{7}}, 0};
    return join;
  }
  /// Requests a join. @return its reply, once it is there
  JoinReply join(const JoinRequest& request) {
    std::optional<JoinReply> reply;
    joins.admit(request, [&](JoinReply decided) { reply = std::move(decided); });
    wait_until([&] { return reply.has_value(); });
    return reply.value_or(rpc::ErrorReply{});
  }

  /// A ticket for a console of session 1 at workstation touch-07.
  [[nodiscard]] rpc::Credential operators_ticket(const auth::Id16& id) const {
    return ticket_for(id, "", AccessRole::kOperator);
  }
  /// A ticket for session 1 at workstation touch-07. @param seat  empty: for a console
  [[nodiscard]] rpc::Credential ticket_for(const auth::Id16& id, const std::string& seat, AccessRole role) const {
    auth::Ticket ticket;
    ticket.ticket_id = id;
    ticket.session_id = id_of(1);
    ticket.seat = seat;
    ticket.role = role;
    ticket.workstation.sha256 = {std::byte{7}};
    ticket.not_before = auth::wall_seconds() - 1;
    ticket.not_after = ticket.not_before + 3600;
    const auto bytes = auth::sign_ticket(ticket, keys.ticket_key());
    EXPECT_TRUE(bytes) << bytes.error();
    return rpc::TicketCredential{{bytes->begin(), bytes->end()}};
  }

  SessionEntry& lesson = add("lesson", 1, kCode);
  auth::ServerKeystore keys = auth::ServerKeystore::ephemeral(auth::wall_seconds());
  SessionCommands commands{registry, keys};
  SessionJoins joins{registry, commands, keys};
};

}  // namespace tandem::server::test
