#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/app/proxy_command.h"
#include "netsim/app/run_command.h"
#include "proto/nearest.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  CLI::App app{
      "tandem-netsim plays networks to control traffic: delay, jitter that keeps order, loss that comes in bursts,\n"
      "stalls, outages. The same engine sits in front of live UDP (`proxy`) and runs whole sessions in virtual time;\n"
      "the same seed gives the same network.",
      "tandem-netsim"};
  app.set_version_flag("--version", "tandem-netsim " TANDEM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "`tandem-netsim COMMAND --help` tells more. Exit: 0 done, 1 trouble while running, 2 wrong arguments or files.");

  std::function<int()> action;
  tandem::netsim::add_run_command(app, action);
  tandem::netsim::add_proxy_command(app, action);
  tandem::netsim::add_profiles_command(app, action);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 does not say which word it did not know when a command is missing.
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (!word.empty() && !word.starts_with('-') && app.get_subcommands().empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      std::fprintf(stderr, "tandem-netsim: no command is called \"%s\"; %s\n", argv[1],
                   tandem::suggest(word, known).c_str());
      return 2;
    }
    // Help and version are ends, not mistakes; every mistake in arguments is 2, whatever CLI11 calls it.
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return action();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tandem-netsim: %s\n", error.what());
    return 1;
  }
}
