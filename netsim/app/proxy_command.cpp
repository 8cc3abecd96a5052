#include <unistd.h>

#include <cstdio>
#include <expected>
#include <optional>
#include <string>
#include <thread>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/event_fd.h"
#include "common/io/exit_code.h"
#include "common/io/fd.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/realtime.h"
#include "common/io/socket_address.h"
#include "common/io/tcp_listener.h"
#include "common/io/usage_errors.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/proxy/app/control_socket.h"
#include "netsim/proxy/app/decision_writer.h"
#include "netsim/proxy/app/proxy.h"
#include "netsim/proxy/app/proxy_control.h"
#include "netsim/proxy/app/proxy_control_loop.h"
#include "netsim/proxy/app/proxy_report.h"
#include "netsim/proxy/app/tcp_relay.h"

namespace tandem::netsim {
namespace {

constexpr int kPriority = 50;
constexpr int kPortsTried = 20;  // attempts to find a port that is free for UDP and TCP

struct ProxyArguments {
  std::string listen = "127.0.0.1:0";
  std::string to;
  NetworkOptions network;
  double duration_s = 0;
  double lateness_max_us = 0, spin_us = 0, coalesce_us = 80;
  bool realtime = false;
  std::string control, log, json;
};

Duration microseconds(double us) { return from_seconds(us * 1e-6); }

int trouble(const std::string& message) {
  io::print_formatted(stderr, "tandem-netsim proxy: %s\n", message.c_str());
  return io::kExitTrouble;
}

int proxy_usage_error(const std::string& message) { return io::report_usage_error("tandem-netsim proxy", message); }

/// Returns the function that finds a network named while the proxy runs.
ProxyControl::FindNetwork find_network(const NetworkOptions& networks) {
  return [&networks](const std::string& name) -> std::expected<ProxyControl::Network, std::string> {
    auto choice = networks.named(name);
    if (!choice) return std::unexpected(choice.error());
    return ProxyControl::Network{std::move(choice->link), std::move(choice->notes)};
  };
}

/// Requests real-time scheduling, locked memory and low CPU latency for the packet thread. `notice` names what the
/// system rejected.
void ask_for_machine(bool realtime, std::string& notice) {
  if (!realtime) return;
  static const io::CpuLatencyRequest awake;  // for the lifetime of the program
  const bool memory = io::lock_memory();
  const bool fifo = io::request_realtime(kPriority);
  notice = io::realtime_warning(fifo, memory, awake.granted());
}

/// Parses a local address; only loopback addresses are allowed.
std::expected<io::SocketAddress, std::string> own_address(const std::string& option, const std::string& text,
                                                          std::uint16_t port_min) {
  const auto address = io::parse_address(text, port_min);
  if (!address) return std::unexpected(option + ": " + address.error());
  if (address->loopback()) return *address;
  return std::unexpected(
      option + ": " + io::to_text(*address) +
      " is not a loopback address and is refused: until sealed sessions exist the keys of Tandem are public, and a "
      "proxy that others can reach would let them take a seat and move a device. Use 127.0.0.1:PORT or [::1]:PORT");
}

int proxy_command(const ProxyArguments& arguments) {
  io::UsageErrors mistakes;
  const auto listen = own_address("--listen", arguments.listen, 0);
  const auto to = own_address("--to", arguments.to, 1);
  for (const auto* address : {&listen, &to})
    if (!*address) mistakes.add(address->error());
  if (listen && to && io::PeerKey::of(listen->storage) == io::PeerKey::of(to->storage))
    mistakes.add("--to is the proxy itself (--listen)");
  auto network = arguments.network.resolve();
  if (!network) mistakes.add(network.error());
  auto script = arguments.network.events();
  if (!script) mistakes.add(script.error());
  if (network && script) {
    mistakes.add(sharing_problem(network->link, script->events));
    add_notes(network->notes, script->notes);
  }
  // The check happens here, the file is opened at the first output. A run that never starts leaves an older file
  // unchanged.
  mistakes.output_file("--json", arguments.json);
  if (arguments.log == "-") mistakes.add("--log needs a file");
  mistakes.output_file("--log", arguments.log);
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim proxy");

  DecisionWriter log;
  ProxyOptions options;
  options.listen = *listen;
  options.to = *to;
  options.link = network->link;
  options.events = std::move(script->events);
  options.seed = arguments.network.seed();
  options.duration = from_seconds(arguments.duration_s);
  options.spin = microseconds(arguments.spin_us);
  options.coalesce = microseconds(arguments.coalesce_us);
  if (arguments.lateness_max_us > 0) options.late_limit = microseconds(arguments.lateness_max_us);
  options.sink = arguments.log.empty() ? nullptr : &log;
  const SignalWatcher interruption;
  const io::EventFd finished;
  auto proxy = Proxy::open(options);
  if (!proxy) return trouble(proxy.error());
  auto joining = io::listen_tcp((*proxy)->listening());
  for (int attempt = 0; !joining && options.listen.port() == 0 && attempt < kPortsTried; ++attempt) {
    proxy = Proxy::open(options);
    if (!proxy) return trouble(proxy.error());
    joining = io::listen_tcp((*proxy)->listening());
  }
  ControlSocket socket;
  if (!arguments.control.empty()) {
    if (const std::string problem = socket.open(arguments.control); !problem.empty())
      return proxy_usage_error("--control: " + problem);
  }
  if (const std::string problem = log.open(arguments.log); !problem.empty()) return trouble("--log: " + problem);

  // Scripts wait for this line. It goes to standard error if standard output receives JSON.
  std::FILE* const people = arguments.json == "-" ? stderr : stdout;
  io::print_formatted(people, "listening on %s\n", io::to_text((*proxy)->listening()).c_str());
  io::print_formatted(people, "to %s, %s, seed %llu; Ctrl-C ends\n", io::to_text(options.to).c_str(),
                      network->description.c_str(), static_cast<unsigned long long>(options.seed));
  for (const std::string& note : network->notes) io::print_formatted(people, "note: %s\n", note.c_str());
  if (!joining)
    io::print_formatted(
        people, "note: no client can join a Tandem session through this proxy, which forwards datagrams only: %s\n",
        joining.error().c_str());
  std::fflush(people);

  std::optional<TcpRelay> relay;
  if (joining) relay.emplace(std::move(*joining), options.to);
  std::thread packets([&] {
    std::string notice;
    ask_for_machine(arguments.realtime, notice);
    if (!notice.empty()) io::print_formatted(stderr, "tandem-netsim proxy: %s\n", notice.c_str());
    (*proxy)->run();
    finished.signal();
  });
  ProxyControl control{**proxy, options.link, find_network(arguments.network)};
  run_control_loop(**proxy, control, socket, interruption.fd(), finished.get());
  packets.join();
  log.stop();
  (*proxy)->log_in_flight();
  const std::string log_problem = log.close();

  const std::vector<ProxyClientQuality> qualities = (*proxy)->qualities();
  ProxyReportNotes notes{
      .qualities = qualities, .changes = control.changes(), .log_rows = log.written(), .log_missed = log.missed()};
  const ProxyStatus status = (*proxy)->final_status();
  const std::vector<ProxyEvent> played =
      proxy_events(options, (*proxy)->client_reports(), status.clients_seen, status.since_start);
  notes.events = played;
  notes.interrupted =
      interruption.signalled() && options.duration > Duration::zero() && status.since_start < options.duration;
  if (arguments.lateness_max_us > 0) notes.lateness_max = microseconds(arguments.lateness_max_us);
  io::print(people, summary_text(**proxy, notes));
  std::fflush(people);
  if (notes.interrupted)
    SignalWatcher::report("proxy", format("%.3f of %g s", seconds(status.since_start), arguments.duration_s));
  io::OutputFile json;
  std::string problem = json.open(arguments.json, true);
  if (json.is_open()) json.write(summary_json(**proxy, options, *network, notes));
  if (problem.empty()) problem = json.close();
  if (!problem.empty()) return trouble("--json: " + problem);
  if (!log_problem.empty()) return trouble("--log: " + log_problem);
  return !notes.interrupted && in_time(**proxy, notes) ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_proxy_command(const io::Command& root) {
  // The options of the program refer to it; it lives as long as they do.
  const auto [command, arguments] =
      root.add_command("proxy", "Plays a network between live UDP clients and a server.", proxy_command);
  command
      .add_option("--listen", arguments.listen, "where clients send to; port 0 takes a free one; default 127.0.0.1:0")
      .value_name("HOST:PORT");
  command.add_option("--to", arguments.to, "the server").value_name("HOST:PORT").required();
  arguments.network.add_to(command);
  command.add_option("--duration", arguments.duration_s, "ends after so many seconds; default: at Ctrl-C")
      .check(io::number_in(0.001, 3e6, "s"))
      .value_name("S");
  command
      .add_option("--json", arguments.json,
                  "writes the summary as JSON; `-`: to standard output, and everything else to standard error")
      .value_name("FILE|-");
  command
      .add_option(
          "--control", arguments.control,
          "a socket for `tandem-netsim control PATH ...`, which changes the network while it runs; only you may "
          "use it")
      .value_name("PATH");
  command
      .add_option("--log", arguments.log,
                  "writes every decision as CSV: arrival time, verdict, scheduled departure; the real departure is "
                  "later by the lateness of the proxy, which the report shows")
      .value_name("FILE");
  const std::string timing = "How exact";
  command
      .add_option("--max-lateness", arguments.lateness_max_us,
                  "exit code 1 when the 99th percentile of the proxy's own lateness is above so many microseconds; "
                  "counted from the moment each datagram was due by the kernel's time of its arrival")
      .check(io::number_in(1, 1e7, "us"))
      .value_name("US")
      .group(timing);
  command
      .add_option("--coalesce", arguments.coalesce_us,
                  "datagrams due less than so many microseconds after others left may leave together, so late at most: "
                  "saves wake-ups when there are many clients; default 80, 0: each at its own moment")
      .check(io::number_in(0, 1000, "us"))
      .value_name("US")
      .group(timing);
  command
      .add_option("--spin", arguments.spin_us,
                  "watches the clock instead of sleeping for the last so many microseconds before a datagram is due; "
                  "costs up to a whole core; default 0")
      .check(io::number_in(0, 1000, "us"))
      .value_name("US")
      .group(timing);
  command
      .add_flag("--realtime", arguments.realtime,
                "asks for real-time priority, locked memory and a processor that stays awake; reports each one that "
                "was not granted")
      .group(timing);
  command.footer(
      "Clients send to --listen instead of the server. Each client (address and port) gets its own link and its own\n"
      "socket towards the server; up is client to server. At most 64 clients; a client silent for 60 s is removed,\n"
      "and one that sends from another port of its host after 2 s of silence has reconnected: it keeps its number.\n"
      "Datagrams above 1500 bytes are dropped and counted. Prints `listening on HOST:PORT` first. On a terminal it "
      "shows\n"
      "each client's rate, delay and loss, and takes commands (`tandem-netsim control --help` lists them); elsewhere "
      "it\n"
      "prints a line every 5 s. In a --script clients are \"1\", \"2\", ... in order of arrival.\n\n"
      "Examples\n"
      "  tandem-netsim proxy --listen 127.0.0.1:7001 --to 127.0.0.1:7000 --delay 20 --jitter 5 --loss 5\n"
      "  tandem-netsim proxy --to [::1]:7000 --profile wifi-busy --seed 7 --duration 60 --json proxy.json\n"
      "  tandem-netsim proxy --to 127.0.0.1:7000 --delay 10 --outage 5,0.5,3\n"
      "  tandem-netsim proxy --to 127.0.0.1:7000 --profile 5g --control /tmp/proxy.sock --max-lateness 500\n\n"
      "Exit: 0 done, 1 trouble (port in use), later than --max-lateness, nothing sent that it could judge, or "
      "interrupted\n"
      "before --duration was over (without --duration Ctrl-C is its end), 2 wrong arguments or files.");
}

}  // namespace tandem::netsim
