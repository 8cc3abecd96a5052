#pragma once

#include <map>
#include <optional>
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
/// Whether another server's text can be read, whatever its bytes are.
[[nodiscard]] bool readable_entry(std::string_view text);
/// Returns the code of a text; nullopt: it has none, or cannot be read.
[[nodiscard]] std::optional<CodeRow> code_of(std::string_view text);
/// Returns a text that can be read, without its code; empty: it has nothing else.
[[nodiscard]] std::string without_code(std::string_view text);
/// Merges two texts of one name that were both changed since `before`, key and code apart: a change of one of them on
/// one side stays. If both sides changed the key, `stored` counts; of two changed codes that of `stored`, if it has
/// one.
/// @pre `local` and `stored` can be read; `before` may be empty
[[nodiscard]] std::string merged_entry(std::string_view before, std::string_view local, std::string_view stored);
/// Returns those of the entries that the files of one server can hold together. Of several names with one key the one
/// enrolled first stays, then the first by name; of several names with one code the first by name. Beyond
/// auth::kRegistryRowsMax rows of a list, names that are not in `own` are left out.
/// @param own  entries that the files have
[[nodiscard]] RegistryEntries tenable(const RegistryEntries& entries, const RegistryEntries& own);

}  // namespace tandem::server
