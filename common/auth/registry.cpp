#include "common/auth/registry.h"

#include <algorithm>

namespace tandem::auth {

bool is_valid_name(std::string_view name) noexcept {
  const auto legal = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= 32 && std::ranges::all_of(name, legal);
}

const WorkstationRow* find_workstation(const std::vector<WorkstationRow>& book,
                                       const KeyFingerprint& fingerprint) noexcept {
  const auto found = std::ranges::find(book, fingerprint.sha256, &WorkstationRow::spki);
  return found == book.end() ? nullptr : &*found;
}

const WorkstationRow* find_workstation(const std::vector<WorkstationRow>& book, std::string_view name) noexcept {
  const auto found = std::ranges::find(book, name, &WorkstationRow::name);
  return found == book.end() ? nullptr : &*found;
}

void issue_code(std::vector<CodeRow>& codes, const EnrolmentCode& code, std::string_view workstation, std::int64_t now,
                std::int64_t not_after) {
  std::erase_if(codes, [&](const CodeRow& row) { return row.workstation == workstation || row.not_after < now; });
  codes.push_back({hash_of(code), std::string(workstation), not_after});
}

std::string to_text(EnrollError fault) {
  switch (fault) {
    case EnrollError::kUnknownCode:
      return "this code is not valid: it was used already, replaced by a newer one, or is wrong; ask for a new one "
             "with `tandem-server enroll NAME --address HOST:PORT`";
    case EnrollError::kExpired:
      return "this code has expired; ask for a new one with `tandem-server enroll NAME --address HOST:PORT`";
    case EnrollError::kKeyTaken:
      return "this workstation is enrolled under another name already; `tandem-server revoke` that name first";
    case EnrollError::kBookFull:
      return "the server's registry is full with 4096 workstations; revoke those that are no longer used";
  }
  return "?";
}

std::expected<WorkstationRow, EnrollError> enroll(std::vector<WorkstationRow>& book, std::vector<CodeRow>& codes,
                                                  const EnrolmentCode& code, const KeyFingerprint& fingerprint,
                                                  std::int64_t now) {
  const CodeHash hash = hash_of(code);
  const auto given = std::ranges::find_if(codes, [&](const CodeRow& row) { return equal_secret(row.hash, hash); });
  if (given == codes.end()) return std::unexpected(EnrollError::kUnknownCode);
  if (now > given->not_after) {
    codes.erase(given);
    return std::unexpected(EnrollError::kExpired);
  }
  if (const WorkstationRow* same = find_workstation(book, fingerprint);
      same != nullptr && same->name != given->workstation)
    return std::unexpected(EnrollError::kKeyTaken);
  const std::string name = given->workstation;
  const auto old = std::ranges::find(book, name, &WorkstationRow::name);
  if (old == book.end() && book.size() >= kRegistryRowsMax) return std::unexpected(EnrollError::kBookFull);
  WorkstationRow row{name, fingerprint.sha256, now};
  if (old == book.end()) {
    book.push_back(row);
  } else {
    // A key that was not revoked meanwhile stays enrolled since then, and its tickets count.
    if (old->spki == row.spki) row.enrolled_at = std::min(row.enrolled_at, old->enrolled_at);
    *old = row;
  }
  codes.erase(given);
  return row;
}

Revoked revoke(std::vector<WorkstationRow>& book, std::vector<CodeRow>& codes, std::string_view name) {
  return {std::erase_if(book, [&](const WorkstationRow& row) { return row.name == name; }),
          std::erase_if(codes, [&](const CodeRow& row) { return row.workstation == name; })};
}

const ServerRow* find_server(const std::vector<ServerRow>& known, std::string_view address) noexcept {
  const auto found = std::ranges::find(known, address, &ServerRow::address);
  return found == known.end() ? nullptr : &*found;
}

void store_server(std::vector<ServerRow>& known, const ServerRow& server) {
  const auto same = std::ranges::find(known, server.address, &ServerRow::address);
  if (same == known.end()) {
    known.push_back(server);
  } else {
    *same = server;
  }
}

}  // namespace tandem::auth
