#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <vector>

#include "common/io/command_line.h"
#include "netsim/engine/schedule.h"
#include "netsim/models/path_spec.h"
#include "netsim/profiles/profile_loader.h"
#include "proto/spec/input_error.h"

namespace tandem::netsim {

/// Network selected by the command line.
struct NetworkChoice {
  LinkSpec link;
  std::string name;                ///< `custom`, or the name of the profile or file
  std::string description;         ///< one line of text
  std::vector<std::string> notes;  ///< notes that a report must contain
  bool plays_capacity = false;     ///< the profile required a recorded capacity and got one
  bool plays_interval = false;     ///< a recording without times that uses --trace-interval
};

/// Events selected by the script.
struct ScriptChoice {
  std::vector<NetworkEvent> events;
  std::vector<std::string> notes;  ///< notes that a report must contain about the named networks
};

/// Returns a network by name or file, as --profile and --network accept it.
/// @param capacity           file of the recorded capacity that the profile plays; empty: none
/// @param trace_interval_ms  time between the rows of a recording without a time column; 0: not given
/// @return network, or errors
[[nodiscard]] std::expected<NetworkChoice, std::string> named_network(const std::string& name_or_file,
                                                                      const std::string& capacity,
                                                                      double trace_interval_ms);

/// Command-line options of the network, shared by `proxy` and `run`: --delay --jitter --loss --duplicate --reorder
/// --outage --profile --capacity --network --trace-interval --script --seed. Must live as long as the command, which
/// stores references to it.
class NetworkOptions {
 public:
  void add_to(const io::Command& command);

  /// Reads the named files and combines all options. Options given beside --profile replace the profile's parameters.
  /// @return network, or errors, one per line
  [[nodiscard]] std::expected<NetworkChoice, std::string> resolve() const;

  /// Returns a network by name or file, with the given --capacity and --trace-interval.
  [[nodiscard]] std::expected<NetworkChoice, std::string> named(const std::string& name_or_file) const {
    return named_network(name_or_file, capacity_, trace_interval_ms_);
  }

  /// Reads --script, the scheduled changes. The networks it names are shipped profiles, or files relative to the
  /// script.
  /// @param clients  allowed client names; empty: "1", "2", ... in order of arrival
  /// @return events (empty without a script), or errors, one per line
  [[nodiscard]] std::expected<ScriptChoice, std::string> events(std::span<const std::string> clients = {}) const;

  /// Returns the given options that define network or seed. Callers use it to reject options that another source
  /// replaces.
  [[nodiscard]] std::vector<std::string> all_given() const;

  [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }

 private:
  /// Returns the network; does not apply the rules that depend on --script.
  [[nodiscard]] std::expected<NetworkChoice, std::string> network() const;
  /// Returns why --trace-interval does not apply to this network; empty if it applies or was not given.
  [[nodiscard]] std::string interval_problem(const NetworkChoice& choice) const;
  [[nodiscard]] bool given(const char* option) const;

  io::Command command_;
  double delay_ms_ = 0, jitter_ms_ = 0, loss_percent_ = 0, duplicate_percent_ = 0, reorder_percent_ = 0;
  double trace_interval_ms_ = 0;
  std::vector<std::string> outages_;
  std::string profile_, network_, capacity_, script_;
  std::uint64_t seed_ = 1;
};

/// Appends the notes that are not present yet, because several networks may share a recording.
void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more);

/// Returns one line per error, without a line feed at the end.
[[nodiscard]] std::string lines_of(const InputErrors& errors);

/// Returns the contents of a profile or recording of at most 64 MiB, or an error.
[[nodiscard]] std::expected<std::string, std::string> read_network_file(const std::string& path);

/// Parses `START,LENGTH[,PERIOD]` in seconds. Returns the outage, or an error.
[[nodiscard]] std::expected<OutageSpec, std::string> parse_outage(const std::string& text);

}  // namespace tandem::netsim
