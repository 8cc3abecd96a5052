#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "netsim/profiles.h"

/// Recorded capacities as files: what `--capacity` and the key `capacity` of a profile name.
namespace tandem::netsim {

/// A recorded capacity that was read.
struct CapacityFile {
  LinkSpec link;            ///< plays it, without a limit of the queue
  std::string description;  ///< one line for people: what it was read as, and what is in there
};

/// Whether the text is a recorded capacity, not another kind of recording or a profile: the table has a column
/// `opportunities`, mahimahi's form begins with a number that is alone in its line.
[[nodiscard]] bool looks_like_capacity(std::string_view text);

/// @return the capacity, or what is wrong: one mistake per line, each with the file and its line
[[nodiscard]] std::expected<CapacityFile, std::string> read_capacity_file(const std::string& path);
[[nodiscard]] std::expected<CapacityFile, std::string> parse_capacity_file(std::string_view text,
                                                                           const std::string& path);

/// Gives a profile the recorded capacity it asks for, if it does.
/// @param profile_file  where it was read from; a file it names itself is looked for beside it. Empty: a shipped one
/// @param given         the file of `--capacity`, which wins; or empty
/// @return words for the description, empty if the profile asks for none; or what is wrong: there is no file, or it
///         cannot be read
[[nodiscard]] std::expected<std::string, std::string> complete_capacity(Profile& profile,
                                                                        const std::string& profile_file,
                                                                        const std::string& given);

}  // namespace tandem::netsim
