#pragma once

#include <expected>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/profiles/profile_loader.h"

namespace tandem::netsim {

/// A network to be previewed: a shipped profile, a user's profile, or a recording.
struct ProfileSource {
  Profile profile;        ///< for a recording: its name, summary and link
  std::string file = {};  ///< file of the network; empty: shipped
  std::string text = {};  ///< text of a profile as in its file
  bool recording = false;
  bool plays_interval = false;          ///< a recording without times, played with `interval`
  std::vector<std::string> notes = {};  ///< facts that a report must contain about it
};

/// Loads a profile or a recording.
/// @param interval  time between rows of a recording without a time column; 0: such a recording is an error
/// @return the network, or the errors, one per line
[[nodiscard]] std::expected<ProfileSource, std::string> load_profile_source(const std::string& name_or_file,
                                                                            Duration interval);

/// Adds the recorded capacity if the profile needs one; call it before a preview.
/// @param capacity  file of --capacity; may be empty
/// @return the error; empty if there is none
[[nodiscard]] std::string complete(ProfileSource& subject, const std::string& capacity);

}  // namespace tandem::netsim
