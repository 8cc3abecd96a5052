#pragma once

#include <map>
#include <string>
#include <string_view>

#include "common/auth/registry.h"

namespace tandem::server {

/// Workstations and codes of a server as one text per name of a workstation: its key, or a code for it, or both. Equal
/// rows have equal texts.
using RegistryEntries = std::map<std::string, std::string, std::less<>>;

inline constexpr std::size_t kRegistryEntryMax = 1024;  ///< [bytes] of a text that is read

/// A name has at most one row in each list (common/auth/registry.h); of several the last counts.
[[nodiscard]] RegistryEntries entries_of(const auth::RegistryLists& lists);
/// Texts that cannot be read have no rows.
[[nodiscard]] auth::RegistryLists lists_of(const RegistryEntries& entries);
/// Text of a name that the files and the directory have both changed since `before`. A revocation wins, and nothing
/// that only one of them has added is lost: a key that one server enrols while another issues a code. Else the
/// directory wins. Empty texts: no row.
[[nodiscard]] std::string merged_entry(const std::string& before, const std::string& local, const std::string& stored);
/// Whether another server's text can be read, whatever its bytes are.
[[nodiscard]] bool readable_entry(std::string_view text);

}  // namespace tandem::server
