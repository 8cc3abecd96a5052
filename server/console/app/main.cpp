#include <cstdint>
#include <cstdio>
#include <expected>
#include <filesystem>
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
#include "server/archive/app/recording_index.h"
#include "server/console/app/page_address.h"
#include "server/console/app/play_command.h"
#include "server/console/app/server_link.h"
#include "server/console/app/web_server.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

namespace tandem::console {
namespace {

constexpr const char* kDefaultServer = "127.0.0.1:7000";
constexpr const char* kPlayScene = "lesson";
constexpr double kPlaySeconds = 86400;

struct Arguments {
  client::ConnectionArguments connection{.ticket = {}, .server = {}, .session = {}, .state = {}};
  PageAddressArguments page;
  std::string role = "instructor", recordings, audience_ticket;
  double away_s = 60;
  std::uint64_t audience = 0;
  bool sign_in = false, seats = false, play = false;
};

int complain(const std::string& text) {
  io::print(stderr, "tandem-console: " + text + "\n");
  return io::kExitTrouble;
}

/// Why the folder of recordings cannot be shown; empty: it can.
std::string recordings_problem(const std::string& folder) {
  if (folder.empty()) return {};
  if (std::error_code error; !std::filesystem::is_directory(folder, error))
    return folder + " is no folder" + (error ? ": " + error.message() : std::string()) +
           "; name the folder into which tandem-server records (`run --record`, `record` in a configuration)";
  const auto index = server::RecordingIndex::open(folder);
  return index ? std::string{} : index.error();
}

void print_url(const std::string& url, const std::string& token) {
  print_page_url(url, token);
  if (token.empty()) return;
  std::printf("for another URL restart this program; persons with a ticket sign in at %sjoin\n", url.c_str());
  std::fflush(stdout);
}

/// Joins for the gateway itself, and for its audience.
std::expected<GatewayLinks, client::JoinError> join_links(const Arguments& arguments, client::JoinOptions options,
                                                          const std::string& audience_ticket) {
  GatewayLinks links;
  if (!arguments.sign_in) {
    auto own = join_link(options, true);
    if (!own) return std::unexpected(own.error());
    links.own = std::move(*own);
  }
  if (arguments.audience > 0) {
    options.ticket = audience_ticket;
    options.console = AccessRole::kObserver;
    auto audience = join_link(options, arguments.sign_in);
    if (!audience)
      return std::unexpected(client::JoinError{audience.error().interrupted, "--audience: " + audience.error().reason});
    if (const AccessRole role = audience->console.welcome.role; role != AccessRole::kObserver)
      return std::unexpected(client::JoinError{
          false, "--audience-ticket: the ticket has the role " + std::string(to_text(role)) +
                     "; the audience may only watch, so make one with `tandem-server ticket --role observer`"});
    links.audience = std::move(*audience);
  }
  return links;
}

int run(Arguments arguments) {
  io::UsageErrors errors;
  if (arguments.play && (!arguments.connection.server.empty() || !arguments.connection.session.empty()))
    errors.add("--play: it starts a server of its own; leave out --server and --session");
  if (arguments.connection.server.empty()) arguments.connection.server = kDefaultServer;
  client::JoinOptions options = client::connection_of(arguments.connection, errors);
  options.timeout = client::timeout_of(arguments.connection.timeout, errors);
  options.ticket = client::ticket_of(arguments.connection.ticket, errors);
  options.console = access_role_named(arguments.role);
  if (arguments.play && (arguments.sign_in || !options.ticket.empty()))
    errors.add("--play: it starts a server of its own; leave out --sign-in and the ticket");
  const bool local = !arguments.sign_in && options.ticket.empty();
  const std::string audience_ticket =
      client::ticket_of({.text = {}, .file = arguments.audience_ticket}, errors, "--audience-ticket");
  if (arguments.audience > 0 && !local && arguments.audience_ticket.empty())
    errors.add(
        "--audience: this gateway joins by tickets, so the audience needs one too; give it with "
        "--audience-ticket FILE");
  if (arguments.audience == 0 && !arguments.audience_ticket.empty())
    errors.add("--audience-ticket: give the size of the audience with --audience N");
  if (arguments.sign_in && !options.ticket.empty())
    errors.add("--sign-in: without a connection of its own, the gateway needs no ticket");
  PageAddress page = page_address_of(arguments.page, errors);
  errors.add("--recordings", recordings_problem(arguments.recordings));
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
  auto links = join_links(arguments, options, audience_ticket);
  if (!links) {
    const int trouble = complain(links.error().reason);
    return links.error().interrupted ? io::kExitDone : trouble;
  }
  const WebOptions web{.listen = page.listen,
                       .tls = std::move(page.tls),
                       .signals = signals.get(),
                       .gateway = {.join = options,
                                   .local = local,
                                   .release = TANDEM_VERSION,
                                   .away = from_seconds(arguments.away_s),
                                   .audience = arguments.audience,
                                   .audience_ticket = audience_ticket,
                                   .seats = arguments.seats || arguments.play,
                                   .play = seat,
                                   .recordings = arguments.recordings}};
  const auto served = run_web_server(web, std::move(*links), [&](const std::string& url, const std::string& token) {
    print_url(url, token);
    if (arguments.audience == 0) return;
    std::printf("audience of up to %llu pages, without a ticket: %swatch\n",
                static_cast<unsigned long long>(arguments.audience), url.c_str());
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
      .check(io::one_of({"instructor", "evaluator", "operator", "recorder"}));
  console::add_page_address_options(root, arguments.page);
  root.add_flag("--sign-in", arguments.sign_in,
                "no connection of its own: each person signs in with a ticket, and no URL with a token is printed");
  root.add_option("--return-within", arguments.away_s,
                  "how long the pages of a person may be closed before they need another ticket [s]; default 60")
      .value_name("S")
      .check(io::number_in(1, 3600, "s"));
  root.add_option("--audience", arguments.audience,
                  "so many further pages watch as observers, without a ticket, at the address /watch; default 0")
      .value_name("N")
      .check(io::whole_number_in(0, 500));
  root.add_option("--audience-ticket", arguments.audience_ticket,
                  "ticket of role observer for the connection of the audience, where this gateway joins by tickets")
      .value_name("FILE");
  root.add_flag("--allow-browser-seats", arguments.seats,
                "a person may take a free MASTER seat in the browser, with mouse, touch screen or gamepad");
  root.add_flag("--play", arguments.play,
                "starts a server with the scene lesson and a simulated partner; the page takes your seat");
  root.add_option("--recordings", arguments.recordings,
                  "instructors, evaluators and operators play the recordings of this folder, with scores")
      .value_name("DIR");
  console::add_play_command(root);
  client::add_state_option(root, arguments.connection.state);
  client::add_timeout_option(root, arguments.connection.timeout);
  root.footer(
      "Exit: 0 ended by a signal; 1 refused, server not reachable, or port in use; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-console --server 127.0.0.1:7000\n"
      "  tandem-console --play --listen 127.0.0.1:0\n"
      "  tandem-console --server lab-server:7000 --ticket-file operator.ticket --listen 127.0.0.1:0\n"
      "  tandem-console --recordings lessons\n"
      "  tandem-console --sign-in --listen 0.0.0.0:7443 --certificate page.pem --key page.key");
  io::log_to_stderr("tandem-console");
  return program.run({argv + 1, argv + argc});
}
