#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <vector>

#include "netsim/path_spec.h"
#include "netsim/profiles.h"
#include "netsim/script.h"
#include "proto/input_error.h"

namespace tandem::netsim {

/// The network that a command line asked for.
struct NetworkChoice {
  LinkSpec link;
  std::string name;                ///< `custom`, the profile's name, or the file's
  std::string description;         ///< one line for people
  std::vector<std::string> notes;  ///< what a report must say about it
  bool plays_capacity = false;     ///< a profile that asked for a recorded capacity, and has it
  bool plays_interval = false;     ///< a recording without times, to which --trace-interval gave them
};

/// What a script asked for.
struct ScriptChoice {
  std::vector<NetworkEvent> events;
  std::vector<std::string> notes;  ///< what a report must say about the networks it names
};

/// The options that say what the network is like, shared by `proxy` and `run`:
/// --delay --jitter --loss --duplicate --reorder --outage --profile --capacity --network --trace-interval --script --seed.
/// Lives as long as the command it was added to.
class NetworkOptions {
 public:
  void add_to(CLI::App& command);

  /// Reads the files named and puts all together. Numbers beside --profile replace the profile's own.
  /// @return the network, or what is wrong: one mistake per line
  [[nodiscard]] std::expected<NetworkChoice, std::string> resolve() const;

  /// A network by name or file, as --profile and --network take it.
  /// @return the network, or what is wrong
  [[nodiscard]] std::expected<NetworkChoice, std::string> named(const std::string& name_or_file) const {
    return from_file(name_or_file);
  }

  /// Reads --script: what changes while it runs. Networks it names are shipped profiles, or files beside the script.
  /// @param clients  names that the script may use; none: "1", "2", ... in order of arrival
  /// @return the events (none without a script), or what is wrong: one mistake per line
  [[nodiscard]] std::expected<ScriptChoice, std::string> events(std::span<const std::string> clients = {}) const;

  /// The options given that say what the network is like or what its seed is: for what replaces them all.
  [[nodiscard]] std::vector<std::string> all_given() const;

  [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }

 private:
  /// The network without what only --script can justify.
  [[nodiscard]] std::expected<NetworkChoice, std::string> network() const;
  /// Why --trace-interval is not for this network; empty: it is, or was not given.
  [[nodiscard]] std::string interval_problem(const NetworkChoice& choice) const;
  [[nodiscard]] std::expected<NetworkChoice, std::string> from_file(const std::string& name_or_file) const;
  /// @param file  it was read from; empty: a shipped one
  [[nodiscard]] std::expected<NetworkChoice, std::string> from_profile(std::expected<Profile, InputErrors> profile,
                                                                       const std::string& file) const;
  [[nodiscard]] bool given(const char* option) const { return command_->get_option(option)->count() > 0; }

  CLI::App* command_ = nullptr;
  double delay_ms_ = 0, jitter_ms_ = 0, loss_percent_ = 0, duplicate_percent_ = 0, reorder_percent_ = 0;
  double trace_interval_ms_ = 0;
  std::vector<std::string> outages_;
  std::string profile_, network_, capacity_, script_;
  std::uint64_t seed_ = 1;
};

/// Adds what is not there already: several networks may come from one recording.
void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more);

/// A whole file of at most `bytes_max` bytes, or why not: `FILE: reason`.
[[nodiscard]] std::expected<std::string, std::string> read_whole_file(const std::string& path,
                                                                      std::uintmax_t bytes_max);
/// A profile or recording of at most 64 MiB. @return its bytes, or what is wrong
[[nodiscard]] std::expected<std::string, std::string> read_network_file(const std::string& path);

/// Reads `START,LENGTH[,PERIOD]` in seconds. @return the outage, or what is wrong with it
[[nodiscard]] std::expected<OutageSpec, std::string> parse_outage(const std::string& text);

}  // namespace tandem::netsim
