#pragma once

namespace tandem::io {
class Command;
}

/// The commands of tandem-netsim. Each function adds one to the program.
namespace tandem::netsim {

void add_control_command(const io::Command& root);   ///< sends a command to a running proxy
void add_feel_command(const io::Command& root);      ///< measures what hands feel
void add_profiles_command(const io::Command& root);  ///< lists or previews networks
void add_proxy_command(const io::Command& root);     ///< puts a simulated network between live clients and a server
void add_run_command(const io::Command& root);       ///< runs a whole session in virtual time
void add_swarm_command(const io::Command& root);     ///< runs random sessions and checks every invariant
void add_sweep_command(const io::Command& root);     ///< runs one scene over a grid of networks
void add_test_command(const io::Command& root);      ///< gives verdicts for CI
void add_trace_command(const io::Command& root);     ///< writes the trace of a recording
void add_tradeoff_command(const io::Command& root);  ///< measures cost and error of numerics

}  // namespace tandem::netsim
