#include <CLI/CLI.hpp>
#include <functional>

#include "common/io/log.h"
#include "common/io/process_hardening.h"
#include "common/io/program.h"
#include "server/app/commands/auth_commands.h"
#include "server/app/commands/server_commands.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  tandem::io::harden_process();
  CLI::App app{
      "tandem-server hosts sessions in which several participants hold the same tool over a network. It couples all "
      "hands to "
      "the\n"
      "tools of a scene, shares authority between them, and reports the quality of the session.",
      "tandem-server"};
  app.set_version_flag("--version", "tandem-server " TANDEM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "`tandem-server COMMAND --help` shows the options; a first session: `tandem-server run free_motion`.\n"
      "Exit: 0 done, 1 trouble while running or verdict fail, 2 wrong arguments or files. Not a medical device.");

  std::function<int()> action;
  tandem::server::add_run_command(app, action);
  tandem::server::add_serve_command(app, action);
  tandem::server::add_sessions_command(app, action);
  tandem::server::add_stop_command(app, action);
  tandem::server::add_scenes_command(app, action);
  tandem::server::add_init_command(app, action);
  tandem::server::add_enroll_command(app, action);
  tandem::server::add_ticket_command(app, action);
  tandem::server::add_revoke_command(app, action);
  tandem::io::log_to_stderr("tandem-server");
  return tandem::io::run_program(app, action, argc, argv);
}
