#include "netsim/app/proxy_command.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <cstdio>
#include <memory>
#include <thread>

#include "common/io/fd.h"
#include "common/io/number_option.h"
#include "common/io/output_file.h"
#include "common/io/signals.h"
#include "common/io/socket_address.h"
#include "common/io/terminal.h"
#include "netsim/app/network_options.h"
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

/// Waits for a signal or the proxy's end, and keeps a line on the terminal alive meanwhile.
void watch(Proxy& proxy, int signals, int finished) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  io::StatusLine line{!terminal};
  ProxyStatus before = proxy.status();
  pollfd fds[] = {{signals, POLLIN, 0}, {finished, POLLIN, 0}};
  while (poll(fds, 2, terminal ? 500 : -1) <= 0) {
    const ProxyStatus now = proxy.status();
    if (now.since_start <= before.since_start) continue;
    line.show(status_line(now, before));
    before = now;
  }
  line.clear();
  proxy.stop();
}

int proxy_command(const ProxyArguments& arguments) {
  const auto listen = io::parse_address(arguments.listen, 0);
  if (!listen) return wrong("--listen: " + listen.error());
  const auto to = io::parse_address(arguments.to, 1);
  if (!to) return wrong("--to: " + to.error());
  if (io::PeerKey::of(listen->storage) == io::PeerKey::of(to->storage))
    return wrong("--to is the proxy itself (--listen)");
  for (const auto& [option, address] : {std::pair{"--listen", *listen}, std::pair{"--to", *to}})
    if (!address.loopback())
      return wrong(std::string(option) + ": " + io::to_text(address) +
                   " is not a loopback address and is refused: until sealed sessions exist the keys of Tandem are public, and a "
                   "proxy that others can reach would let them take a seat and move a device. Use 127.0.0.1:PORT or [::1]:PORT");
  const auto network = arguments.network.resolve();
  if (!network) return wrong(network.error());
  const bool json_on_stdout = arguments.json == "-";
  if (!arguments.json.empty() && !json_on_stdout) {
    // Judged now, opened when there is something to write: a run that never starts leaves an older file alone.
    if (const std::string problem = io::OutputFile::problem(arguments.json); !problem.empty()) {
      return wrong("--json: " + problem);
    }
  }

  ProxyOptions options;
  options.listen = *listen;
  options.to = *to;
  options.link = network->link;
  options.seed = arguments.network.seed();
  options.duration = from_seconds(arguments.duration_s);
  const io::Fd signals = io::signals_as_file();
  const io::Fd finished{eventfd(0, EFD_CLOEXEC)};
  auto proxy = Proxy::open(options);
  if (!proxy) {
    std::fprintf(stderr, "tandem-netsim proxy: %s\n", proxy.error().c_str());
    return kTrouble;
  }
  // Scripts wait for this line; with JSON on standard output it moves out of the way.
  std::FILE* const people = json_on_stdout ? stderr : stdout;
  std::fprintf(people, "listening on %s\n", io::to_text((*proxy)->listening()).c_str());
  std::fprintf(people, "to %s, %s, seed %llu; Ctrl-C ends\n", io::to_text(options.to).c_str(),
               network->description.c_str(), static_cast<unsigned long long>(options.seed));
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
  io::OutputFile json;
  std::string problem = json.open(arguments.json, true);
  if (json.wanted()) json.write(summary_json(**proxy, options, *network));
  if (problem.empty()) problem = json.close();
  if (problem.empty()) return 0;
  std::fprintf(stderr, "tandem-netsim proxy: --json: %s\n", problem.c_str());
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
      ->check(io::number_in(0.001, 3e6, "s"))
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
