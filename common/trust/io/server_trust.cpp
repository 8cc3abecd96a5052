#include "common/trust/io/server_trust.h"

#include <algorithm>
#include <charconv>

#include "common/base/printed_command.h"
#include "common/base/raw_bytes.h"
#include "proto/trust_text.h"

namespace tandem::trust {
namespace {

constexpr const char* kLock = "lock";
constexpr const char* kServingLock = "serving.lock";
/// What to do about a folder without keys.
std::string init_hint(const std::string& folder) { return with_options("run `tandem-server init` first", "tandem-server init", server_state_option(folder)); }

/// A file that must be there.
std::expected<SecretBuffer, std::string> needed(const StateFolder& folder, const char* name) {
  auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::unexpected(folder.path_of(name) + " is missing; " + init_hint(folder.path()));
  return std::move(**bytes);
}

/// A book that may be missing: then it is empty.
template <class Parse>
auto book(const StateFolder& folder, const char* name, Parse parse) -> std::expected<typename decltype(parse("", ""))::value_type, std::string> {
  const auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  auto rows = parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder.path_of(name));
  if (!rows) return std::unexpected(to_text(rows.error()) + "mend or delete that file");
  return std::move(*rows);
}

/// For names and words that stand in JSON: our own texts, but whoever reads logs should not have to trust that.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

}  // namespace

std::expected<Pin, std::string> ServerTrust::init(const std::string& path, std::int64_t now) {
  const auto folder = StateFolder::open(path, StateFolder::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = folder->lock(kLock);
  if (!lock) return std::unexpected(lock.error());
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (folder->has(name))
      return std::unexpected(folder->path_of(name) + " exists already: this folder was set up before. New keys would shut out every enrolled workstation; "
                                                     "to begin anew all the same, delete the folder");
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  const Identity identity = Identity::make("tandem server", serial, now);
  const TicketKey ticket_key(Secret<32>(std::span<const std::byte, 32>(random_bytes<std::array<std::byte, 32>>())));
  const auto write = [&folder](const char* name, auto&& bytes) { return folder->replace(name, bytes); };
  // The key last: with it the folder counts as set up.
  std::string problem = write(kTicketKeyFile, ticket_key.to_text().bytes());
  if (problem.empty()) problem = write(kCertificateFile, std::string_view(identity.certificate.to_pem()));
  if (problem.empty()) problem = write(kWorkstationsFile, std::string_view(print_workstations({})));
  if (problem.empty()) problem = write(kCodesFile, std::string_view(print_codes({})));
  if (problem.empty()) problem = write(kKeyFile, identity.key.to_pem().bytes());
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return identity.pin();
}

std::expected<ServerTrust, std::string> ServerTrust::open(const std::string& path) {
  auto folder = StateFolder::open(path, StateFolder::Missing::kIsAnError, init_hint(path));
  if (!folder) return std::unexpected(folder.error());
  const auto key = needed(*folder, kKeyFile), certificate = needed(*folder, kCertificateFile), ticket = needed(*folder, kTicketKeyFile);
  for (const auto* file : {&key, &certificate, &ticket})
    if (!*file) return std::unexpected(file->error());
  auto identity = Identity::from_pem(key->bytes(), certificate->bytes());
  if (!identity) return std::unexpected(folder->path() + ": " + identity.error());
  auto ticket_key = TicketKey::from_text(ticket->bytes());
  if (!ticket_key) return std::unexpected(folder->path_of(kTicketKeyFile) + " " + ticket_key.error());
  ServerTrust trust(std::move(*identity), std::move(*ticket_key));
  trust.folder_ = std::move(*folder);
  if (const auto books = trust.read_books(); !books) return std::unexpected(books.error());
  return trust;
}

std::vector<std::string> ServerTrust::mistakes(const std::string& path) {
  const auto folder = StateFolder::open(path, StateFolder::Missing::kIsAnError, init_hint(path));
  if (!folder) return {folder.error()};
  std::vector<std::string> wrong;
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (const auto file = needed(*folder, name); !file) wrong.push_back(file.error());
  for (const char* name : {kWorkstationsFile, kCodesFile, kUsedFile, kServingFile, kAuditFile})
    if (name != std::string_view(kAuditFile) || !folder->has(name)) {
      if (const auto file = folder->read(name); !file) wrong.push_back(file.error());
    } else if (std::string trouble = folder->unfit_to_append(name); !trouble.empty()) {
      wrong.push_back(std::move(trouble));
    }
  if (std::string trouble = folder->unfit_to_write(); !trouble.empty()) wrong.push_back(std::move(trouble));
  if (!wrong.empty()) return wrong;
  if (const auto trust = open(path); !trust) wrong.push_back(trust.error());
  const auto used = folder->read(kUsedFile);
  if (used && *used)
    if (const auto book = UsedTickets::parse(text_of((*used)->bytes())); !book) wrong.push_back(folder->path_of(kUsedFile) + ": " + book.error());
  return wrong;
}

ServerTrust ServerTrust::throw_away(std::int64_t now) {
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  Secret<32> seed;
  fill_random(seed.bytes);
  return ServerTrust(Identity::make("tandem server, thrown away", serial, now), TicketKey(seed));
}

ServerTrust::~ServerTrust() {
  if (folder_ && serving_.open()) (void)folder_->remove(kServingFile);
}

std::string ServerTrust::begin_serving(std::int64_t now) {
  if (!folder_) return {};
  const auto books = folder_->lock(kLock);  // a command that looks whether a server runs must not be taken for one
  if (!books) return books.error();
  auto lock = folder_->try_lock(kServingLock);
  if (!lock) return lock.error();
  if (!*lock) return folder_->path() + ": another server runs from this folder; stop it first, or give this one a folder of its own (`run --state`, `state` in a configuration)";
  serving_ = std::move(**lock);
  if (folder_->has(kEndFile))  // meant for the server before
    if (std::string problem = folder_->remove(kEndFile); !problem.empty()) return problem;
  const auto bytes = folder_->read(kUsedFile);
  if (!bytes) return bytes.error();
  auto used = UsedTickets::parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{});
  if (!used) return folder_->path_of(kUsedFile) + ": " + used.error();
  used_ = std::move(*used);
  return rewrite_used(now);
}

std::string ServerTrust::rewrite_used(std::int64_t now) {
  used_.prune(now);
  appended_ = 0;
  return folder_->replace(kUsedFile, std::string_view(used_.to_text()));
}

std::expected<ServerTrust::Books, std::string> ServerTrust::read_books() const {
  if (!folder_) return books_;
  auto workstations = book(*folder_, kWorkstationsFile, parse_workstations);
  if (!workstations) return std::unexpected(workstations.error());
  auto codes = book(*folder_, kCodesFile, parse_codes);
  if (!codes) return std::unexpected(codes.error());
  return Books{std::move(*workstations), std::move(*codes)};
}

template <class Change>
std::string ServerTrust::change_books(Change change) {
  StateFolder::Lock held;
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
  // Workstations first: after a crash in between a code may be used twice for the same name, never a workstation be lost that was told yes.
  std::string problem;
  if (books->workstations != before.workstations) problem = folder_->replace(kWorkstationsFile, std::string_view(print_workstations(books->workstations)));
  if (problem.empty() && books->codes != before.codes) problem = folder_->replace(kCodesFile, std::string_view(print_codes(books->codes)));
  return problem;
}

std::expected<std::vector<WorkstationRow>, std::string> ServerTrust::workstations() {
  if (!folder_) return books_.workstations;
  // The stamp is taken first: a change between the two is seen by the next look-up.
  const StateFolder::Stamp now = folder_->stamp(kWorkstationsFile);
  if (now == seen_ && now != StateFolder::Stamp{}) return books_.workstations;
  auto rows = book(*folder_, kWorkstationsFile, parse_workstations);
  if (!rows) {
    seen_ = {};
    return rows;
  }
  books_.workstations = *rows;
  seen_ = now;
  return rows;
}

std::expected<std::size_t, std::string> ServerTrust::open_codes(std::int64_t now) const {
  if (!folder_) return static_cast<std::size_t>(std::ranges::count_if(books_.codes, [&](const CodeRow& c) { return now <= c.not_after; }));
  const auto books = read_books();
  if (!books) return std::unexpected(books.error());
  return static_cast<std::size_t>(std::ranges::count_if(books->codes, [&](const CodeRow& c) { return now <= c.not_after; }));
}

std::expected<std::optional<WorkstationRow>, std::string> ServerTrust::find(const Pin& workstation) {
  const auto rows = workstations();
  if (!rows) return std::unexpected(rows.error());
  const WorkstationRow* const row = find_workstation(*rows, workstation);
  return row == nullptr ? std::nullopt : std::optional(*row);
}

std::expected<WorkstationRow, ServerTrust::EnrolTrouble> ServerTrust::enrol(const EnrolmentCode& code, const Pin& pin, std::int64_t now) {
  std::expected<WorkstationRow, EnrolFault> made = std::unexpected(EnrolFault::kUnknownCode);
  std::string problem = change_books([&](Books& books) { made = trust::enrol(books.workstations, books.codes, code, pin, now); });
  if (!problem.empty()) return std::unexpected(EnrolTrouble{std::nullopt, std::move(problem)});
  if (!made) return std::unexpected(EnrolTrouble{made.error(), to_text(made.error())});
  audit(now, "enrolled", made->name, pin.hex());
  return *made;
}

std::string ServerTrust::give_out(const EnrolmentCode& code, std::string_view workstation, std::int64_t now, std::int64_t not_after) {
  std::string problem = change_books([&](Books& books) { trust::give_out(books.codes, code, workstation, now, not_after); });
  if (problem.empty()) audit(now, "code_given_out", workstation);
  return problem;
}

std::expected<Revoked, std::string> ServerTrust::revoke(std::string_view name) {
  Revoked gone;
  std::string problem = change_books([&](Books& books) { gone = trust::revoke(books.workstations, books.codes, name); });
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return gone;
}

std::string ServerTrust::enrol_directly(const WorkstationRow& row) {
  return change_books([&](Books& books) {
    std::erase_if(books.workstations, [&](const WorkstationRow& old) { return old.name == row.name || old.spki == row.spki; });
    books.workstations.push_back(row);
  });
}

std::expected<Ticket, ServerTrust::TicketTrouble> ServerTrust::redeem(std::span<const std::byte> bytes, const TicketUse& use) {
  const auto broken = [](TicketFault fault) {
    std::string text = to_text(fault);
    return std::unexpected(TicketTrouble{std::move(fault), std::move(text)});
  };
  if (folder_ && !serving_.open()) return std::unexpected(TicketTrouble{std::nullopt, "this server has not begun to serve from its folder"});
  auto ticket = check_ticket(bytes, ticket_key_.verifier(), use);
  if (!ticket) return broken(ticket.error());
  if (auto once = used_.use(*ticket, use.now); !once) return broken(once.error());
  if (folder_) {
    // Appended to, until so much has expired that the file is worth writing anew.
    std::string problem = ++appended_ > UsedTickets::kMax ? rewrite_used(use.now) : folder_->append(kUsedFile, UsedTickets::line(ticket->ticket_id, ticket->not_after));
    if (!problem.empty()) return std::unexpected(TicketTrouble{std::nullopt, std::move(problem)});
  }
  return std::move(*ticket);
}

std::string ServerTrust::give_back(const Id16& ticket) {
  used_.forget(ticket);
  if (!folder_) return {};
  ++appended_;
  return folder_->append(kUsedFile, UsedTickets::line(ticket, 0));
}

std::string ServerTrust::ask_to_end(std::uint32_t grace_s) const {
  if (!folder_) return "this server has no folder";
  return folder_->replace(kEndFile, std::string_view(std::to_string(grace_s) + "\n"));
}

std::optional<std::uint32_t> ServerTrust::asked_to_end() const {
  if (!folder_ || !folder_->has(kEndFile)) return std::nullopt;
  const auto bytes = folder_->read(kEndFile);
  if (!bytes || !*bytes) return std::nullopt;  // somebody else's file orders nothing
  const std::string text{text_of((*bytes)->bytes())};
  if (!folder_->remove(kEndFile).empty()) return std::nullopt;
  std::uint32_t grace = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), grace);
  if (error != std::errc{} || std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end)) != "\n" || grace > 3600) return std::nullopt;
  return grace;
}

std::string ServerTrust::write_serving(const ServingSpec& serving) const {
  return folder_ ? folder_->replace(kServingFile, std::string_view(print_serving(serving))) : std::string{};
}

std::expected<std::optional<ServingSpec>, std::string> ServerTrust::read_serving() const {
  if (!folder_ || !folder_->has(kServingFile)) return std::nullopt;
  const auto books = folder_->lock(kLock);
  if (!books) return std::unexpected(books.error());
  // Left behind by a server that was killed: nobody holds its lock.
  const auto lock = folder_->try_lock(kServingLock);
  if (!lock) return std::unexpected(lock.error());
  if (*lock) return std::nullopt;
  auto serving = book(*folder_, kServingFile, parse_serving);
  if (!serving) return std::unexpected(serving.error());
  return std::move(*serving);
}

void ServerTrust::audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail) const {
  if (!folder_) return;
  std::string line = "{\"ts\":" + std::to_string(now) + ",\"event\":" + quoted(event) + ",\"name\":" + quoted(name);
  if (!detail.empty()) line += ",\"detail\":" + quoted(detail);
  (void)folder_->append(kAuditFile, line + "}\n");
}

}  // namespace tandem::trust
