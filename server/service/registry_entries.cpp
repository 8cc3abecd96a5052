#include "server/service/registry_entries.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "common/auth/key_fingerprint.h"
#include "common/base/hex.h"

namespace tandem::server {
namespace {

using Json = nlohmann::json;

struct Rows {
  std::optional<WorkstationRow> workstation;
  std::optional<CodeRow> code;
};

/// Reads `{"KEY": "64 digits", "TIME": seconds}`.
bool read_pair(const Json& in, const char* key, const char* time, Sha256& digest, std::int64_t& seconds) {
  if (!in.is_object()) return false;
  const auto hex = in.find(key), at = in.find(time);
  if (hex == in.end() || at == in.end() || !hex->is_string() || !at->is_number_integer()) return false;
  if (!auth::from_hex(hex->get<std::string>(), digest)) return false;
  seconds = at->get<std::int64_t>();
  return true;
}

std::optional<Rows> parse_entry(std::string_view text) {
  if (text.size() > kRegistryEntryMax) return std::nullopt;
  const Json in = Json::parse(text, nullptr, false);
  if (!in.is_object()) return std::nullopt;
  Rows rows;
  if (const auto found = in.find("workstation"); found != in.end()) {
    WorkstationRow& row = rows.workstation.emplace();
    if (!read_pair(*found, "spki", "enrolled_at", row.spki, row.enrolled_at)) return std::nullopt;
  }
  if (const auto found = in.find("code"); found != in.end()) {
    CodeRow& row = rows.code.emplace();
    if (!read_pair(*found, "hash", "not_after", row.hash, row.not_after)) return std::nullopt;
  }
  return rows;
}

}  // namespace

RegistryEntries entries_of(const auth::RegistryLists& lists) {
  std::map<std::string, Json> made;
  for (const WorkstationRow& row : lists.workstations)
    made[row.name]["workstation"] = {{"spki", to_hex(row.spki)}, {"enrolled_at", row.enrolled_at}};
  for (const CodeRow& row : lists.codes)
    made[row.workstation]["code"] = {{"hash", to_hex(row.hash)}, {"not_after", row.not_after}};
  RegistryEntries entries;
  for (const auto& [name, json] : made) entries[name] = json.dump();
  return entries;
}

auth::RegistryLists lists_of(const RegistryEntries& entries) {
  auth::RegistryLists lists;
  for (const auto& [name, text] : entries) {
    auto rows = parse_entry(text);
    if (!rows) continue;
    if (rows->workstation) {
      rows->workstation->name = name;
      lists.workstations.push_back(std::move(*rows->workstation));
    }
    if (rows->code) {
      rows->code->workstation = name;
      lists.codes.push_back(std::move(*rows->code));
    }
  }
  return lists;
}

std::string merged_entry(const std::string& before, const std::string& local, const std::string& stored) {
  const auto was = parse_entry(before), here = parse_entry(local), there = parse_entry(stored);
  if (local.empty() || stored.empty() || !here || !there) return local.empty() ? local : stored;
  // A workstation that one of them has revoked stays revoked. A code that one of them has used or replaced counts no
  // more, but another one that was issued since does.
  std::optional<WorkstationRow> workstation = there->workstation;
  std::optional<CodeRow> code = there->code;
  const bool knew_key = was && was->workstation, knew_code = was && was->code;
  if (!workstation && !knew_key) workstation = here->workstation;
  if (!here->workstation && knew_key) workstation.reset();
  if (!code && here->code && !(knew_code && was->code == here->code)) code = here->code;
  if (!here->code && knew_code && code == was->code) code.reset();
  auth::RegistryLists lists;
  if (workstation) lists.workstations.push_back(*workstation);
  if (code) lists.codes.push_back(*code);
  const RegistryEntries entries = entries_of(lists);
  return entries.empty() ? std::string{} : entries.begin()->second;
}

bool readable_entry(std::string_view text) { return parse_entry(text).has_value(); }

}  // namespace tandem::server
