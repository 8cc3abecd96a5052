#pragma once

namespace tandem::io {
class Command;
}

/// The commands of tandem-client. Each function adds one to the program.
namespace tandem::client {

void add_calibrate_command(const io::Command& root);  ///< measures known masses to fit a Falcon's force scale
void add_control_command(const io::Command& root);    ///< operates a session without a seat
void add_doctor_command(const io::Command& root);     ///< checks attached devices
void add_enroll_command(const io::Command& root);     ///< registers this workstation at a server
void add_join_command(const io::Command& root);       ///< attaches a device to a seat of a session
void add_link_test_command(const io::Command& root);  ///< measures the link to a server
void add_record_command(const io::Command& root);     ///< records a session without a seat
void add_sessions_command(const io::Command& root);   ///< lists the sessions of a server
void add_try_command(const io::Command& root);        ///< starts a server, simulated partners and the user's seat
void add_watch_command(const io::Command& root);      ///< shows a session live without a seat

}  // namespace tandem::client
