#include "client/app/commands/client_commands.h"
#include "common/io/command_line.h"
#include "common/io/log.h"
#include "common/io/process_hardening.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  tandem::io::harden_process();
  tandem::io::Program program(
      "tandem-client", TANDEM_VERSION,
      "tandem-client attaches a haptic device to a session of tandem-server: your hand and the hands of others hold "
      "the same\n"
      "tool. The force that reaches your hand is limited here, whatever the network or the server does.");
  const tandem::io::Command root = program.root();
  root.footer(
      "`tandem-client try --help`, `join --help`, `doctor --help`, `link-test --help`, `control --help`, `watch "
      "--help`, `record --help` and "
      "`calibrate --help` show more.\n"
      "Exit: 0 done, 1 trouble while running, 2 wrong arguments or files. Not a medical device.");

  tandem::client::add_try_command(root);
  tandem::client::add_join_command(root);
  tandem::client::add_doctor_command(root);
  tandem::client::add_link_test_command(root);
  tandem::client::add_calibrate_command(root);
  tandem::client::add_enroll_command(root);
  tandem::client::add_sessions_command(root);
  tandem::client::add_control_command(root);
  tandem::client::add_watch_command(root);
  tandem::client::add_record_command(root);
  tandem::io::log_to_stderr("tandem-client");
  return program.run({argv + 1, argv + argc});
}
