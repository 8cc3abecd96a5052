#include "common/io/command_line.h"
#include "netsim/app/netsim_commands.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  tandem::io::Program program(
      "tandem-netsim", TANDEM_VERSION,
      "tandem-netsim applies simulated networks to control traffic: delay, jitter that keeps order, loss that comes in "
      "bursts,\n"
      "stalls, outages. The same engine runs in front of live UDP (`proxy`) and runs whole sessions in virtual time;\n"
      "the same seed gives the same network.");
  const tandem::io::Command root = program.root();
  root.footer(
      "`tandem-netsim COMMAND --help` shows the options. Exit: 0 done, 1 trouble while running or interrupted,\n2 "
      "wrong "
      "arguments or files.");

  tandem::netsim::add_run_command(root);
  tandem::netsim::add_test_command(root);
  tandem::netsim::add_sweep_command(root);
  tandem::netsim::add_feel_command(root);
  tandem::netsim::add_tradeoff_command(root);
  tandem::netsim::add_proxy_command(root);
  tandem::netsim::add_control_command(root);
  tandem::netsim::add_profiles_command(root);
  tandem::netsim::add_swarm_command(root);
  tandem::netsim::add_trace_command(root);
  return program.run({argv + 1, argv + argc});
}
