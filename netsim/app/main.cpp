#include <CLI/CLI.hpp>
#include <functional>

#include "common/io/program.h"
#include "netsim/app/feel_command.h"
#include "netsim/app/proxy_command.h"
#include "netsim/app/run_command.h"
#include "netsim/app/swarm_command.h"
#include "netsim/app/sweep_command.h"
#include "netsim/app/test_command.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  CLI::App app{
      "tandem-netsim applies simulated networks to control traffic: delay, jitter that keeps order, loss that comes in "
      "bursts,\n"
      "stalls, outages. The same engine runs in front of live UDP (`proxy`) and runs whole sessions in virtual time;\n"
      "the same seed gives the same network.",
      "tandem-netsim"};
  app.set_version_flag("--version", "tandem-netsim " TANDEM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "`tandem-netsim COMMAND --help` shows the options. Exit: 0 done, 1 trouble while running or interrupted,\n2 "
      "wrong "
      "arguments or files.");

  std::function<int()> action;
  tandem::netsim::add_run_command(app, action);
  tandem::netsim::add_test_command(app, action);
  tandem::netsim::add_sweep_command(app, action);
  tandem::netsim::add_feel_command(app, action);
  tandem::netsim::add_proxy_command(app, action);
  tandem::netsim::add_control_command(app, action);
  tandem::netsim::add_profiles_command(app, action);
  tandem::netsim::add_swarm_command(app, action);
  return tandem::io::run_program(app, action, argc, argv);
}
