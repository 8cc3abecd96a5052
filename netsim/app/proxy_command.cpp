#include "netsim/app/proxy_command.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <thread>

#include "netsim/app/network_options.h"
#include "netsim/app/number_option.h"
#include "netsim/app/proxy.h"
#include "netsim/app/proxy_report.h"

namespace tandem::netsim {
namespace {

constexpr int kTrouble = 1;  // while running
constexpr int kWrong = 2;    // in arguments or files, found before anything starts

struct ProxyArguments {
  std::string listen = "127.0.0.1:0";
  std::string to;
  NetworkOptions network;
  double duration_s = 0;
  std::string json;
};

int wrong(const std::string& message) {
  std::fprintf(stderr, "tandem-netsim proxy: %s\n", message.c_str());
  return kWrong;
}

/// SIGINT and SIGTERM as something to wait for. Blocked before threads start, so that all of them leave it to us.
Fd signals_as_file() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  return Fd{signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK)};
}

/// Waits for a signal or the proxy's end, and keeps a line on the terminal alive meanwhile.
void watch(Proxy& proxy, int signals, int finished) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  ProxyStatus before = proxy.status();
  pollfd fds[] = {{signals, POLLIN, 0}, {finished, POLLIN, 0}};
  while (true) {
    const int ready = poll(fds, 2, terminal ? 500 : -1);
    if (ready > 0) break;
    const ProxyStatus now = proxy.status();
    if (now.since_start > before.since_start) {
      std::fprintf(stderr, "\r\x1b[K%s", status_line(now, before).c_str());
      std::fflush(stderr);
      before = now;
    }
  }
  if (terminal) std::fprintf(stderr, "\r\x1b[K");
  proxy.stop();
}

int proxy_command(const ProxyArguments& arguments) {
  const auto listen = parse_address(arguments.listen, 0);
  if (!listen) return wrong("--listen: " + listen.error());
  const auto to = parse_address(arguments.to, 1);
  if (!to) return wrong("--to: " + to.error());
  if (PeerKey::of(listen->storage) == PeerKey::of(to->storage)) return wrong("--to is the proxy itself (--listen)");
  const auto network = arguments.network.resolve();
  if (!network) return wrong(network.error());
  const bool json_on_stdout = arguments.json == "-";
  std::ofstream json_file;
  if (!arguments.json.empty() && !json_on_stdout) {
    json_file.open(arguments.json);
    if (!json_file) return wrong("--json: " + arguments.json + " cannot be written");
  }

  ProxyOptions options;
  options.listen = *listen;
  options.to = *to;
  options.link = network->link;
  options.seed = arguments.network.seed();
  options.duration = from_seconds(arguments.duration_s);
  const Fd signals = signals_as_file();
  const Fd finished{eventfd(0, EFD_CLOEXEC)};
  auto proxy = Proxy::open(options);
  if (!proxy) {
    std::fprintf(stderr, "tandem-netsim proxy: %s\n", proxy.error().c_str());
    return kTrouble;
  }
  // Scripts wait for this line; with JSON on standard output it moves out of the way.
  std::FILE* const people = json_on_stdout ? stderr : stdout;
  std::fprintf(people, "listening on %s\n", to_text((*proxy)->listening()).c_str());
  std::fprintf(people, "to %s, %s, seed %llu; Ctrl-C ends\n", to_text(options.to).c_str(), network->description.c_str(),
               static_cast<unsigned long long>(options.seed));
  for (const std::string& note : network->notes) std::fprintf(people, "note: %s\n", note.c_str());
  std::fflush(people);

  std::thread packets([&] {
    (*proxy)->run();
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(finished.get(), &one, sizeof one);
  });
  watch(**proxy, signals.get(), finished.get());
  packets.join();

  std::fputs(summary_text(**proxy).c_str(), people);
  std::fflush(people);
  if (arguments.json.empty()) return 0;
  const std::string json = summary_json(**proxy, options, *network);
  if (json_on_stdout) {
    std::fputs(json.c_str(), stdout);
    return std::fflush(stdout) == 0 ? 0 : kTrouble;
  }
  json_file << json;
  json_file.close();
  if (json_file) return 0;
  std::fprintf(stderr, "tandem-netsim proxy: --json: %s could not be written to the end\n", arguments.json.c_str());
  return kTrouble;
}

}  // namespace

void add_proxy_command(CLI::App& root, std::function<int()>& action) {
  // Lives as long as the program's options, which refer to it.
  const auto arguments = std::make_shared<ProxyArguments>();
  CLI::App* const command = root.add_subcommand("proxy", "Plays a network between live UDP clients and a server.");
  command
      ->add_option("--listen", arguments->listen, "where clients send to; port 0 takes a free one; default 127.0.0.1:0")
      ->option_text("HOST:PORT");
  command->add_option("--to", arguments->to, "the server")->option_text("HOST:PORT")->required();
  arguments->network.add_to(*command);
  command->add_option("--duration", arguments->duration_s, "ends after so many seconds; default: at Ctrl-C")
      ->check(number_in(0.001, 3e6, "s"))
      ->option_text("S");
  command
      ->add_option("--json", arguments->json,
                   "writes the summary as JSON; `-`: to standard output, and everything else to standard error")
      ->option_text("FILE|-");
  command->footer(
      "Clients send to --listen instead of the server. Each client (address and port) gets its own link and its own\n"
      "socket towards the server; up is client to server. At most 64 clients; a client silent for 60 s is forgotten.\n"
      "Datagrams above 1500 bytes are dropped and counted. Prints `listening on HOST:PORT` first.\n\n"
      "Examples\n"
      "  tandem-netsim proxy --listen 127.0.0.1:7001 --to 127.0.0.1:7000 --delay 20 --jitter 5 --loss 5\n"
      "  tandem-netsim proxy --to [::1]:7000 --profile wifi-busy --seed 7 --duration 60 --json proxy.json\n"
      "  tandem-netsim proxy --to 127.0.0.1:7000 --delay 10 --outage 5,0.5,3\n"
      "Exit: 0 done, 1 trouble (port in use), 2 wrong arguments or files.");
  command->callback([arguments, &action] { action = [arguments] { return proxy_command(*arguments); }; });
}

}  // namespace tandem::netsim
