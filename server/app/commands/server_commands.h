#pragma once

namespace tandem::io {
class Command;
}

/// The commands of tandem-server. Each function adds one to the program.
namespace tandem::server {

void add_run_command(const io::Command& root);          ///< hosts one session
void add_serve_command(const io::Command& root);        ///< hosts all sessions of a configuration
void add_sessions_command(const io::Command& root);     ///< lists the sessions of the running server
void add_stop_command(const io::Command& root);         ///< asks the running server to end
void add_scenes_command(const io::Command& root);       ///< lists or prints the shipped scenes
void add_replay_live_command(const io::Command& root);  ///< serves a recorded lesson live
void add_repair_command(const io::Command& root);       ///< closes recordings that were cut
void add_recordings_command(const io::Command& root);   ///< lists, exports and deletes recordings

// Administration of the state folder: keys, workstations, codes and tickets.
void add_init_command(const io::Command& root);     ///< creates the keys, or replaces the one that signs tickets
void add_enroll_command(const io::Command& root);   ///< issues the one-time string that enrols a workstation
void add_ticket_command(const io::Command& root);   ///< writes a ticket
void add_revoke_command(const io::Command& root);   ///< revokes a workstation
void add_service_command(const io::Command& root);  ///< makes several servers one service
void add_move_command(const io::Command& root);     ///< moves a session of a service
void add_servers_command(const io::Command& root);  ///< lists the servers of a service

}  // namespace tandem::server
