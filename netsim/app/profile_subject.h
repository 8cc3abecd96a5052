#pragma once

#include <expected>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/profiles.h"

namespace tandem::netsim {

/// A network somebody wants to look at: a shipped profile, a profile of one's own, or a recording.
struct ProfileSubject {
  Profile profile;                 ///< of a recording: its name, summary and link
  std::string file;                ///< it was read from; empty: shipped
  std::string text;                ///< of a profile, as it stands in its file
  bool recording = false;
  bool plays_interval = false;     ///< a recording without times, to which `interval` gave them
  std::vector<std::string> notes;  ///< what a report must say about it
};

/// @param interval  between rows of a recording without a time column; 0: such a recording is a mistake
/// @return the network, or what is wrong: one mistake per line
[[nodiscard]] std::expected<ProfileSubject, std::string> load_profile_subject(const std::string& name_or_file,
                                                                              Duration interval);

/// Gives it the recorded capacity that it asks for, if it does: before it is played.
/// @param capacity  the file of --capacity; or empty
/// @return what is wrong; empty: nothing
[[nodiscard]] std::string complete(ProfileSubject& subject, const std::string& capacity);

}  // namespace tandem::netsim
