#include <cstdio>

#include "common/io/command_line.h"
#include "common/io/print.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/service_query.h"
#include "server/app/commands/state_option.h"
#include "server/service/servers_table.h"

namespace tandem::server {
namespace {

struct ServersArguments {
  std::string config;
};

int servers_command(const ServersArguments& arguments) {
  const auto query = ServiceQuery::open(arguments.config);
  if (!query) {
    if (query.error().code == io::kExitUsage) return print_usage_error("servers", query.error().text);
    return print_error("servers", query.error().text);
  }
  const LeaseRests rests = (*query)->lease_rests();
  std::fputs(servers_table((*query)->view(), (*query)->catalogue(), rests).c_str(), stdout);
  if ((*query)->view().servers().empty()) io::print(stdout, "this was read from " + (*query)->place() + "\n");
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_servers_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "servers", "Lists the servers of a service: address, version, load, sessions, lease, voucher.", servers_command);
  command.add_option("--config", arguments.config, "configuration of one of the servers, with a block `directory`")
      .value_name("FILE")
      .required();
  command.footer(
      "Asks the directory itself, so it works while no server runs. STANDBY: number of sessions that the server takes "
      "over. LEASE: time after\n"
      "which the server counts as lost unless it renews; each renewal begins it again. (older): another server has a "
      "newer version. Exit: 0 done; 1 the directory does not answer; 2 "
      "wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-server servers --config /etc/tandem/server.textproto\n"
      "  tandem-server servers --config server.textproto");
}

}  // namespace tandem::server
