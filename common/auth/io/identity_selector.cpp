#include "common/auth/io/identity_selector.h"

#include <algorithm>

namespace tandem::auth {

std::expected<const Identity*, std::string> IdentitySelector::operator()(const KeyFingerprint& server) {
  auto found = find(server);
  if (found) selected_ = (*found)->fingerprint();
  return found;
}

std::expected<const Identity*, std::string> IdentitySelector::find(const KeyFingerprint& server) {
  std::vector<ServerRow> known;
  if (own_) {
    auto rows = own_->servers();
    if (!rows) return std::unexpected(rows.error());
    known = std::move(*rows);
    if (std::ranges::find(known, server.sha256, &ServerRow::spki) != known.end()) return &own_->identity();
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
                           "enroll NAME` there and `tandem-client enroll STRING` here");
  const bool here = address_.starts_with("127.") || address_.starts_with("[::1]") || address_.starts_with("localhost:");
  if (here)
    return std::unexpected("the server at " + address_ +
                           " was not started by this user, or keeps its keys in a state folder. Join as the user who "
                           "started it; or, if it was started with --state, run "
                           "`tandem-server enroll NAME` with that --state and `tandem-client enroll STRING` here");
  return std::unexpected("this workstation does not know the server at " + address_ +
                         "; run `tandem-server enroll NAME` there and `tandem-client enroll STRING` here");
}

std::expected<RuntimeDirectory, std::string> publish_local_keys(ServerKeystore& server, const std::string& runtime,
                                                                std::int64_t now) {
  const auto serial = random_bytes<std::array<std::byte, 16>>();
  LocalKeys keys{Identity::make("tandem workstation, local", serial, now), server.ticket_key()};
  if (std::string problem =
          server.registry().enroll_without_code({kLocalWorkstation, keys.workstation.fingerprint().sha256, now});
      !problem.empty())
    return std::unexpected(std::move(problem));
  return RuntimeDirectory::publish(runtime, server.identity().fingerprint(), keys);
}

}  // namespace tandem::auth
