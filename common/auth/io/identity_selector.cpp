#include "common/auth/io/identity_selector.h"

#include <algorithm>

namespace tandem::auth {

std::expected<const Identity*, std::string> IdentitySelector::operator()(const PresentedKey& server) {
  service_.reset();
  service_before_.reset();
  server_ = server;
  auto found = find(server);
  if (found) selected_ = (*found)->fingerprint();
  return found;
}

std::expected<const Identity*, std::string> IdentitySelector::find(const PresentedKey& server) {
  std::vector<ServerRow> known;
  if (own_) {
    auto rows = own_->servers();
    if (!rows) return std::unexpected(rows.error());
    known = std::move(*rows);
    if (const auto row = std::ranges::find(known, server.sha256, &ServerRow::spki); row != known.end()) {
      service_before_ = row->service;
      const std::int64_t now = wall_seconds();
      if (row->service) {
        // The server is trusted by its own key; its statements count only if they continue the known key.
        const auto member = accept_member(server.credential, *row->service, server, now);
        service_ = member ? member->pin : *row->service;
      } else if (const auto pin = first_pin(server.credential, server, now)) {
        service_ = *pin;
      }
      return &own_->identity();
    }
    if (auto member = find_member(server, known)) return std::move(*member);
  }
  auto local = find_local_keys(runtime_, server);
  if (!local) return std::unexpected(local.error());
  if (*local) {
    local_ = std::move(*local);
    return &local_->workstation;
  }
  if (find_server(known, address_) != nullptr)
    return std::unexpected(address_ +
                           " shows another key than when this workstation was enrolled there. Either another machine "
                           "answers, or the server has new keys: ask its admin; if it has new keys, `tandem-server "
                           "enroll NAME --address " +
                           address_ + "` there and `tandem-client enroll STRING` here");
  const bool here = address_.starts_with("127.") || address_.starts_with("[::1]") || address_.starts_with("localhost:");
  if (here)
    return std::unexpected(
        "the server at " + address_ +
        " was not started by this user, or keeps its keys in a state folder. Join as the user who "
        "started it; or, if it was started with --state and this workstation is enrolled there, name "
        "the folder of this workstation's keys with --state. If it is not enrolled: "
        "`tandem-server enroll NAME` with the server's --state and `tandem-client enroll STRING` here");
  return std::unexpected("this workstation does not know the server at " + address_ +
                         ". If it is enrolled there, name the folder of this workstation's keys with --state; "
                         "otherwise run `tandem-server enroll NAME --address " +
                         address_ + "` there and `tandem-client enroll STRING` here");
}

std::optional<std::expected<const Identity*, std::string>> IdentitySelector::find_member(
    const PresentedKey& server, const std::vector<ServerRow>& known) {
  std::string why;
  for (const ServerRow& row : known) {
    if (!row.service || server.credential.empty()) continue;
    auto member = accept_member(server.credential, *row.service, server, wall_seconds());
    if (!member) {
      why = member.error();
      continue;
    }
    service_before_ = row.service;
    service_ = member->pin;
    return &own_->identity();
  }
  if (why.empty()) return std::nullopt;
  return std::unexpected(address_ + ": " + why);
}

std::string IdentitySelector::store_service(const std::vector<std::string>& members) const {
  return own_ && service_ ? own_->store_service(service_before_, server_, *service_, members) : std::string{};
}

std::expected<RuntimeDirectory, std::string> publish_local_keys(ServerKeystore& server, const std::string& runtime,
                                                                std::int64_t now) {
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  LocalKeys keys{Identity::make("tandem workstation, local", serial, now), server.ticket_key()};
  // Enrolled at any time, because clients of these keys write their own tickets.
  if (std::string problem =
          server.registry().enroll_without_code({kLocalWorkstation, keys.workstation.fingerprint().sha256, 0});
      !problem.empty())
    return std::unexpected(std::move(problem));
  return RuntimeDirectory::publish(runtime, server.identity().fingerprint(), keys);
}

}  // namespace tandem::auth
