#pragma once

#include <asio/ssl/context.hpp>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/auth/exporter_context.h"
#include "common/auth/tls_key.h"
#include "common/base/secret.h"

/// TLS of a control connection, for both ends. Version 1.3 only; both ends require ALPN `tandem/1.1` or `tandem/1`. A
/// client offers both, and the server prefers `tandem/1.1`, so each end knows what the other one can read
/// (proto/rpc/older_peers.h). No tickets, no early data, no renegotiation. AES-256-GCM or ChaCha20-Poly1305, X25519 or
/// P-256, ECDSA on P-256. Both sides present a certificate, of which only the key is used. Chains, names and dates are
/// ignored, because fingerprints decide.
namespace tandem::auth {

inline constexpr std::string_view kAlpn = "tandem/1";
inline constexpr std::string_view kAlpnHeld =
    "tandem/1.1";  ///< the same frames; the client knows rpc::SessionPhase::kHeld

/// Returns a context that accepts every client that proves a P-256 key. Whether the key is enrolled is checked after
/// the handshake, in the list as it is then.
/// @throws std::runtime_error
[[nodiscard]] asio::ssl::context server_tls(const Identity& identity);

/// A client's side of one connection. The server's key is checked within the handshake, when this side has sent only
/// its ClientHello. A server with a wrong key receives neither the workstation's certificate nor a ticket.
class ClientTls {
 public:
  /// Called once per handshake with the key that the server presents.
  /// @return the identity to present (the callback's owner keeps it alive), or why this server is rejected
  using IdentityCallback = std::function<std::expected<const Identity*, std::string>(const PresentedKey& server)>;

  /// @throws std::runtime_error
  explicit ClientTls(IdentityCallback judge);
  ~ClientTls();
  ClientTls(const ClientTls&) = delete;
  ClientTls& operator=(const ClientTls&) = delete;

  [[nodiscard]] asio::ssl::context& context() noexcept;
  /// Returns the reason for which the callback rejected the server; empty: it did not.
  [[nodiscard]] const std::string& rejection() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the peer's fingerprint after a handshake, or why the connection may not be used (another protocol, no
/// certificate).
[[nodiscard]] std::expected<KeyFingerprint, std::string> authenticated_peer(SSL* connection);

/// Returns whether the two ends of a connection chose `kAlpnHeld`. @pre the handshake is over
[[nodiscard]] bool peer_knows_held(SSL* connection) noexcept;

/// Returns the datagram secrets of this connection, which only its two ends know.
[[nodiscard]] std::expected<Secret<kExportSize>, std::string> export_secrets(SSL* connection,
                                                                             const ExporterContext& context);

}  // namespace tandem::auth
