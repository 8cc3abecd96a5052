#include <chrono>
#include <cstdio>
#include <string>
#include <variant>

#include "client/app/commands/connection_options.h"
#include "client/app/join_client.h"
#include "common/auth/io/control_client.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/log.h"
#include "common/io/print.h"
#include "common/io/process_hardening.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "server/console/app/status_source.h"
#include "server/console/app/web_server.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

namespace tandem::console {
namespace {

struct Arguments {
  client::ConnectionArguments connection{.ticket = {}, .server = "127.0.0.1:7000", .session = {}, .state = {}};
  std::string listen = "127.0.0.1:7080", role = "instructor";
};

int complain(const std::string& text) {
  io::print(stderr, "tandem-console: " + text + "\n");
  return io::kExitTrouble;
}

int run(const Arguments& arguments) {
  io::UsageErrors errors;
  client::JoinOptions options = client::connection_of(arguments.connection, errors);
  options.timeout = client::timeout_of(arguments.connection.timeout, errors);
  options.ticket = client::ticket_of(arguments.connection.ticket, errors);
  options.console = access_role_named(arguments.role);
  const auto listen = io::parse_address(arguments.listen, 0);
  if (!listen) {
    errors.add("--listen", listen.error());
  } else if (!listen->loopback()) {
    errors.add("--listen: " + arguments.listen +
               " is reachable by other computers, which needs TLS; this release listens on 127.0.0.1 or [::1] only");
  }
  if (!errors.empty()) return errors.print("tandem-console: ");
  const io::Fd signals = io::make_signalfd();
  options.signals = signals.get();
  auto console = client::join_console(options);
  if (!console) return complain(console.error().reason);
  auto answer = console->connection->ask(rpc::StatusRequest{console->welcome.session_id},
                                         std::chrono::duration_cast<std::chrono::milliseconds>(options.timeout));
  if (!answer) return complain(answer.error().text);
  auto* status = std::get_if<rpc::Status>(&*answer);
  if (status == nullptr) return complain("the server gave no status of the session; use the same release on both");
  StatusSource source(options, std::move(*console), std::move(*status));
  const auto served = run_web_server({*listen, signals.get(), TANDEM_VERSION}, source, [](const std::string& url) {
    std::printf("open within 10 minutes, once: %s\n", url.c_str());
    std::fflush(stdout);
  });
  return served ? io::kExitDone : complain(served.error());
}

}  // namespace
}  // namespace tandem::console

int main(int argc, char** argv) {
  using namespace tandem;
  io::harden_process();
  console::Arguments arguments;
  io::Program program("tandem-console", TANDEM_VERSION,
                      "tandem-console shows a session of tandem-server in a browser and takes the orders of a lesson.",
                      [&arguments] { return console::run(arguments); });
  const io::Command root = program.root();
  root.add_option("--server", arguments.connection.server, "address of the server; default 127.0.0.1:7000")
      .value_name("HOST:PORT");
  client::add_session_option(root, arguments.connection);
  client::add_ticket_options(root, arguments.connection.ticket, "ticket printed by `tandem-server ticket`");
  root.add_option("--role", arguments.role, "without a ticket; default instructor")
      .check(io::one_of({"instructor", "operator", "recorder"}));
  root.add_option("--listen", arguments.listen,
                  "loopback address of the page; port 0: a free one; default 127.0.0.1:7080")
      .value_name("HOST:PORT");
  client::add_state_option(root, arguments.connection.state);
  client::add_timeout_option(root, arguments.connection.timeout);
  root.footer(
      "Exit: 0 ended by a signal; 1 refused, server not reachable, or port in use; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-console --server 127.0.0.1:7000\n"
      "  tandem-console --server lab-server:7000 --ticket-file operator.ticket --listen 127.0.0.1:0");
  io::log_to_stderr("tandem-console");
  return program.run({argv + 1, argv + argc});
}
