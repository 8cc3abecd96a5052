#pragma once

#include <asio/ssl/context.hpp>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/base/secret.h"
#include "common/trust/link_context.h"
#include "common/trust/tls_key.h"

/// TLS as both ends of a control connection speak it: version 1.3 only, ALPN `tandem/1` demanded by both, no tickets, no early data, no
/// renegotiation, AES-256-GCM or ChaCha20-Poly1305, X25519 or P-256, ECDSA on P-256; both sides show a certificate, of which nothing but
/// the key is believed. Chains, names and dates are not looked at: pins decide.
namespace tandem::trust {

inline constexpr std::string_view kAlpn = "tandem/1";

/// Takes every client that proves a P-256 key; whether the key is enrolled is judged after the handshake, in the book as it stands then.
/// @throws std::runtime_error
[[nodiscard]] asio::ssl::context server_tls(const Identity& identity);

/// A client's side of one connection. The server's key is judged within the handshake, before this side has sent anything but its greeting:
/// a server with a wrong key learns neither the workstation's certificate nor a ticket.
class ClientTls {
 public:
  /// Called once per handshake with the key that the server shows.
  /// @return the identity to show it (kept alive by who gave it), or why this server is refused
  using Judge = std::function<std::expected<const Identity*, std::string>(const Pin& server)>;

  /// @throws std::runtime_error
  explicit ClientTls(Judge judge);
  ~ClientTls();
  ClientTls(const ClientTls&) = delete;
  ClientTls& operator=(const ClientTls&) = delete;

  [[nodiscard]] asio::ssl::context& context() noexcept;
  /// What the judge said when it refused; empty: it did not.
  [[nodiscard]] const std::string& refusal() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// After a handshake: the peer's pin, or why the connection may not be used (another protocol, no certificate).
[[nodiscard]] std::expected<Pin, std::string> proven_peer(SSL* connection);

/// The datagrams' secrets of this connection: equal at both ends, and nowhere else.
[[nodiscard]] std::expected<Secret<kExportSize>, std::string> export_secrets(SSL* connection, const LinkContext& context);

}  // namespace tandem::trust
