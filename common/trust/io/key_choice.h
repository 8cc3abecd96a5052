#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "common/trust/io/client_trust.h"
#include "common/trust/io/server_trust.h"

namespace tandem::trust {

/// A client's judge of a server's key (ClientTls::Judge), and what it shows in return. The server's key is known before the client's is
/// due, so one handshake is enough and nothing is tried: first the servers this workstation was enrolled at, by their keys (a server that
/// moved is the same server), then what a server of this very user laid down in the runtime folder.
class KeyChoice {
 public:
  /// @param address  as dialled  @param own  nothing: this workstation was never enrolled  @param runtime  runtime_path()
  KeyChoice(std::string address, std::optional<ClientTrust> own, std::string runtime)
      : address_(std::move(address)), own_(std::move(own)), runtime_(std::move(runtime)) {}

  [[nodiscard]] std::expected<const Identity*, std::string> operator()(const Pin& server);
  /// What the runtime folder had, if that is what was chosen: the client writes its tickets itself then.
  [[nodiscard]] const LocalKeys* local() const noexcept { return local_ ? &*local_ : nullptr; }

 private:
  std::string address_;
  std::optional<ClientTrust> own_;
  std::string runtime_;
  std::optional<LocalKeys> local_;
};

/// The server's side on loopback: makes a workstation `local`, enrols it, lays its keys down in `runtime` as long as the result lives.
[[nodiscard]] std::expected<LocalRuntime, std::string> let_local_in(ServerTrust& server, const std::string& runtime, std::int64_t now);

}  // namespace tandem::trust
