#pragma once

#include <optional>
#include <string>

#include "client/app/commands/ticket_option.h"
#include "common/io/socket_address.h"
#include "common/io/usage_errors.h"

/// Options shared by the commands that connect to a server.
namespace tandem::client {

/// Returns the address given as `--server`; nullopt, and adds an error, if it is invalid.
[[nodiscard]] inline std::optional<io::SocketAddress> server_option(const std::string& text, io::UsageErrors& errors) {
  const auto server = io::parse_address(text, 1);
  if (server) return *server;
  errors.add("--server", server.error());
  return std::nullopt;
}

/// Adds `--session`, the ticket options and `--state`. @param ticket  null: no ticket options
inline void add_joining_options(const io::Command& command, std::string& session, TicketOption* ticket,
                                std::string& state) {
  command.add_option("--session", session, "name, code or id of the session; default: the only one there")
      .value_name("NAME|CODE|ID");
  if (ticket != nullptr)
    add_ticket_options(command, *ticket,
                       "ticket that `tandem-server ticket` printed for this workstation; not needed with a session's "
                       "code, or with a loopback server with ephemeral keys");
  command
      .add_option("--state", state,
                  "folder of this workstation's key; default: $TANDEM_CLIENT_STATE, else ~/.config/tandem")
      .value_name("DIR");
}

}  // namespace tandem::client
