#include "common/trust/io/client_trust.h"

#include <filesystem>

#include "common/base/raw_bytes.h"
#include "proto/trust_text.h"

namespace tandem::trust {
namespace {

constexpr const char* kLock = "lock";
/// Between the parts of a local file.
constexpr std::string_view kPemBegins = "-----BEGIN ";

std::string local_name(const Pin& server) { return server.hex() + ".local"; }

}  // namespace

std::expected<std::optional<ClientTrust>, std::string> ClientTrust::read(StateFolder folder) {
  const auto key = folder.read(kKeyFile);
  if (!key) return std::unexpected(key.error());
  if (!*key) return std::nullopt;
  const auto certificate = folder.read(kCertificateFile);
  if (!certificate) return std::unexpected(certificate.error());
  if (!*certificate) return std::unexpected(folder.path_of(kCertificateFile) + " is missing; delete " + folder.path_of(kKeyFile) + " and enrol anew");
  auto identity = Identity::from_pem((*key)->bytes(), (*certificate)->bytes());
  if (!identity) return std::unexpected(folder.path() + ": " + identity.error());
  return ClientTrust(std::move(folder), std::move(*identity));
}

std::expected<ClientTrust, std::string> ClientTrust::open_or_make(const std::string& path, std::int64_t now) {
  auto folder = StateFolder::open(path, StateFolder::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const auto lock = folder->lock(kLock);
  if (!lock) return std::unexpected(lock.error());
  folder->remove_leftovers();
  if (!folder->has(kKeyFile)) {
    const auto serial = random_bytes<std::array<std::byte, 16>>();
    const Identity made = Identity::make("tandem workstation", serial, now);
    std::string problem = folder->replace(kCertificateFile, std::string_view(made.certificate.to_pem()));
    if (problem.empty()) problem = folder->replace(kKeyFile, made.key.to_pem().bytes());  // last: with it the workstation has a key
    if (!problem.empty()) return std::unexpected(std::move(problem));
  }
  auto client = read(std::move(*folder));
  if (!client) return std::unexpected(client.error());
  if (!*client) return std::unexpected(path + ": the workstation's key went away while it was read");
  return std::move(**client);
}

std::expected<std::optional<ClientTrust>, std::string> ClientTrust::open(const std::string& path) {
  if (std::error_code error; !std::filesystem::exists(path, error)) return std::nullopt;
  auto folder = StateFolder::open(path, StateFolder::Missing::kIsAnError);
  if (!folder) return std::unexpected(folder.error());
  return read(std::move(*folder));
}

std::expected<std::vector<ServerRow>, std::string> ClientTrust::servers() const {
  const auto bytes = folder_.read(kServersFile);
  if (!bytes) return std::unexpected(bytes.error());
  auto rows = parse_servers(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder_.path_of(kServersFile));
  if (!rows) return std::unexpected(to_text(rows.error()) + "mend or delete that file");
  return std::move(*rows);
}

std::string ClientTrust::remember(const ServerRow& server) const {
  const auto lock = folder_.lock(kLock);
  if (!lock) return lock.error();
  auto rows = servers();
  if (!rows) return rows.error();
  trust::remember(*rows, server);
  return folder_.replace(kServersFile, std::string_view(print_servers(*rows)));
}

std::expected<LocalRuntime, std::string> LocalRuntime::publish(const std::string& path, const Pin& server, const LocalKeys& keys) {
  auto folder = StateFolder::open(path, StateFolder::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  const SecretBuffer ticket = keys.ticket_key.to_text(), key = keys.workstation.key.to_pem();
  const std::string certificate = keys.workstation.certificate.to_pem();
  SecretBuffer all(ticket.size() + key.size() + certificate.size());
  auto out = all.bytes().begin();
  for (const std::span<const std::byte> part : {ticket.bytes(), key.bytes(), bytes_of(certificate)}) out = std::copy(part.begin(), part.end(), out);
  if (std::string problem = folder->replace(local_name(server), std::as_const(all).bytes()); !problem.empty()) return std::unexpected(std::move(problem));
  return LocalRuntime(std::move(*folder), local_name(server));
}

LocalRuntime::~LocalRuntime() {
  if (!name_.empty()) (void)folder_.remove(name_);
}

std::expected<std::optional<LocalKeys>, std::string> find_local(const std::string& path, const Pin& server) {
  if (std::error_code error; !std::filesystem::exists(path, error)) return std::nullopt;
  const auto folder = StateFolder::open(path, StateFolder::Missing::kIsAnError);
  if (!folder) return std::unexpected(folder.error());
  const std::string name = local_name(server);
  const auto bytes = folder->read(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return std::nullopt;
  const std::span<const std::byte> all = std::as_const(**bytes).bytes();
  const std::size_t pem = text_of(all).find(kPemBegins);
  auto ticket_key = TicketKey::from_text(all.first(pem == std::string_view::npos ? 0 : pem));
  if (!ticket_key) return std::unexpected(folder->path_of(name) + " " + ticket_key.error());
  auto workstation = Identity::from_pem(all.subspan(pem), all.subspan(pem));  // each reader takes the part that is its own
  if (!workstation) return std::unexpected(folder->path_of(name) + ": " + workstation.error());
  return LocalKeys{std::move(*workstation), std::move(*ticket_key)};
}

}  // namespace tandem::trust
