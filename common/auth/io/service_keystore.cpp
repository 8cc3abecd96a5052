#include "common/auth/io/service_keystore.h"

#include <algorithm>

#include "common/auth/io/directory_lock.h"
#include "common/base/raw_bytes.h"
#include "proto/text/service_text.h"

namespace tandem::auth {
namespace {

constexpr const char* kServiceInitHint = "run `tandem-server service init FOLDER` first";

TicketKey random_service_key() {
  Secret<32> seed;
  fill_random(seed.bytes);
  return TicketKey(seed);
}

std::expected<TicketKey, std::string> key_in(const StateDirectory& folder, const char* name, std::string_view label) {
  const auto bytes = folder.read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::unexpected(folder.path_of(name) + " is missing; " + kServiceInitHint);
  auto key = TicketKey::from_text((*bytes)->bytes(), label);
  if (!key) return std::unexpected(folder.path_of(name) + " " + key.error());
  return key;
}

bool announces(std::span<const std::byte> change, const rpc::PublicKey& key) {
  const auto statement = rpc::decode_service_statement(change);
  const auto content = statement ? rpc::decode_key_change_content(statement->content) : std::nullopt;
  return content && content->new_key == key;
}

}  // namespace

std::expected<rpc::PublicKey, std::string> ServiceKeystore::init(const std::string& path) {
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = DirectoryLock::wait(*folder, kLock);
  if (!lock) return std::unexpected(lock.error());
  folder->remove_leftovers();
  if (folder->has(kKeyFile))
    return std::unexpected(folder->path_of(kKeyFile) +
                           " exists already: this folder is that of a service. With another key, no workstation would "
                           "recognise its servers; `tandem-server service rotate` changes the key");
  const TicketKey key = random_service_key(), ticket_key = random_service_key();
  // The key is written last: with it the folder counts as set up.
  std::string problem = folder->replace(kTicketKeyFile, std::as_const(ticket_key).to_text().bytes());
  if (problem.empty()) problem = folder->replace(kChangesFile, std::string_view(print_service({})));
  if (problem.empty()) problem = folder->replace(kKeyFile, key.to_text(TicketKey::kServiceLabel).bytes());
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return key.verifier().key;
}

std::expected<ServiceKeystore, std::string> ServiceKeystore::open(const std::string& path) {
  auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError, kServiceInitHint);
  if (!folder) return std::unexpected(folder.error());
  auto key = key_in(*folder, kKeyFile, TicketKey::kServiceLabel);
  if (!key) return std::unexpected(key.error());
  auto ticket_key = key_in(*folder, kTicketKeyFile, TicketKey::kTicketLabel);
  if (!ticket_key) return std::unexpected(ticket_key.error());
  const auto bytes = folder->read(kChangesFile);
  if (!bytes) return std::unexpected(bytes.error());
  auto changes = parse_service(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder->path_of(kChangesFile));
  if (!changes) return std::unexpected(to_text(changes.error()) + "repair that file from a copy");
  // A rotation that ended between its two writes has announced a key that was lost: no client may follow to it.
  if (!changes->empty() && !announces(changes->back(), key->verifier().key)) changes->pop_back();
  return ServiceKeystore(std::move(*folder), std::move(*key), std::move(*ticket_key), std::move(*changes));
}

std::expected<SecretBuffer, std::string> ServiceKeystore::vouch(const Voucher& voucher) const {
  auto statement = sign_voucher(voucher, key_);
  if (!statement) return std::unexpected(std::move(statement.error()));
  const SecretBuffer line = ticket_key_.to_text();
  MemberRow row{voucher.name, public_key(), std::string(text_of(line.bytes().first(line.size() - 1))),
                std::move(*statement), key_changes_};
  std::string text = print_member(row);
  wipe(row.ticket_key);
  SecretBuffer out{bytes_of(text)};
  wipe(text);
  return out;
}

std::expected<std::optional<VouchedRow>, std::string> ServiceKeystore::enter(const Voucher& voucher,
                                                                             std::int64_t now) const {
  const auto lock = DirectoryLock::wait(folder_, kLock);
  if (!lock) return std::unexpected(lock.error());
  const auto bytes = folder_.read(kVouchedFile);
  if (!bytes) return std::unexpected(bytes.error());
  auto rows = parse_vouched(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder_.path_of(kVouchedFile));
  if (!rows) return std::unexpected(to_text(rows.error()) + "repair or delete that file");
  const VouchedRow made{voucher.name, voucher.server.sha256, voucher.not_after};
  std::erase_if(*rows, [&](const VouchedRow& row) {
    return row.not_after < now || (row.name == made.name && row.spki == made.spki);
  });
  std::optional<VouchedRow> other;
  for (const VouchedRow& row : *rows)
    if (row.name == made.name && (!other || row.not_after >= other->not_after)) other = row;
  rows->push_back(made);
  if (rows->size() > VouchedRow::kMax) rows->erase(std::ranges::min_element(*rows, {}, &VouchedRow::not_after));
  if (std::string problem = folder_.replace(kVouchedFile, std::string_view(print_vouched(*rows))); !problem.empty())
    return std::unexpected(std::move(problem));
  return other;
}

std::expected<rpc::PublicKey, std::string> ServiceKeystore::rotate(const std::string& path, std::int64_t now,
                                                                   std::int64_t grace, bool new_tickets) {
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError, kServiceInitHint);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = DirectoryLock::wait(*folder, kLock);
  if (!lock) return std::unexpected(lock.error());
  auto service = open(path);
  if (!service) return std::unexpected(service.error());
  const TicketKey next = random_service_key();
  auto change = sign_key_change({service->public_key(), next.verifier().key, now, now + grace}, service->key_);
  if (!change) return std::unexpected(std::move(change.error()));
  auto changes = service->key_changes_;
  changes.push_back(std::move(*change));
  if (changes.size() > rpc::kKeyChangesMax) changes.erase(changes.begin());
  // The statement first: a key without its statement would shut out every client.
  std::string problem = folder->replace(kChangesFile, std::string_view(print_service(changes)));
  if (problem.empty() && new_tickets) problem = folder->replace(kTicketKeyFile, random_service_key().to_text().bytes());
  if (problem.empty()) problem = folder->replace(kKeyFile, next.to_text(TicketKey::kServiceLabel).bytes());
  if (!problem.empty()) return std::unexpected(std::move(problem));
  return next.verifier().key;
}

}  // namespace tandem::auth
