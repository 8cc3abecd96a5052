#include "common/auth/io/client_keystore.h"

#include <filesystem>

#include "common/auth/io/directory_lock.h"
#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"

namespace tandem::auth {
namespace {

constexpr const char* kLock = "lock";
/// Separator of the parts of a local file.
constexpr std::string_view kPemBegins = "-----BEGIN ";

std::string local_name(const KeyFingerprint& server) { return server.hex() + ".local"; }

}  // namespace

std::expected<std::optional<ClientKeystore>, std::string> ClientKeystore::read(StateDirectory folder) {
  const auto key = folder.read(kKeyFile);
  if (!key) return std::unexpected(key.error());
  if (!*key) return std::nullopt;
  const auto certificate = folder.read(kCertificateFile);
  if (!certificate) return std::unexpected(certificate.error());
  if (!*certificate)
    return std::unexpected(folder.path_of(kCertificateFile) + " is missing; delete " + folder.path_of(kKeyFile) +
                           " and enrol again");
  auto identity = Identity::from_pem((*key)->bytes(), (*certificate)->bytes());
  if (!identity) return std::unexpected(folder.path() + ": " + identity.error());
  return ClientKeystore(std::move(folder), std::move(*identity));
}

std::expected<ClientKeystore, std::string> ClientKeystore::open_or_make(const std::string& path, std::int64_t now) {
  auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = DirectoryLock::wait(*folder, kLock);
  if (!lock) return std::unexpected(lock.error());
  folder->remove_leftovers();
  if (!folder->has(kKeyFile)) {
    const auto serial = random_bytes<std::array<std::byte, 16>>();
    const Identity made = Identity::make("tandem workstation", serial, now);
    std::string problem = folder->replace(kCertificateFile, std::string_view(made.certificate.to_pem()));
    if (problem.empty())
      problem = folder->replace(kKeyFile, made.key.to_pem().bytes());  // last: with it the workstation has a key
    if (!problem.empty()) return std::unexpected(std::move(problem));
  }
  auto client = read(std::move(*folder));
  if (!client) return std::unexpected(client.error());
  if (!*client) return std::unexpected(path + ": the workstation's key disappeared while it was read");
  return std::move(**client);
}

std::expected<std::optional<ClientKeystore>, std::string> ClientKeystore::open(const std::string& path) {
  if (std::error_code error; !std::filesystem::exists(path, error)) return std::nullopt;
  auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError);
  if (!folder) return std::unexpected(folder.error());
  return read(std::move(*folder));
}

std::expected<std::vector<ServerRow>, std::string> ClientKeystore::servers() const {
  const auto bytes = folder_.read(kServersFile);
  if (!bytes) return std::unexpected(bytes.error());
  auto rows = parse_servers(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder_.path_of(kServersFile));
  if (!rows) return std::unexpected(to_text(rows.error()) + "repair or delete that file");
  return std::move(*rows);
}

std::string ClientKeystore::store_server(const ServerRow& server) const {
  const auto lock = DirectoryLock::wait(folder_, kLock);
  if (!lock) return lock.error();
  auto rows = servers();
  if (!rows) return rows.error();
  auth::store_server(*rows, server);
  return folder_.replace(kServersFile, std::string_view(print_servers(*rows)));
}

std::string ClientKeystore::store_service(const std::optional<ServicePin>& before, const KeyFingerprint& server,
                                          const ServicePin& pin, const std::vector<std::string>& members) const {
  const auto changed = [&](std::vector<ServerRow> rows) {
    for (ServerRow& row : rows) {
      const bool own = row.spki == server.sha256 && !row.service;
      const bool same = row.service && (row.service->key == pin.key || (before && row.service->key == before->key));
      if (!own && !same) continue;
      row.service = pin;
      if (!members.empty()) row.members = members;
      if (row.members.size() > ServerRow::kMembersMax) row.members.resize(ServerRow::kMembersMax);
    }
    return rows;
  };
  // Most connections change nothing: they take no lock and write no file.
  if (const auto rows = servers(); rows && changed(*rows) == *rows) return {};
  const auto lock = DirectoryLock::wait(folder_, kLock);
  if (!lock) return lock.error();
  const auto rows = servers();
  if (!rows) return rows.error();
  return folder_.replace(kServersFile, std::string_view(print_servers(changed(*rows))));
}

std::expected<RuntimeDirectory, std::string> RuntimeDirectory::publish(const std::string& path,
                                                                       const KeyFingerprint& server,
                                                                       const LocalKeys& keys) {
  auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const SecretBuffer ticket = keys.ticket_key.to_text(), key = keys.workstation.key.to_pem();
  const std::string certificate = keys.workstation.certificate.to_pem();
  SecretBuffer all(ticket.size() + key.size() + certificate.size());
  auto out = all.bytes().begin();
  for (const std::span<const std::byte> part : {ticket.bytes(), key.bytes(), bytes_of(certificate)})
    out = std::copy(part.begin(), part.end(), out);
  if (std::string problem = folder->replace(local_name(server), std::as_const(all).bytes()); !problem.empty())
    return std::unexpected(std::move(problem));
  return RuntimeDirectory(std::move(*folder), local_name(server));
}

RuntimeDirectory::~RuntimeDirectory() {
  if (!name_.empty()) (void)folder_.remove(name_);
}

std::expected<std::optional<LocalKeys>, std::string> find_local_keys(const std::string& path,
                                                                     const KeyFingerprint& server) {
  if (std::error_code error; !std::filesystem::exists(path, error)) return std::nullopt;
  const auto folder = StateDirectory::open(path, StateDirectory::Missing::kIsAnError);
  if (!folder) return std::unexpected(folder.error());
  const std::string name = local_name(server);
  const auto bytes = folder->read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::nullopt;
  const std::span<const std::byte> all = std::as_const(**bytes).bytes();
  const std::size_t pem = text_of(all).find(kPemBegins);
  auto ticket_key = TicketKey::from_text(all.first(pem == std::string_view::npos ? 0 : pem));
  if (!ticket_key) return std::unexpected(folder->path_of(name) + " " + ticket_key.error());
  auto workstation = Identity::from_pem(all.subspan(pem), all.subspan(pem));  // each parser reads its own part
  if (!workstation) return std::unexpected(folder->path_of(name) + ": " + workstation.error());
  return LocalKeys{std::move(*workstation), std::move(*ticket_key)};
}

}  // namespace tandem::auth
