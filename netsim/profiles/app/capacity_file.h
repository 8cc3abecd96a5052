#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "netsim/profiles/profile_loader.h"

/// Files of recorded capacities, as named by `--capacity` or by the key `capacity` of a profile.
namespace tandem::netsim {

/// Contents of a capacity file.
struct CapacityFile {
  LinkSpec link;            ///< plays the recording, without a queue limit
  std::string description;  ///< one line of text: detected format and contents
};

/// Returns whether the text is a recorded capacity, not another recording or a profile. The table form has a column
/// `opportunities`; mahimahi's form begins with a line that holds a single number.
[[nodiscard]] bool looks_like_capacity(std::string_view text);

/// Reads a capacity file.
/// @return capacity, or errors: one per line, each with file and line
[[nodiscard]] std::expected<CapacityFile, std::string> read_capacity_file(const std::string& path);
/// The same for a text; `path` appears in messages.
[[nodiscard]] std::expected<CapacityFile, std::string> parse_capacity_file(std::string_view text,
                                                                           const std::string& path);

/// Supplies a profile with the recorded capacity it requires, if any.
/// @param profile_file  file of the profile; a capacity file named in the profile is relative to it. Empty: shipped
/// profile
/// @param given         file of `--capacity`, which takes precedence; may be empty
/// @return text for the description, empty if the profile requires no recording; or an error: no file, or an unreadable
/// one
[[nodiscard]] std::expected<std::string, std::string> complete_capacity(Profile& profile,
                                                                        const std::string& profile_file,
                                                                        const std::string& given);

}  // namespace tandem::netsim
