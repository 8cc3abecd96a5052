#pragma once

#include <string>

#include "client/app/commands/ticket_option.h"
#include "client/app/join_client.h"
#include "client/app/server_addresses.h"
#include "common/io/usage_errors.h"

/// Options shared by the commands that connect to a server. The help lists options in the order in which they are
/// added, so each command adds them where it needs them.
namespace tandem::client {

/// Arguments as typed. Commands without one of these options leave its default.
struct ConnectionArguments {
  TicketOption ticket;
  std::string server, session, state, timeout = "5";
};

inline void add_server_option(
    const io::Command& command, ConnectionArguments& arguments,
    const char* help =
        "required: the address that tandem-server prints as `listening on`; several servers of a "
        "service: separated by commas") {
  command.add_option("--server", arguments.server, help).value_name("HOST:PORT").required();
}

inline void add_session_option(const io::Command& command, ConnectionArguments& arguments,
                               const char* help = "name, code or id of the session; default: the only one there") {
  command.add_option("--session", arguments.session, help).value_name("NAME|CODE|ID");
}

/// Adds `--state`. @param folder  what that folder is
inline void add_state_option(const io::Command& command, std::string& state,
                             const std::string& folder = "folder of this workstation's key") {
  command.add_option("--state", state, folder + "; default: $TANDEM_CLIENT_STATE, else ~/.config/tandem")
      .value_name("DIR");
}

inline void add_timeout_option(const io::Command& command, std::string& timeout,
                               const char* help = "how long to wait for a server that does not answer [s]; default 5") {
  command.add_option("--timeout", timeout, help).value_name("S");
}

/// Returns the given timeout; 0, and adds an error, if it is invalid.
[[nodiscard]] inline Duration timeout_of(const std::string& timeout, io::UsageErrors& errors) {
  return from_seconds(errors.number("--timeout", timeout, 0.1, 3600, "s"));
}

/// Returns the given server, session and state directory. Adds an error if the server is no address.
[[nodiscard]] inline JoinOptions connection_of(const ConnectionArguments& arguments, io::UsageErrors& errors) {
  JoinOptions options{.session = arguments.session, .state = arguments.state};
  errors.add("--server", set_server_addresses(arguments.server, options));
  return options;
}

}  // namespace tandem::client
