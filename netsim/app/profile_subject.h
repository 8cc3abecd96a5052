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
  std::string text;                ///< of a profile, as it stands in its file
  bool recording = false;
  std::vector<std::string> notes;  ///< what a report must say about it
};

/// @param interval  between rows of a recording without a time column; 0: such a recording is a mistake
/// @return the network, or what is wrong: one mistake per line
[[nodiscard]] std::expected<ProfileSubject, std::string> load_profile_subject(const std::string& name_or_file,
                                                                              Duration interval);

}  // namespace tandem::netsim
