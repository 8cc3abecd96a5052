#include "client/app/server_trust.h"

#include <algorithm>

namespace tandem::client {

std::expected<const trust::Identity*, std::string> KnownServers::judge(const trust::Pin& pin) {
  if (server_.loopback()) {
    auto local = trust::find_local(trust::runtime_path(), pin);
    if (!local) return std::unexpected(local.error());
    if (*local) {
      local_.emplace(std::move(**local));
      return &local_->workstation;
    }
  }
  const auto path = trust::client_state_path(state_);
  if (!path) return std::unexpected("--state: " + path.error());
  auto own = trust::ClientTrust::open(*path);
  if (!own) return std::unexpected(own.error());
  const std::string remedy = ". If this is the server you mean, run `tandem-server enroll NAME` there and `tandem-client enroll STRING` here";
  if (!*own) return std::unexpected("the server's key is unknown here: this workstation was never enrolled anywhere" + remedy);
  const auto known = (*own)->servers();
  if (!known) return std::unexpected(known.error());
  if (std::ranges::none_of(*known, [&](const ServerRow& row) { return row.spki == pin.sha256; })) {
    const bool same_address = trust::find_server(*known, io::to_text(server_)) != nullptr;
    return std::unexpected((same_address ? "the server at " + io::to_text(server_) + " has ANOTHER KEY than it had when this workstation was enrolled, and was told nothing: somebody "
                                           "else may answer there, or it was set up anew"
                                         : "the server's key is unknown here: this workstation is not enrolled there") + remedy);
  }
  enrolled_.emplace(std::move(**own));
  return &enrolled_->identity();
}

}  // namespace tandem::client
