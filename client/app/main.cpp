#include <CLI/CLI.hpp>
#include <functional>

#include "client/app/commands/calibrate_command.h"
#include "client/app/commands/control_command.h"
#include "client/app/commands/doctor_command.h"
#include "client/app/commands/enroll_command.h"
#include "client/app/commands/join_command.h"
#include "client/app/commands/link_test_command.h"
#include "client/app/commands/sessions_command.h"
#include "client/app/commands/try_command.h"
#include "common/io/log.h"
#include "common/io/process_hardening.h"
#include "common/io/program.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  tandem::io::harden_process();
  CLI::App app{
      "tandem-client attaches a haptic device to a session of tandem-server: your hand and the hands of others hold "
      "the same\n"
      "tool. The force that reaches your hand is limited here, whatever the network or the server does.",
      "tandem-client"};
  app.set_version_flag("--version", "tandem-client " TANDEM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "`tandem-client try --help`, `join --help`, `doctor --help`, `link-test --help`, `control --help` and `calibrate "
      "--help` show more.\n"
      "Exit: 0 done, 1 trouble while running, 2 wrong arguments or files. Not a medical device.");

  std::function<int()> action;
  tandem::client::add_try_command(app, action);
  tandem::client::add_join_command(app, action);
  tandem::client::add_doctor_command(app, action);
  tandem::client::add_link_test_command(app, action);
  tandem::client::add_calibrate_command(app, action);
  tandem::client::add_enroll_command(app, action);
  tandem::client::add_sessions_command(app, action);
  tandem::client::add_control_command(app, action);
  tandem::io::log_to_stderr("tandem-client");
  return tandem::io::run_program(app, action, argc, argv);
}
