#include <cstdio>
#include <string>
#include <vector>

#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/proxy/app/control_request.h"
#include "netsim/proxy/app/control_socket.h"

namespace tandem::netsim {
namespace {

struct ControlArguments {
  std::string path;
  std::vector<std::string> words;
};

int control_command(const ControlArguments& arguments) {
  std::string line;
  for (const std::string& word : arguments.words) line += (line.empty() ? "" : " ") + word;
  // The command checks the syntax here; the proxy checks whether the network or the client exists.
  if (const auto request = parse_control_request(line); !request) {
    io::print_formatted(stderr, "tandem-netsim control: %s\n", request.error().c_str());
    return 2;
  }
  const SignalWatcher interruption;
  const auto answer = send_control_request(arguments.path, line, interruption.fd());
  if (!answer) {
    io::print_formatted(stderr, "tandem-netsim control: %s\n", answer.error().c_str());
    return 1;
  }
  if (answer->empty()) {
    SignalWatcher::report("control", "the command was sent; `status --json` shows whether the proxy applied it");
    return io::kExitTrouble;
  }
  const int code = answer->front() == '0' ? 0 : answer->front() == '1' ? 1 : 2;
  std::fprintf(code == 0 ? stdout : stderr, "%s%s", code == 0 ? "" : "tandem-netsim control: ", answer->c_str() + 1);
  return code;
}

}  // namespace

void add_control_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("control", "Changes the network of a running proxy, or shows its status.", control_command);
  command.add_option("path", arguments.path, "the socket given to `proxy --control`").value_name("PATH").required();
  command.add_option("command", arguments.words, "the command; quotes around it are not needed")
      .value_name("COMMAND...")
      .required();
  command.take_rest(arguments.words);
  command.footer(std::string("Commands, also in the proxy's terminal\n") + control_help() +
                 "\nExamples\n"
                 "  tandem-netsim control /tmp/proxy.sock profile wifi-busy\n"
                 "  tandem-netsim control /tmp/proxy.sock delay 20 loss 2 client 2 up\n"
                 "  tandem-netsim control /tmp/proxy.sock outage 400ms\n"
                 "  tandem-netsim control /tmp/proxy.sock status --json\n\n"
                 "Exit: 0 done, 1 no proxy there, the command failed, or interrupted, 2 a wrong command or file.");
}

}  // namespace tandem::netsim
