#include "common/auth/io/server_keystore.h"

#include <charconv>

#include "common/base/command_hints.h"
#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"

namespace tandem::auth {
namespace {

constexpr const char* kUsedHint =
    "; delete that line (its ticket is then valid again), or the file once 12 h have passed";
/// Returns the remedy for a directory without keys.
std::string init_hint(const std::string& folder) {
  return with_options("run `tandem-server init` first", "tandem-server init", server_state_option(folder));
}

/// Reads a file that must exist.
std::expected<SecretBuffer, std::string> needed(const StateDirectory& folder, const char* name) {
  auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::unexpected(folder.path_of(name) + " is missing; " + init_hint(folder.path()));
  return std::move(**bytes);
}

/// Returns whether `init` ended before it had created everything: there is no key yet, and no workstation is enrolled.
bool half_made(const StateDirectory& folder, const char* key, const char* audit, const char* workstations) {
  if (folder.has(key) || folder.has(audit)) return false;
  const auto book = folder.read(workstations);
  return book &&
         (!*book ||
          parse_workstations(text_of((*book)->bytes()), workstations).value_or(std::vector<WorkstationRow>(1)).empty());
}

TicketKey random_ticket_key() {
  return TicketKey(Secret<32>(std::span<const std::byte, 32>(random_bytes<std::array<std::byte, 32>>())));
}

}  // namespace

std::expected<KeyFingerprint, std::string> ServerKeystore::init(const std::string& path, std::int64_t now) {
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = folder->lock(kLock);
  if (!lock) return std::unexpected(lock.error());
  folder->remove_leftovers();
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (folder->has(name) && !half_made(*folder, kKeyFile, kAuditFile, kWorkstationsFile))
      return std::unexpected(
          folder->path_of(name) +
          " exists already: this folder was set up before. New keys would shut out every enrolled workstation; "
          "to start with new keys, delete the folder");
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  const Identity identity = Identity::make("tandem server", serial, now);
  const TicketKey ticket_key = random_ticket_key();
  const auto write = [&folder](const char* name, auto&& bytes) { return folder->replace(name, bytes); };
  // The key is written last: with it the directory counts as set up.
  std::string problem = write(kTicketKeyFile, ticket_key.to_text().bytes());
  if (problem.empty()) problem = write(kCertificateFile, std::string_view(identity.certificate.to_pem()));
  if (problem.empty()) problem = write(kWorkstationsFile, std::string_view(print_workstations({})));
  if (problem.empty()) problem = write(kCodesFile, std::string_view(print_codes({})));
  if (problem.empty()) problem = write(kKeyFile, identity.key.to_pem().bytes());
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return identity.fingerprint();
}

std::string ServerKeystore::rotate_ticket_key(const std::string& path, std::int64_t now) {
  auto trust = open(path);
  if (!trust) return trust.error();
  // A running server holds the old key and its redeemed tickets in memory.
  if (std::string problem = trust->begin_serving(now); !problem.empty()) return problem;
  if (std::string problem = trust->folder_->replace(kTicketKeyFile, random_ticket_key().to_text().bytes());
      !problem.empty())
    return problem;
  return trust->audit(now, "ticket_key_renewed", "");
}

std::expected<ServerKeystore, std::string> ServerKeystore::open(const std::string& path) {
  auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError, init_hint(path));
  if (!folder) return std::unexpected(folder.error());
  const auto key = needed(*folder, kKeyFile), certificate = needed(*folder, kCertificateFile),
             ticket = needed(*folder, kTicketKeyFile);
  for (const auto* file : {&key, &certificate, &ticket})
    if (!*file) return std::unexpected(file->error());
  auto identity = Identity::from_pem(key->bytes(), certificate->bytes());
  if (!identity) return std::unexpected(folder->path() + ": " + identity.error());
  auto ticket_key = TicketKey::from_text(ticket->bytes());
  if (!ticket_key) return std::unexpected(folder->path_of(kTicketKeyFile) + " " + ticket_key.error());
  ServerKeystore trust(std::move(*identity), std::move(*ticket_key));
  trust.folder_ = std::move(*folder);
  if (const auto books = trust.read_books(); !books) return std::unexpected(books.error());
  return trust;
}

std::vector<std::string> ServerKeystore::find_errors(const std::string& path) {
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError, init_hint(path));
  if (!folder) return {folder.error()};
  std::vector<std::string> wrong;
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (const auto file = needed(*folder, name); !file) wrong.push_back(file.error());
  for (const char* name : {kWorkstationsFile, kCodesFile, kUsedFile, kServingFile})
    if (const auto file = folder->read(name); !file) wrong.push_back(file.error());
  if (folder->has(kAuditFile))
    if (std::string trouble = folder->append_problem(kAuditFile, StateDirectory::TornLine::kEnded); !trouble.empty())
      wrong.push_back(std::move(trouble));
  if (std::string trouble = folder->write_problem(); !trouble.empty()) wrong.push_back(std::move(trouble));
  if (!wrong.empty()) return wrong;
  if (const auto trust = open(path); !trust) wrong.push_back(trust.error());
  const auto used = folder->read(kUsedFile);
  if (used && *used)
    if (const auto book = RedeemedTickets::parse(text_of((*used)->bytes())); !book)
      wrong.push_back(folder->path_of(kUsedFile) + ": " + book.error() + kUsedHint);
  return wrong;
}

ServerKeystore ServerKeystore::ephemeral(std::int64_t now) {
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  Secret<32> seed;
  fill_random(seed.bytes);
  return ServerKeystore(Identity::make("tandem server, thrown away", serial, now), TicketKey(seed));
}

ServerKeystore::~ServerKeystore() {
  if (folder_ && serving_.open()) (void)folder_->remove(kServingFile);
}

std::string ServerKeystore::begin_serving(std::int64_t now) {
  if (!folder_) return {};
  const auto books = folder_->lock(kLock);  // a command that checks for a running server must not be mistaken for one
  if (!books) return books.error();
  auto lock = folder_->try_lock(kServingLock);
  if (!lock) return lock.error();
  if (!*lock)
    return folder_->path() + ": another server runs from this folder: " + folder_->holder_of(kServingLock) +
           "; stop it first, or give this one a folder of its own (`run --state`, `state` in a configuration)";
  serving_ = std::move(**lock);
  folder_->remove_leftovers();
  if (folder_->has(kEndFile))  // meant for the previous server
    if (std::string problem = folder_->remove(kEndFile); !problem.empty()) return problem;
  const auto bytes = folder_->read(kUsedFile);
  if (!bytes) return bytes.error();
  auto used = RedeemedTickets::parse(*bytes ? text_of((*bytes)->bytes()) : std::string_view{});
  if (!used) return folder_->path_of(kUsedFile) + ": " + used.error() + kUsedHint;
  used_ = std::move(*used);
  return rewrite_used(now);
}

std::string ServerKeystore::rewrite_used(std::int64_t now) {
  used_.prune(now);
  appended_ = 0;
  std::string problem = folder_->replace(kUsedFile, std::string_view(used_.to_text()));
  used_unsure_ = !problem.empty();
  return problem;
}

std::string ServerKeystore::write_used(const Id16& ticket, std::int64_t not_after, std::int64_t now) {
  // Lines are appended until enough have expired to rewrite the file, or until its content is uncertain.
  if (used_unsure_ || ++appended_ > RedeemedTickets::kMax) return rewrite_used(now);
  std::string problem = folder_->append(kUsedFile, RedeemedTickets::line(ticket, not_after));
  used_unsure_ = !problem.empty();
  return problem;
}

std::expected<Ticket, ServerKeystore::RedeemFailure> ServerKeystore::redeem(std::span<const std::byte> bytes,
                                                                            const TicketUse& use) {
  const auto broken = [](TicketError fault) {
    std::string text = to_text(fault);
    return std::unexpected(RedeemFailure{std::move(fault), std::move(text)});
  };
  if (folder_ && !serving_.open())
    return std::unexpected(RedeemFailure{std::nullopt, "this server has not begun to serve from its folder"});
  auto ticket = check_ticket(bytes, ticket_key_.verifier(), use);
  if (!ticket) return broken(ticket.error());
  if (auto once = used_.redeem(*ticket, use.now); !once) return broken(once.error());
  if (folder_)
    if (std::string problem = write_used(ticket->ticket_id, ticket->not_after, use.now); !problem.empty()) {
      used_.forget(ticket->ticket_id);  // no client is admitted, so the ticket is not used
      return std::unexpected(RedeemFailure{std::nullopt, std::move(problem)});
    }
  return std::move(*ticket);
}

std::string ServerKeystore::restore_ticket(const Id16& ticket) {
  used_.forget(ticket);
  return folder_ ? write_used(ticket, 0, 0) : std::string{};
}

std::string ServerKeystore::request_shutdown(std::uint32_t grace_s) const {
  if (!folder_) return "this server has no folder";
  const auto lock = folder_->lock(kLock);
  if (!lock) return lock.error();
  return folder_->replace(kEndFile, std::string_view(std::to_string(grace_s) + "\n"));
}

std::optional<std::uint32_t> ServerKeystore::requested_shutdown() const {
  if (!folder_ || !folder_->has(kEndFile)) return std::nullopt;
  const auto bytes = folder_->read(kEndFile);
  if (!bytes || !*bytes) return std::nullopt;  // a file with wrong owner or mode is not a request
  const std::string text{text_of((*bytes)->bytes())};
  if (!folder_->remove(kEndFile).empty()) return std::nullopt;
  std::uint32_t grace = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), grace);
  if (error != std::errc{} ||
      std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end)) != "\n" || grace > 3600)
    return std::nullopt;
  return grace;
}

std::string ServerKeystore::write_serving(const ServingSpec& serving) const {
  return folder_ ? folder_->replace(kServingFile, std::string_view(print_serving(serving))) : std::string{};
}

std::string ServerKeystore::audit(std::int64_t now, std::string_view event, std::string_view name,
                                  std::string_view detail) {
  return folder_ ? audit_.write(*folder_, now, event, name, detail) : std::string{};
}

std::string ServerKeystore::retry_audit(std::int64_t now) {
  return folder_ ? audit_.retry(*folder_, now) : std::string{};
}

}  // namespace tandem::auth
