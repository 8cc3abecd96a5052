#include "server/service/registry_entries.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "common/auth/key_fingerprint.h"
#include "common/base/hex.h"

namespace tandem::server {
namespace {

using Json = nlohmann::json;

struct Rows {
  std::optional<WorkstationRow> workstation;
  std::optional<CodeRow> code;
};

constexpr std::int64_t kTimeMax = 1'000'000'000'000;  // [s] proto/schema/registry.proto

/// Reads `{"KEY": "64 digits", "TIME": seconds}`.
bool read_pair(const Json& in, const char* key, const char* time, Sha256& digest, std::int64_t& seconds) {
  if (!in.is_object()) return false;
  const auto hex = in.find(key), at = in.find(time);
  if (hex == in.end() || at == in.end() || !hex->is_string() || !at->is_number_integer()) return false;
  if (!auth::from_hex(hex->get<std::string>(), digest)) return false;
  seconds = at->get<std::int64_t>();
  return seconds >= 0 && seconds <= kTimeMax;
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

/// The value that changed; `stored` if both did.
template <class Row>
std::optional<Row> changed(const std::optional<Row>& before, const std::optional<Row>& local,
                           const std::optional<Row>& stored) {
  return stored == before ? local : stored;
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

bool readable_entry(std::string_view text) { return parse_entry(text).has_value(); }

std::optional<CodeRow> code_of(std::string_view text) {
  if (text.find("\"code\"") == std::string_view::npos) return std::nullopt;  // most have none
  auto rows = parse_entry(text);
  return rows ? std::move(rows->code) : std::nullopt;
}

std::string without_code(std::string_view text) {
  const auto rows = parse_entry(text);
  if (!rows || !rows->workstation) return {};
  return entries_of({{*rows->workstation}, {}}).begin()->second;  // of the name "", as the row has none
}

std::string merged_entry(std::string_view before, std::string_view local, std::string_view stored) {
  const Rows old = parse_entry(before).value_or(Rows{}), own = parse_entry(local).value_or(Rows{}),
             other = parse_entry(stored).value_or(Rows{});
  auto workstation = changed(old.workstation, own.workstation, other.workstation);
  auto code = changed(old.code, own.code, other.code);
  if (!code && own.code != old.code) code = own.code;  // issued here, while the one before was used elsewhere
  auth::RegistryLists lists;
  if (workstation) lists.workstations.push_back(std::move(*workstation));
  if (code) lists.codes.push_back(std::move(*code));
  const RegistryEntries entries = entries_of(lists);  // of the name "", as the rows have none
  return entries.empty() ? std::string(stored) : entries.begin()->second;
}

RegistryEntries tenable(const RegistryEntries& entries, const RegistryEntries& own) {
  const auth::RegistryLists lists = lists_of(entries);
  std::map<Sha256, std::pair<std::int64_t, std::string>> keys;
  for (const WorkstationRow& row : lists.workstations) {
    std::pair held{row.enrolled_at, row.name};
    if (const auto [first, made] = keys.try_emplace(row.spki, held); !made && held < first->second)
      first->second = std::move(held);
  }
  std::map<Sha256, std::string> codes;
  for (const CodeRow& row : lists.codes) codes.try_emplace(row.hash, row.workstation);  // sorted by name
  std::size_t workstations_left = auth::kRegistryRowsMax, codes_left = auth::kRegistryRowsMax;
  RegistryEntries kept;
  const auto take = [&](const std::string& name, const std::string& text) {
    const auto rows = parse_entry(text);
    if (!rows || (rows->workstation && (workstations_left == 0 || keys.at(rows->workstation->spki).second != name)) ||
        (rows->code && (codes_left == 0 || codes.at(rows->code->hash) != name)))
      return;
    if (rows->workstation) --workstations_left;
    if (rows->code) --codes_left;
    kept[name] = text;
  };
  for (const bool in_files : {true, false})
    for (const auto& [name, text] : entries)
      if (own.contains(name) == in_files) take(name, text);
  return kept;
}

}  // namespace tandem::server
