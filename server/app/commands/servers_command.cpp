#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "common/io/command_line.h"
#include "common/io/usage_errors.h"
#include "proto/io/scene_file.h"
#include "proto/text/server_config_text.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"
#include "server/app/service/service_config.h"
#include "server/app/service/service_thread.h"
#include "server/directory/io/etcd_directory.h"
#include "server/service/servers_table.h"

namespace tandem::server {
namespace {

struct ServersArguments {
  std::string config;
};

constexpr Duration kDirectoryMax = std::chrono::seconds(5);
constexpr auto kDirectoryPause = std::chrono::milliseconds(5);

int servers_command(const ServersArguments& arguments) {
  const auto text = read_text_file(arguments.config);
  InputErrors errors;
  const auto config = text ? read_server_config(*text, arguments.config, errors) : std::nullopt;
  std::optional<ServiceOptions> options;
  if (config) {
    const auto folder = std::filesystem::path(arguments.config).parent_path();
    options = service_options_from(
        *config, std::nullopt, [&](const std::string& named) { return (folder / named).string(); }, errors);
    if (!config->directory)
      errors.push_back(
          {arguments.config, 0, 0, "directory", "",
           "is missing: a server of this configuration is alone; `tandem-server sessions` shows its sessions"});
  } else if (!text) {
    errors = text.error();
  }
  if (!errors.empty() || !options) {
    io::UsageErrors usage;
    usage.add(to_text(errors));
    return usage.report("tandem-server servers");
  }
  directory::EtcdDirectory directory(options->etcd);
  directory::DirectoryView view{directory::DirectoryKeys(options->prefix)};
  ServiceCatalogue catalogue{ServiceKeys(options->prefix)};
  std::string trouble = "no answer in time";
  directory::OperationId operation = 0;
  for (const Time end = ServiceThread::now() + kDirectoryMax;
       (view.readings() == 0 || catalogue.readings() == 0) && ServiceThread::now() < end;
       std::this_thread::sleep_for(kDirectoryPause)) {
    const Time now = ServiceThread::now();
    if (const auto request = view.poll_request(now, operation + 1, kDirectoryMax))
      directory.begin(++operation, *request);
    if (const auto request = catalogue.poll_request(now, operation + 1, kDirectoryMax))
      directory.begin(++operation, *request);
    while (const auto reply = directory.poll()) {
      if (!reply->reason.empty()) trouble = reply->reason;
      if (!view.on_reply(*reply)) catalogue.on_reply(*reply);
    }
  }
  if (view.readings() == 0 || catalogue.readings() == 0)
    return print_error("servers", "the directory of the service does not answer: " + trouble +
                                      "; check that etcd runs, and directory { endpoint } in " + arguments.config);
  std::fputs(servers_table(view, catalogue).c_str(), stdout);
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_servers_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("servers", "Lists the servers of a service: address, load, sessions, voucher.", servers_command);
  command.add_option("--config", arguments.config, "configuration of one of the servers, with a block `directory`")
      .value_name("FILE")
      .required();
  command.footer(
      "Asks the directory itself, so it works while no server runs. Exit: 0 done; 1 the directory does not answer; 2 "
      "wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-server servers --config /etc/tandem/server.textproto\n"
      "  tandem-server servers --config server.textproto");
}

}  // namespace tandem::server
