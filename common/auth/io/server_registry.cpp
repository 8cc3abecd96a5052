#include <algorithm>

#include "common/auth/io/server_keystore.h"
#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"

/// Lists of a server that commands change too: workstations, codes, and the description of the running server.
namespace tandem::auth {
namespace {

/// Reads a list; a missing file means an empty list.
template <class Parse>
auto book(const StateDirectory& folder, const char* name, Parse parse)
    -> std::expected<typename decltype(parse("", ""))::value_type, std::string> {
  const auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  auto rows = parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder.path_of(name));
  if (!rows) return std::unexpected(to_text(rows.error()) + "repair or delete that file");
  return std::move(*rows);
}

}  // namespace

std::expected<ServerKeystore::Books, std::string> ServerKeystore::read_books() const {
  if (!folder_) return books_;
  auto workstations = book(*folder_, kWorkstationsFile, parse_workstations);
  if (!workstations) return std::unexpected(workstations.error());
  auto codes = book(*folder_, kCodesFile, parse_codes);
  if (!codes) return std::unexpected(codes.error());
  return Books{std::move(*workstations), std::move(*codes)};
}

template <class Change>
std::string ServerKeystore::change_books(Change change) {
  StateDirectory::Lock held;
  if (folder_) {
    auto lock = folder_->lock(kLock);
    if (!lock) return lock.error();
    held = std::move(*lock);
  }
  auto books = read_books();
  if (!books) return books.error();
  const Books before = *books;
  change(*books);
  if (!folder_) {
    books_ = std::move(*books);
    return {};
  }
  // Workstations first: after a crash in between, a code may be used twice for the same name, but no confirmed
  // workstation is lost.
  std::string problem;
  if (books->workstations != before.workstations)
    problem = folder_->replace(kWorkstationsFile, std::string_view(print_workstations(books->workstations)));
  if (problem.empty() && books->codes != before.codes)
    problem = folder_->replace(kCodesFile, std::string_view(print_codes(books->codes)));
  return problem;
}

std::expected<std::vector<WorkstationRow>, std::string> ServerKeystore::workstations() {
  if (!folder_) return books_.workstations;
  // The stamp is taken first, so that the next look-up sees a change made between the two.
  const StateDirectory::Stamp now = folder_->stamp(kWorkstationsFile);
  if (now == seen_ && now != StateDirectory::Stamp{}) return books_.workstations;
  auto rows = book(*folder_, kWorkstationsFile, parse_workstations);
  if (!rows) {
    seen_ = {};
    return rows;
  }
  books_.workstations = *rows;
  seen_ = now;
  return rows;
}

std::expected<std::size_t, std::string> ServerKeystore::pending_codes(std::int64_t now) const {
  if (!folder_)
    return static_cast<std::size_t>(
        std::ranges::count_if(books_.codes, [&](const CodeRow& c) { return now <= c.not_after; }));
  const auto books = read_books();
  if (!books) return std::unexpected(books.error());
  return static_cast<std::size_t>(
      std::ranges::count_if(books->codes, [&](const CodeRow& c) { return now <= c.not_after; }));
}

std::expected<std::optional<WorkstationRow>, std::string> ServerKeystore::find(const KeyFingerprint& workstation) {
  const auto rows = workstations();
  if (!rows) return std::unexpected(rows.error());
  const WorkstationRow* const row = find_workstation(*rows, workstation);
  return row == nullptr ? std::nullopt : std::optional(*row);
}

std::expected<WorkstationRow, ServerKeystore::EnrollFailure> ServerKeystore::enroll(const EnrolmentCode& code,
                                                                                    const KeyFingerprint& fingerprint,
                                                                                    std::int64_t now) {
  std::expected<WorkstationRow, EnrollError> made = std::unexpected(EnrollError::kUnknownCode);
  std::string problem =
      change_books([&](Books& books) { made = auth::enroll(books.workstations, books.codes, code, fingerprint, now); });
  if (!problem.empty()) return std::unexpected(EnrollFailure{std::nullopt, std::move(problem)});
  if (!made) return std::unexpected(EnrollFailure{made.error(), to_text(made.error())});
  audit(now, "enrolled", made->name, fingerprint.hex());
  return *made;
}

std::string ServerKeystore::issue_code(const EnrolmentCode& code, std::string_view workstation, std::int64_t now,
                                       std::int64_t not_after) {
  std::string problem =
      change_books([&](Books& books) { auth::issue_code(books.codes, code, workstation, now, not_after); });
  if (problem.empty()) audit(now, "code_given_out", workstation);
  return problem;
}

std::expected<Revoked, std::string> ServerKeystore::revoke(std::string_view name) {
  Revoked gone;
  std::string problem = change_books([&](Books& books) { gone = auth::revoke(books.workstations, books.codes, name); });
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return gone;
}

std::string ServerKeystore::enroll_without_code(const WorkstationRow& row) {
  return change_books([&](Books& books) {
    std::erase_if(books.workstations,
                  [&](const WorkstationRow& old) { return old.name == row.name || old.spki == row.spki; });
    books.workstations.push_back(row);
  });
}

std::expected<std::optional<ServingSpec>, std::string> ServerKeystore::read_serving() const {
  if (!folder_ || !folder_->has(kServingFile)) return std::nullopt;
  const auto books = folder_->lock(kLock);
  if (!books) return std::unexpected(books.error());
  // Left by a server that was killed: no process holds its lock.
  const auto lock = folder_->try_lock(kServingLock);
  if (!lock) return std::unexpected(lock.error());
  if (*lock) return std::nullopt;
  auto serving = book(*folder_, kServingFile, parse_serving);
  if (!serving) return std::unexpected(serving.error());
  return std::move(*serving);
}

}  // namespace tandem::auth
