#include <poll.h>

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/app/console_follow.h"
#include "client/app/plot_json.h"
#include "client/app/plot_stream.h"
#include "client/app/session_status_poller.h"
#include "client/app/telemetry_feed.h"
#include "client/app/telemetry_text.h"
#include "common/auth/io/control_client.h"
#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLineInterval = 1s;
constexpr Duration kLostAfter = 3s;  // silence of the server that ends the watch

struct WatchArguments {
  ConnectionArguments connection;
  std::string role, plot;
  bool json = false;
  io::Command command;
};

int end_watch(const std::string& why) {
  io::print(stderr, "tandem-client watch: " + why + "\n");
  return io::kExitTrouble;
}

std::string text_of(wire::CloseReason why) {
  switch (why) {
    case wire::CloseReason::kServerReturns:
      return "the server ends, or gave the session to another server of its service";
    case wire::CloseReason::kRevoked:
    case wire::CloseReason::kRemoved:
      return "the server withdrew the right to watch; ask its operator";
    default:
      return "the session is over";
  }
}

/// How a watch ended.
struct WatchEnd {
  int code = io::kExitDone;
  std::string why{};     ///< for the person; empty: a signal ended it, or the output cannot be written
  bool follows = false;  ///< the session may be at another server of its service
};

/// Returns how the watch of this feed has ended; nullopt if it goes on.
/// @param hung_up  the server has closed the control connection
std::optional<WatchEnd> end_of(const SessionWatch& watch, bool hung_up, Time now) {
  if (const auto why = watch.closed()) {
    const bool over = *why == wire::CloseReason::kDone || *why == wire::CloseReason::kServerStops;
    return WatchEnd{over ? io::kExitDone : io::kExitTrouble, text_of(*why), *why == wire::CloseReason::kServerReturns};
  }
  if (hung_up && watch.silence(now) > 300ms)
    return WatchEnd{io::kExitTrouble,
                    "the server ended this connection: it has ended, was killed or is being restarted", true};
  if (watch.silence(now) <= kLostAfter) return std::nullopt;
  if (watch.newest()) return WatchEnd{io::kExitTrouble, "the server was lost: no datagram for 3 s", true};
  return WatchEnd{io::kExitTrouble,
                  "no datagram arrived, although the server accepted the join; a firewall may block UDP. "
                  "`tandem-client link-test` judges the link"};
}

/// Prints what the feed shows until a signal, the end of the session, or the loss of the server.
/// @param plot  nullptr: no stream to a plot program
WatchEnd show(TelemetryFeed& feed, int signals, bool json, PlotStream* plot) {
  SessionStatusPoller poller(feed.console().connection, feed.console().welcome.session_id);
  const auto stop_asking = [&poller](WatchEnd end) {
    poller.cancel();  // a server that is gone does not reply
    return end;
  };
  std::optional<rpc::StatusRecording> recording;
  Time next_line = io::monotonic_now();
  while (true) {
    pollfd files[] = {{feed.fd(), POLLIN, 0}, {signals, POLLIN, 0}, {poller.connection_fd(), POLLRDHUP, 0}};
    poll(files, 3, TelemetryFeed::kServeIntervalMs);
    const Time now = io::monotonic_now();
    const bool newer = feed.serve(now);
    if (auto status = poller.take()) recording = std::move(status->recording);
    const SessionWatch& watch = feed.watch();
    if (plot != nullptr && newer && plot->due(now))
      plot->send(now, plot_json(feed.scene(), watch, plot->timestamp(now)));
    const bool due = json ? newer : watch.newest() && now >= next_line;
    if (due) {
      if (!json) next_line = std::max(next_line + kLineInterval, now);
      const std::string line = (json ? telemetry_json : telemetry_text)(feed.scene(), watch, recording) + "\n";
      if (std::fputs(line.c_str(), stdout) < 0 || std::fflush(stdout) != 0) return stop_asking({io::kExitTrouble});
    }
    if (files[1].revents != 0) {
      feed.leave(now);
      return stop_asking({});
    }
    const bool hung_up = (files[2].revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
    if (auto end = end_of(watch, hung_up, now)) return stop_asking(std::move(*end));
  }
}

/// Shows a session, also when it goes to another server of its service. @return exit code
int show_everywhere(TelemetryFeed first, const JoinOptions& asking, bool json, PlotStream* plot) {
  std::optional<TelemetryFeed> feed(std::move(first));
  while (true) {
    const WatchEnd end = show(*feed, asking.signals, json, plot);
    const std::string session = feed->console().welcome.session_name;
    const bool follows = end.follows && feed->console().service;
    feed.reset();  // the server that has the session now admits one console by the ticket
    if (!follows) {
      if (!end.why.empty())
        end_watch(end.why + (end.follows ? ". Start again when it is back; a ticket is valid once" : ""));
      return end.code;
    }
    end_watch(end.why + ". Looks for session " + session + " at the other servers");
    auto again = follow_watched_session(asking);
    if (!again) return again.error().empty() ? io::kExitDone : end_watch(again.error());
    feed.emplace(std::move(*again));
    io::print(stderr, "tandem-client watch: has followed session " + session + " to its new server\n");
  }
}

std::optional<PlotStream> plot_stream_of(const std::string& typed, io::UsageErrors& errors) {
  const auto address = io::parse_address(typed.empty() ? PlotStream::kDefaultAddress : typed, 1);
  if (!address) {
    errors.add("--plotjuggler", address.error());
    return std::nullopt;
  }
  auto stream = PlotStream::open(*address, io::monotonic_now(), io::read_clock(CLOCK_REALTIME));
  if (!stream) {
    errors.add("--plotjuggler", stream.error());
    return std::nullopt;
  }
  return std::move(*stream);
}

int watch_command(const WatchArguments& arguments) {
  io::UsageErrors errors;
  JoinOptions asking = connection_of(arguments.connection, errors);
  asking.timeout = timeout_of(arguments.connection.timeout, errors);
  asking.watch = true;
  asking.console = AccessRole::kOperator;
  if (!arguments.role.empty()) {
    const auto role = access_role_named(arguments.role);
    if (role == AccessRole::kInstructor || role == AccessRole::kEvaluator || role == AccessRole::kOperator ||
        role == AccessRole::kRecorder) {
      asking.console = role;
    } else {
      errors.add("--role: \"" + arguments.role + "\" must be operator, instructor, evaluator or recorder");
    }
  }
  asking.ticket = ticket_of(arguments.connection.ticket, errors);
  std::optional<PlotStream> plot;
  if (arguments.command.given("--plotjuggler")) plot = plot_stream_of(arguments.plot, errors);
  if (!errors.empty()) return errors.print("tandem-client watch: ");
  const io::Fd signals = io::make_signalfd();
  asking.signals = signals.get();
  auto feed = TelemetryFeed::open(asking);
  if (!feed) return end_watch(feed.error().reason);
  if (plot)
    io::print_formatted(stderr, "tandem-client watch: JSON over UDP to %s, at most 100 datagrams per second%s\n",
                        plot->to().c_str(), plot->on_this_computer() ? "" : ", readable for everyone on that network");
  return show_everywhere(std::move(*feed), asking, arguments.json, plot ? &*plot : nullptr);
}

}  // namespace

void add_watch_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "watch", "Shows a session live without taking a seat: hands, forces, tool, authority, links.", watch_command);
  add_server_option(command, arguments.connection);
  add_session_option(command, arguments.connection,
                     "name, code or id of the session; default: the ticket's, or the only one there");
  add_ticket_options(command, arguments.connection.ticket,
                     "ticket printed by `tandem-server ticket --role observer`; not needed with a loopback server with "
                     "ephemeral keys");
  command
      .add_option("--role", arguments.role,
                  "without a ticket: operator, instructor, evaluator or recorder; default: operator. A recorder gets "
                  "every tick")
      .value_name("ROLE");
  add_state_option(command, arguments.connection.state);
  add_timeout_option(command, arguments.connection.timeout);
  command.add_flag("--json", arguments.json, "every state as one line of JSON, 60 per second");
  arguments.command = command;
  command
      .add_option(
          "--plotjuggler", arguments.plot,
          "also sends the signals as JSON over UDP to PlotJuggler, at most 100 times per second; without a value "
          "to 127.0.0.1:9870; default: off")
      .value_name("[HOST:PORT]")
      .optional_value()
      .group("Output");
  command.footer(
      "Prints one line per second until Ctrl-C or the end of the session. Eight consoles may watch a session; they "
      "disturb no hand.\n"
      "In PlotJuggler: Streaming, UDP Server, message protocol json, and use the field `timestamp`.\n"
      "Exit: 0 done; 1 refused, with the reason, or server not reachable or lost; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-client watch --server 127.0.0.1:7000\n"
      "  tandem-client watch --server lab-server:7000 --ticket-file operator.ticket --json\n"
      "  tandem-client watch --server 127.0.0.1:7000 --role recorder --plotjuggler");
}

}  // namespace tandem::client
