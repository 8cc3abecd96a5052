#include "common/auth/io/server_registry.h"

#include <algorithm>
#include <utility>

#include "common/auth/io/directory_lock.h"
#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"

namespace tandem::auth {
namespace {

/// Reads a list; a missing file means an empty list.
template <class Parse>
auto read_list(const StateDirectory& folder, const char* name, Parse parse)
    -> std::expected<typename decltype(parse("", ""))::value_type, std::string> {
  const auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  auto rows = parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder.path_of(name));
  if (!rows) return std::unexpected(to_text(rows.error()) + "repair or delete that file");
  return std::move(*rows);
}

}  // namespace

std::expected<ServerRegistry::Lists, std::string> ServerRegistry::read() const {
  if (!folder_) return lists_;
  auto workstations = read_list(*folder_, kWorkstationsFile, parse_workstations);
  if (!workstations) return std::unexpected(workstations.error());
  auto codes = read_list(*folder_, kCodesFile, parse_codes);
  if (!codes) return std::unexpected(codes.error());
  return Lists{std::move(*workstations), std::move(*codes)};
}

template <class Change>
std::string ServerRegistry::modify(Change change) {
  DirectoryLock held;
  if (folder_) {
    auto lock = DirectoryLock::wait(*folder_, kLock);
    if (!lock) return lock.error();
    held = std::move(*lock);
  }
  auto lists = read();
  if (!lists) return lists.error();
  const Lists before = *lists;
  change(*lists);
  if (!folder_) {
    lists_ = std::move(*lists);
    return {};
  }
  // Workstations first: after a crash in between, a code may be used twice for the same name, but no confirmed
  // workstation is lost.
  std::string problem;
  if (lists->workstations != before.workstations)
    problem = folder_->replace(kWorkstationsFile, std::string_view(print_workstations(lists->workstations)));
  if (problem.empty() && lists->codes != before.codes)
    problem = folder_->replace(kCodesFile, std::string_view(print_codes(lists->codes)));
  return problem;
}

bool ServerRegistry::changed() {
  if (!folder_) return true;
  const std::pair now{folder_->stamp(kWorkstationsFile), folder_->stamp(kCodesFile)};
  return now != std::exchange(compared_, now);
}

std::string ServerRegistry::problem() const {
  const auto lists = read();
  return lists ? std::string{} : lists.error();
}

void ServerRegistry::audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail) {
  if (folder_) audit_->write(*folder_, now, event, name, detail);
}

std::expected<std::vector<WorkstationRow>, std::string> ServerRegistry::workstations() {
  if (!folder_) return lists_.workstations;
  // The stamp is taken first, so that the next look-up sees a change made between the two.
  const StateDirectory::Stamp now = folder_->stamp(kWorkstationsFile);
  if (now == seen_ && now != StateDirectory::Stamp{}) return lists_.workstations;
  auto rows = read_list(*folder_, kWorkstationsFile, parse_workstations);
  if (!rows) {
    seen_ = {};
    return rows;
  }
  lists_.workstations = *rows;
  seen_ = now;
  return rows;
}

std::expected<std::size_t, std::string> ServerRegistry::pending_codes(std::int64_t now) const {
  const auto lists = read();
  if (!lists) return std::unexpected(lists.error());
  return static_cast<std::size_t>(
      std::ranges::count_if(lists->codes, [&](const CodeRow& c) { return now <= c.not_after; }));
}

std::expected<std::optional<WorkstationRow>, std::string> ServerRegistry::find(const KeyFingerprint& workstation) {
  const auto rows = workstations();
  if (!rows) return std::unexpected(rows.error());
  const WorkstationRow* const row = find_workstation(*rows, workstation);
  return row == nullptr ? std::nullopt : std::optional(*row);
}

std::expected<WorkstationRow, ServerRegistry::EnrollFailure> ServerRegistry::enroll(const EnrolmentCode& code,
                                                                                    const KeyFingerprint& fingerprint,
                                                                                    std::int64_t now) {
  std::expected<WorkstationRow, EnrollError> made = std::unexpected(EnrollError::kUnknownCode);
  std::string problem =
      modify([&](Lists& lists) { made = auth::enroll(lists.workstations, lists.codes, code, fingerprint, now); });
  if (!problem.empty()) return std::unexpected(EnrollFailure{std::nullopt, std::move(problem)});
  if (!made) return std::unexpected(EnrollFailure{made.error(), to_text(made.error())});
  audit(now, "enrolled", made->name, fingerprint.hex());
  return *made;
}

std::string ServerRegistry::issue_code(const EnrolmentCode& code, std::string_view workstation, std::int64_t now,
                                       std::int64_t not_after) {
  std::string problem = modify([&](Lists& lists) { auth::issue_code(lists.codes, code, workstation, now, not_after); });
  if (problem.empty()) audit(now, "code_given_out", workstation);
  return problem;
}

std::expected<Revoked, std::string> ServerRegistry::revoke(std::string_view name) {
  Revoked gone;
  std::string problem = modify([&](Lists& lists) { gone = auth::revoke(lists.workstations, lists.codes, name); });
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return gone;
}

std::expected<bool, std::string> ServerRegistry::replace(const RegistryLists& expected, RegistryLists wanted,
                                                         std::int64_t now) {
  bool same = false;
  std::string problem = modify([&](Lists& lists) {
    same = lists == expected;
    if (same) lists = wanted;
  });
  if (!problem.empty()) return std::unexpected(std::move(problem));
  if (!same) return false;
  const auto lacks = [](const RegistryLists& lists, const WorkstationRow& row) {
    return std::ranges::find(lists.workstations, row) == lists.workstations.end();
  };
  for (const WorkstationRow& row : expected.workstations)
    if (lacks(wanted, row)) audit(now, "revoked_in_service", row.name, to_hex(row.spki));
  for (const WorkstationRow& row : wanted.workstations)
    if (lacks(expected, row)) audit(now, "enrolled_in_service", row.name, to_hex(row.spki));
  return true;
}

std::string ServerRegistry::enroll_without_code(const WorkstationRow& row) {
  return modify([&](Lists& lists) {
    std::erase_if(lists.workstations,
                  [&](const WorkstationRow& old) { return old.name == row.name || old.spki == row.spki; });
    lists.workstations.push_back(row);
  });
}

}  // namespace tandem::auth
