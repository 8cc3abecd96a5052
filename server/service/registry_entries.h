#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/spec/registry_spec.h"

namespace tandem::server {

/// The lists of workstations and codes of a server.
struct RegistryLists {
  std::vector<WorkstationRow> workstations;
  std::vector<CodeRow> codes;
  friend bool operator==(const RegistryLists&, const RegistryLists&) = default;
};

/// The same lists as one text per name of a workstation: its key, or a code for it, or both. Equal rows have equal
/// texts.
using RegistryEntries = std::map<std::string, std::string, std::less<>>;

inline constexpr std::size_t kRegistryEntryMax = 1024;  ///< [bytes] of a text that is read

/// A name has at most one row in each list (common/auth/registry.h); of several the last counts.
[[nodiscard]] RegistryEntries entries_of(const RegistryLists& lists);
/// Texts that cannot be read have no rows.
[[nodiscard]] RegistryLists lists_of(const RegistryEntries& entries);
/// Whether another server's text can be read, whatever its bytes are.
[[nodiscard]] bool readable_entry(std::string_view text);

}  // namespace tandem::server
