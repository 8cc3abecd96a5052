#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "client/app/commands/connection_options.h"
#include "client/app/join_client.h"
#include "client/app/trial_programs.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/log.h"
#include "common/io/print.h"
#include "common/io/process_hardening.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "proto/io/scene_file.h"
#include "server/console/app/server_link.h"
#include "server/console/app/tls_files.h"
#include "server/console/app/web_server.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

namespace tandem::console {
namespace {

constexpr const char* kPlayScene = "lesson";
constexpr double kPlaySeconds = 86400;

struct Arguments {
  client::ConnectionArguments connection{.ticket = {}, .server = "127.0.0.1:7000", .session = {}, .state = {}};
  std::string listen = "127.0.0.1:7080", role = "instructor", certificate, key;
  bool sign_in = false, seats = false, play = false;
};

int complain(const std::string& text) {
  io::print(stderr, "tandem-console: " + text + "\n");
  return io::kExitTrouble;
}

/// Certificate and key as given; nothing, and perhaps an error, without them.
std::optional<TlsFiles> tls_of(const Arguments& arguments, const io::SocketAddress& listen, io::UsageErrors& errors) {
  if (arguments.certificate.empty() != arguments.key.empty()) {
    errors.add("--certificate and --key belong together; the other one is missing");
    return std::nullopt;
  }
  if (arguments.certificate.empty()) {
    if (!listen.loopback())
      errors.add("--listen: " + arguments.listen +
                 " is reachable by other computers, which needs TLS; give --certificate FILE and --key FILE, or "
                 "listen on 127.0.0.1 or [::1]");
    return std::nullopt;
  }
  auto files = TlsFiles::load(arguments.certificate, arguments.key);
  if (files) return std::move(*files);
  errors.add(files.error());
  return std::nullopt;
}

void print_url(const std::string& url, const std::string& token) {
  if (token.empty()) {
    std::printf("sign in with a ticket: %sjoin\n", url.c_str());
  } else {
    std::printf("open within 10 minutes, once: %s?token=%s\n", url.c_str(), token.c_str());
    std::printf("for another URL restart this program; persons with a ticket sign in at %sjoin\n", url.c_str());
  }
  std::fflush(stdout);
}

int run(const Arguments& arguments) {
  io::UsageErrors errors;
  client::JoinOptions options = client::connection_of(arguments.connection, errors);
  options.timeout = client::timeout_of(arguments.connection.timeout, errors);
  options.ticket = client::ticket_of(arguments.connection.ticket, errors);
  options.console = access_role_named(arguments.role);
  if (arguments.play && (arguments.sign_in || !options.ticket.empty()))
    errors.add("--play: it starts a server of its own; leave out --sign-in and the ticket");
  if (arguments.sign_in && !options.ticket.empty())
    errors.add("--sign-in: without a connection of its own, the gateway needs no ticket");
  const auto listen = io::parse_address(arguments.listen, 0);
  if (!listen) errors.add("--listen", listen.error());
  std::optional<TlsFiles> tls;
  if (listen) tls = tls_of(arguments, *listen, errors);
  if (!errors.empty()) return errors.print("tandem-console: ");
  const io::Fd signals = io::make_signalfd();
  options.signals = signals.get();
  std::optional<client::TrialPrograms> trial;
  std::string seat;
  if (arguments.play) {
    const SceneSpec scene = *load_scene(kPlayScene);
    const SeatSpec& yours = **client::seat_for_person(scene, "");
    auto programs =
        client::TrialPrograms::start(kPlayScene, client::partners_of(scene, yours), kPlaySeconds, signals.get());
    if (!programs) return programs.error().empty() ? io::kExitDone : complain("--play: " + programs.error());
    options.server = *io::parse_address(programs->address(), 0);
    trial.emplace(std::move(*programs));
    seat = yours.name;
  }
  std::optional<JoinedLink> own;
  if (!arguments.sign_in) {
    auto joined = join_link(options, true);
    if (!joined) return complain(joined.error().reason);
    own = std::move(*joined);
  }
  const bool local = !arguments.sign_in && options.ticket.empty();
  const WebOptions web{.listen = *listen,
                       .tls = std::move(tls),
                       .signals = signals.get(),
                       .gateway = {.join = options,
                                   .local = local,
                                   .release = TANDEM_VERSION,
                                   .seats = arguments.seats || arguments.play,
                                   .play = seat}};
  const auto served = run_web_server(web, std::move(own), print_url);
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
      .check(io::one_of({"instructor", "evaluator", "operator", "recorder"}));
  root.add_option("--listen", arguments.listen,
                  "address of the page; port 0: a free one; default 127.0.0.1:7080. Beyond loopback it needs TLS")
      .value_name("HOST:PORT");
  root.add_option("--certificate", arguments.certificate, "TLS certificate of the page, a chain in PEM format")
      .value_name("FILE");
  root.add_option("--key", arguments.key, "private key of the certificate, in PEM format without a password")
      .value_name("FILE");
  root.add_flag("--sign-in", arguments.sign_in,
                "no connection of its own: each person signs in with a ticket, and no URL with a token is printed");
  root.add_flag("--allow-browser-seats", arguments.seats,
                "a person may take a free MASTER seat in the browser, with mouse, touch screen or gamepad");
  root.add_flag("--play", arguments.play,
                "starts a server with the scene lesson and a simulated partner; the page takes your seat");
  client::add_state_option(root, arguments.connection.state);
  client::add_timeout_option(root, arguments.connection.timeout);
  root.footer(
      "Exit: 0 ended by a signal; 1 refused, server not reachable, or port in use; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-console --server 127.0.0.1:7000\n"
      "  tandem-console --play --listen 127.0.0.1:0\n"
      "  tandem-console --server lab-server:7000 --ticket-file operator.ticket --listen 127.0.0.1:0\n"
      "  tandem-console --sign-in --listen 0.0.0.0:7443 --certificate page.pem --key page.key");
  io::log_to_stderr("tandem-console");
  return program.run({argv + 1, argv + argc});
}
