#include "common/trust/io/server_trust.h"

#include <charconv>

#include "common/base/printed_command.h"
#include "common/base/raw_bytes.h"
#include "proto/trust_text.h"

namespace tandem::trust {
namespace {

constexpr const char* kUsedHint = "; delete that line (its ticket is then good again), or the file once 12 h have passed";
/// What to do about a folder without keys.
std::string init_hint(const std::string& folder) { return with_options("run `tandem-server init` first", "tandem-server init", server_state_option(folder)); }

/// A file that must be there.
std::expected<SecretBuffer, std::string> needed(const StateFolder& folder, const char* name) {
  auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::unexpected(folder.path_of(name) + " is missing; " + init_hint(folder.path()));
  return std::move(**bytes);
}

/// Whether `init` was ended before it had made everything: there is no key yet, and nobody is enrolled.
bool half_made(const StateFolder& folder, const char* key, const char* audit, const char* workstations) {
  if (folder.has(key) || folder.has(audit)) return false;
  const auto book = folder.read(workstations);
  return book && (!*book || parse_workstations(text_of((*book)->bytes()), workstations).value_or(std::vector<WorkstationRow>(1)).empty());
}

TicketKey random_ticket_key() { return TicketKey(Secret<32>(std::span<const std::byte, 32>(random_bytes<std::array<std::byte, 32>>()))); }

}  // namespace

std::expected<Pin, std::string> ServerTrust::init(const std::string& path, std::int64_t now) {
  const auto folder = StateFolder::open(path, StateFolder::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = folder->lock(kLock);
  if (!lock) return std::unexpected(lock.error());
  folder->remove_leftovers();
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (folder->has(name) && !half_made(*folder, kKeyFile, kAuditFile, kWorkstationsFile))
      return std::unexpected(folder->path_of(name) + " exists already: this folder was set up before. New keys would shut out every enrolled workstation; "
                                                     "to begin anew all the same, delete the folder");
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  const Identity identity = Identity::make("tandem server", serial, now);
  const TicketKey ticket_key = random_ticket_key();
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

std::string ServerTrust::renew_ticket_key(const std::string& path, std::int64_t now) {
  auto trust = open(path);
  if (!trust) return trust.error();
  // A server that runs holds the old key in memory, and its used tickets.
  if (std::string problem = trust->begin_serving(now); !problem.empty()) return problem;
  if (std::string problem = trust->folder_->replace(kTicketKeyFile, random_ticket_key().to_text().bytes()); !problem.empty()) return problem;
  return trust->audit(now, "ticket_key_renewed", "");
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
  for (const char* name : {kWorkstationsFile, kCodesFile, kUsedFile, kServingFile})
    if (const auto file = folder->read(name); !file) wrong.push_back(file.error());
  if (folder->has(kAuditFile))
    if (std::string trouble = folder->unfit_to_append(kAuditFile, StateFolder::TornLine::kEnded); !trouble.empty()) wrong.push_back(std::move(trouble));
  if (std::string trouble = folder->unfit_to_write(); !trouble.empty()) wrong.push_back(std::move(trouble));
  if (!wrong.empty()) return wrong;
  if (const auto trust = open(path); !trust) wrong.push_back(trust.error());
  const auto used = folder->read(kUsedFile);
  if (used && *used)
    if (const auto book = UsedTickets::parse(text_of((*used)->bytes())); !book) wrong.push_back(folder->path_of(kUsedFile) + ": " + book.error() + kUsedHint);
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
  if (!*lock) return folder_->path() + ": another server runs from this folder: " + folder_->holder_of(kServingLock) + "; stop it first, or give this one a folder of its own (`run --state`, `state` in a configuration)";
  serving_ = std::move(**lock);
  folder_->remove_leftovers();
  if (folder_->has(kEndFile))  // meant for the server before
    if (std::string problem = folder_->remove(kEndFile); !problem.empty()) return problem;
  const auto bytes = folder_->read(kUsedFile);
  if (!bytes) return bytes.error();
  auto used = UsedTickets::parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{});
  if (!used) return folder_->path_of(kUsedFile) + ": " + used.error() + kUsedHint;
  used_ = std::move(*used);
  return rewrite_used(now);
}

std::string ServerTrust::rewrite_used(std::int64_t now) {
  used_.prune(now);
  appended_ = 0;
  std::string problem = folder_->replace(kUsedFile, std::string_view(used_.to_text()));
  used_unsure_ = !problem.empty();
  return problem;
}

std::string ServerTrust::write_used(const Id16& ticket, std::int64_t not_after, std::int64_t now) {
  // Appended to, until so much has expired that the file is worth writing anew, or until nobody knows what it holds.
  if (used_unsure_ || ++appended_ > UsedTickets::kMax) return rewrite_used(now);
  std::string problem = folder_->append(kUsedFile, UsedTickets::line(ticket, not_after));
  used_unsure_ = !problem.empty();
  return problem;
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
  if (folder_)
    if (std::string problem = write_used(ticket->ticket_id, ticket->not_after, use.now); !problem.empty()) {
      used_.forget(ticket->ticket_id);  // nobody gets in, so nothing is used up
      return std::unexpected(TicketTrouble{std::nullopt, std::move(problem)});
    }
  return std::move(*ticket);
}

std::string ServerTrust::give_back(const Id16& ticket) {
  used_.forget(ticket);
  return folder_ ? write_used(ticket, 0, 0) : std::string{};
}

std::string ServerTrust::ask_to_end(std::uint32_t grace_s) const {
  if (!folder_) return "this server has no folder";
  const auto lock = folder_->lock(kLock);
  if (!lock) return lock.error();
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

std::string ServerTrust::audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail) {
  return folder_ ? audit_.write(*folder_, now, event, name, detail) : std::string{};
}

std::string ServerTrust::retry_audit(std::int64_t now) { return folder_ ? audit_.retry(*folder_, now) : std::string{}; }

}  // namespace tandem::trust
