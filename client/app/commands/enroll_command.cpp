#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "common/auth/enrolment.h"
#include "common/auth/io/client_keystore.h"
#include "common/auth/io/control_client.h"
#include "common/auth/service_pin.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/socket_address.h"
#include "common/io/usage_errors.h"

namespace tandem::client {
namespace {

struct EnrollArguments {
  std::string text, state, timeout = "5";
};

int enroll_trouble(const std::string& what) {
  io::print_formatted(stderr, "tandem-client enroll: %s\n", what.c_str());
  return io::kExitTrouble;
}

int enrol(const auth::EnrolmentString& given, const std::vector<io::SocketAddress>& servers, const std::string& state,
          std::chrono::milliseconds timeout) {
  const io::Fd signals = io::make_signalfd();
  const auto own = auth::ClientKeystore::open_or_make(state, auth::wall_seconds());
  if (!own) return enroll_trouble(own.error());
  std::vector<std::byte> credential;
  const auto judge = [&](const auth::PresentedKey& seen) -> std::expected<const auth::Identity*, std::string> {
    credential = seen.credential;
    if (static_cast<const auth::KeyFingerprint&>(seen) == given.server) return &own->identity();
    return std::unexpected("the server at " + given.address +
                           " has another key than the string names, so nothing was sent to it. Either another machine "
                           "answers there, or the server was set up again: ask for a new string");
  };
  auto client = auth::ControlClient::connect(servers.front(), judge, timeout, signals.get());
  for (std::size_t i = 1; !client && i < servers.size() && client.error().kind == auth::ClientError::Kind::kUnreachable;
       ++i)
    client = auth::ControlClient::connect(servers[i], judge, timeout, signals.get());
  const auto failed = [](const auth::ClientError& fault) {
    return enroll_trouble(fault.kind == auth::ClientError::Kind::kInterrupted
                              ? "ended by Ctrl-C; the string may still be valid"
                              : fault.text);
  };
  if (!client) return failed(client.error());
  const auto answer = client->ask(rpc::Enroll{given.code, !credential.empty()}, timeout);
  if (!answer) return failed(answer.error());
  if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer)) return enroll_trouble("refused: " + refused->text);
  const auto* taken = std::get_if<rpc::EnrollAck>(&*answer);
  if (taken == nullptr) return enroll_trouble("unexpected reply from the server; use the same release on both");
  ServerRow row{given.address, given.server.sha256, taken->workstation};
  if (!credential.empty()) {
    if (const auto pin = auth::first_pin(credential, given.server, auth::wall_seconds())) {
      row.service = *pin;
      row.members = taken->members;
    } else {
      io::print_formatted(stderr, "tandem-client enroll: the other servers of this service are not known: %s\n",
                          pin.error().c_str());
    }
  }
  if (const std::string problem = own->store_server(row); !problem.empty())
    return enroll_trouble("enrolled as " + taken->workstation + ", but " + problem);
  std::printf("enrolled at %s as %s\n", given.address.c_str(), taken->workstation.c_str());
  return std::fflush(stdout) == 0 ? 0 : 1;
}

int enroll_command(const EnrollArguments& arguments) {
  io::UsageErrors errors;
  std::string text = arguments.text;
  if (text == "-") {
    text.clear();
    std::getline(std::cin, text);
  }
  auto given = auth::EnrolmentString::from_text(text);
  wipe(text);
  std::expected<std::vector<io::SocketAddress>, std::string> server = std::unexpected(std::string());
  if (!given) {
    errors.add("STRING: " + given.error());
  } else if (server = io::resolve_addresses(given->address, 1); !server) {
    errors.add("STRING: its server " + server.error());
  }
  const Duration timeout = timeout_of(arguments.timeout, errors);
  const auto state = auth::client_state_path(arguments.state);
  if (!state) errors.add(state.error());
  if (errors.empty())
    return enrol(*given, *server, *state, std::chrono::duration_cast<std::chrono::milliseconds>(timeout));
  return errors.report("tandem-client enroll", "nothing was sent");
}

}  // namespace

void add_enroll_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "enroll", "Registers this workstation at a server, with the string that tandem-server enroll printed there.",
      enroll_command);
  command
      .add_option("STRING", arguments.text,
                  "the whole string, which begins with `tandem:`; `-`: read from standard input, so that it appears "
                  "in no list of processes")
      .value_name(" ")
      .required();
  add_state_option(command, arguments.state);
  add_timeout_option(command, arguments.timeout, "how long to wait for the server [s]; default 5");
  command.footer(
      "Creates the workstation's key if there is none yet; it never leaves the folder. The server must run, and must "
      "have the key that the\n"
      "string names: the client sends nothing to any other server.\n"
      "Exit: 0 enrolled; 1 refused, no answer, or the folder cannot be used; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-client enroll tandem:0G6...\n"
      "  tandem-client enroll - < enrolment.txt");
}

}  // namespace tandem::client
