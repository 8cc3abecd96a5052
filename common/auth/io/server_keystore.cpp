#include "common/auth/io/server_keystore.h"

#include <utility>

#include "common/auth/io/append_file.h"
#include "common/auth/io/directory_lock.h"
#include "common/base/command_hints.h"
#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"

namespace tandem::auth {
namespace {

/// Returns the remedy for a directory without keys.
std::string init_hint(const std::string& folder) {
  return with_options("run `tandem-server init` first", "tandem-server init", server_state_option(folder));
}

/// Remedy for a directory that has lost a key: `init` would refuse it, or would make other keys.
std::string restore_hint(const std::string& folder) {
  return with_options(
      "this folder was set up before: restore the file from a backup. New keys would shut out every enrolled "
      "workstation; to start with new keys, delete the folder and run `tandem-server init`",
      "tandem-server init", server_state_option(folder));
}

/// Returns whether workstations may know keys of this directory. False also if `init` ended before it had created
/// everything: there is no key yet, and no workstation is enrolled.
bool was_set_up(const StateDirectory& folder) {
  for (const char* name : {ServerKeystore::kKeyFile, ServerKeystore::kAuditFile})
    if (folder.has(name)) return true;
  const auto book = folder.read(ServerRegistry::kWorkstationsFile);
  if (!book) return true;
  if (!*book) return false;
  const auto rows = parse_workstations(text_of((*book)->bytes()), ServerRegistry::kWorkstationsFile);
  return !rows || !rows->empty();
}

/// Reads a file that must exist.
std::expected<SecretBuffer, std::string> needed(const StateDirectory& folder, const char* name) {
  auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes)
    return std::unexpected(folder.path_of(name) + " is missing; " +
                           (was_set_up(folder) ? restore_hint(folder.path()) : init_hint(folder.path())));
  return std::move(**bytes);
}

TicketKey random_ticket_key() {
  return TicketKey(Secret<32>(std::span<const std::byte, 32>(random_bytes<std::array<std::byte, 32>>())));
}

}  // namespace

std::expected<KeyFingerprint, std::string> ServerKeystore::init(const std::string& path, std::int64_t now) {
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = DirectoryLock::wait(*folder, ServerRegistry::kLock);
  if (!lock) return std::unexpected(lock.error());
  folder->remove_leftovers();
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (folder->has(name) && was_set_up(*folder))
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
  if (problem.empty()) problem = write(ServerRegistry::kWorkstationsFile, std::string_view(print_workstations({})));
  if (problem.empty()) problem = write(ServerRegistry::kCodesFile, std::string_view(print_codes({})));
  if (problem.empty()) problem = write(kKeyFile, identity.key.to_pem().bytes());
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return identity.fingerprint();
}

std::string ServerKeystore::rotate_ticket_key(const std::string& path, std::int64_t now) {
  auto trust = open(path);
  if (!trust) return trust.error();
  if (trust->membership() != nullptr)
    return trust->folder()->path_of(kMemberFile) +
           ": this server belongs to a service, whose servers share one ticket key; replace it where the service's "
           "folder is: `tandem-server service rotate FOLDER --new-ticket-key`, then `vouch` and `join` for each server";
  // A running server holds the old key and its redeemed tickets in memory.
  if (std::string problem = trust->begin_serving(now); !problem.empty()) return problem;
  if (std::string problem = trust->folder_->replace(kTicketKeyFile, random_ticket_key().to_text().bytes());
      !problem.empty())
    return problem;
  return trust->audit(now, "ticket_key_renewed", "");
}

std::expected<ServiceMembership, std::string> ServerKeystore::join_service(const std::string& path,
                                                                           std::span<const std::byte> member,
                                                                           const std::string& file, std::int64_t now,
                                                                           bool older) {
  auto trust = open_alone(path);  // a damaged or expired membership can be renewed
  if (!trust) return std::unexpected(trust.error());
  const KeyFingerprint own = trust->identity().fingerprint();
  auto membership = read_membership(member, file, own);
  if (!membership) return std::unexpected(membership.error());
  if (std::string problem = membership_problem(membership->first, own, now); !problem.empty())
    return std::unexpected(file + ": " + problem);
  if (!older) {
    const auto bytes = trust->folder_->read(kMemberFile);
    const auto present = bytes && *bytes ? read_membership((*bytes)->bytes(), kMemberFile, own)
                                         : std::unexpected(std::string());  // a damaged one may be replaced
    if (present && is_older(membership->first, present->first))
      return std::unexpected(
          file + ": was made before the key of the service was rotated: its service key is " +
          to_hex(membership->first.service_key).substr(0, 8) + "..., that of this server's present member file is " +
          to_hex(present->first.service_key).substr(0, 8) +
          "..., which replaced it. Clients that know the rotation would reject this server. Nothing was changed. Make "
          "a "
          "member file of the new key: " +
          renewal(membership->first.name, own) +
          ". If the rotation itself was undone, by a restored backup of the service's folder, add --older");
  }
  // A running server holds the old ticket key and its redeemed tickets in memory.
  if (std::string problem = trust->begin_serving(now); !problem.empty()) return std::unexpected(std::move(problem));
  if (std::string problem = trust->folder_->replace(kMemberFile, member); !problem.empty())
    return std::unexpected(std::move(problem));
  if (std::string problem = trust->audit(now, "service_joined", membership->first.name); !problem.empty())
    return std::unexpected("the server is a member now, but the audit log has no record of it: " + problem);
  return std::move(membership->first);
}

std::expected<ServerKeystore, std::string> ServerKeystore::open(const std::string& path) {
  auto trust = open_alone(path);
  if (!trust) return trust;
  const auto bytes = trust->folder_->read(kMemberFile);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return trust;
  auto member =
      read_membership((*bytes)->bytes(), trust->folder_->path_of(kMemberFile), trust->identity().fingerprint());
  if (!member) return std::unexpected(member.error());
  // The certificate is only the container of the key. It is made again with what clients check.
  Identity identity = std::move(trust->identity_);
  identity.certificate =
      Certificate::self_signed(identity.key, "tandem server", random_bytes<std::array<std::byte, 16>>(),
                               member->first.not_before, member->first.credential());
  ServerKeystore joined(std::move(identity), std::move(member->second), trust->folder_);
  joined.membership_ = std::move(member->first);
  return joined;
}

std::expected<ServerKeystore, std::string> ServerKeystore::open_alone(const std::string& path) {
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
  ServerKeystore trust(std::move(*identity), std::move(*ticket_key),
                       std::make_shared<const StateDirectory>(std::move(*folder)));
  if (std::string problem = trust.registry_.problem(); !problem.empty()) return std::unexpected(std::move(problem));
  return trust;
}

std::vector<std::string> ServerKeystore::find_errors(const std::string& path) {
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError, init_hint(path));
  if (!folder) return {folder.error()};
  std::vector<std::string> wrong;
  for (const char* name : {kKeyFile, kCertificateFile, kTicketKeyFile})
    if (const auto file = needed(*folder, name); !file) wrong.push_back(file.error());
  for (const char* name : {ServerRegistry::kWorkstationsFile, ServerRegistry::kCodesFile, TicketRedeemer::kFile,
                           ServingFile::kFile, kMemberFile})
    if (const auto file = folder->read(name); !file) wrong.push_back(file.error());
  if (folder->has(kAuditFile))
    if (std::string trouble = AppendFile(*folder, kAuditFile, AppendFile::TornLine::kEnded).problem(); !trouble.empty())
      wrong.push_back(std::move(trouble));
  if (std::string trouble = folder->write_problem(); !trouble.empty()) wrong.push_back(std::move(trouble));
  if (!wrong.empty()) return wrong;
  const auto trust = open(path);
  if (!trust) wrong.push_back(trust.error());
  if (trust && trust->membership() != nullptr)
    if (std::string trouble = membership_problem(*trust->membership(), trust->identity().fingerprint(), wall_seconds());
        !trouble.empty())
      wrong.push_back(std::move(trouble));
  if (const auto used = TicketRedeemer::read(*folder); !used) wrong.push_back(used.error());
  return wrong;
}

ServerKeystore ServerKeystore::ephemeral(std::int64_t now) {
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  Secret<32> seed;
  fill_random(seed.bytes);
  return ServerKeystore(Identity::make("tandem server, thrown away", serial, now), TicketKey(seed), nullptr);
}

ServerKeystore::ServerKeystore(Identity identity, TicketKey ticket_key, std::shared_ptr<const StateDirectory> folder)
    : identity_(std::move(identity)),
      ticket_key_(std::move(ticket_key)),
      folder_(std::move(folder)),
      registry_(folder_, audit_),
      tickets_(ticket_key_.verifier(), folder_),
      serving_(folder_, ServerRegistry::kLock) {}

std::string ServerKeystore::begin_serving(std::int64_t now) {
  if (!folder_) return {};
  if (membership_)
    if (std::string problem = membership_problem(*membership_, identity_.fingerprint(), now); !problem.empty())
      return problem;
  // A command that checks for a running server must not be mistaken for one.
  const auto lists = DirectoryLock::wait(*folder_, ServerRegistry::kLock);
  if (!lists) return lists.error();
  if (std::string problem = serving_.begin(); !problem.empty()) return problem;
  folder_->remove_leftovers();
  return tickets_.begin(now);
}

std::string ServerKeystore::audit(std::int64_t now, std::string_view event, std::string_view name,
                                  std::string_view detail) {
  return folder_ ? audit_->write(*folder_, now, event, name, detail) : std::string{};
}

std::string ServerKeystore::retry_audit(std::int64_t now) {
  return folder_ ? audit_->retry(*folder_, now) : std::string{};
}

}  // namespace tandem::auth
