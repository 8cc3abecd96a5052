#include "common/io/command_line.h"
#include "common/io/log.h"
#include "common/io/process_hardening.h"
#include "server/app/commands/server_commands.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

int main(int argc, char** argv) {
  tandem::io::harden_process();
  tandem::io::Program program(
      "tandem-server", TANDEM_VERSION,
      "tandem-server hosts sessions in which several participants hold the same tool over a network. It couples all "
      "hands to "
      "the\n"
      "tools of a scene, shares authority between them, and reports the quality of the session.");
  const tandem::io::Command root = program.root();
  root.footer(
      "`tandem-server COMMAND --help` shows the options; a first session: `tandem-server run free_motion`.\n"
      "Exit: 0 done, 1 trouble while running or verdict fail, 2 wrong arguments or files. Not a medical device.");

  tandem::server::add_run_command(root);
  tandem::server::add_serve_command(root);
  tandem::server::add_sessions_command(root);
  tandem::server::add_stop_command(root);
  tandem::server::add_scenes_command(root);
  tandem::server::add_recordings_command(root);
  tandem::server::add_replay_live_command(root);
  tandem::server::add_repair_command(root);
  tandem::server::add_init_command(root);
  tandem::server::add_enroll_command(root);
  tandem::server::add_ticket_command(root);
  tandem::server::add_revoke_command(root);
  tandem::server::add_service_command(root);
  tandem::server::add_servers_command(root);
  tandem::server::add_move_command(root);
  tandem::io::log_to_stderr("tandem-server");
  return program.run({argv + 1, argv + argc});
}
