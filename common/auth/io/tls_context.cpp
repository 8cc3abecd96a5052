#include "common/auth/io/tls_context.h"

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <array>
#include <stdexcept>

#include "common/base/raw_bytes.h"

namespace tandem::auth {
namespace {

/// Largest certificate chain accepted [bytes]; a certificate of this system has 500, and a credential 2560 at most.
constexpr long kCertificatesMax = 4096;
/// In the ALPN format: each name follows its length. The server prefers the first one that the client offers.
constexpr std::array<unsigned char, 20> kAlpnList{10,  't', 'a', 'n', 'd', 'e', 'm', '/', '1', '.',
                                                  '1', 8,   't', 'a', 'n', 'd', 'e', 'm', '/', '1'};
static_assert(kAlpnList.size() == kAlpnHeld.size() + kAlpn.size() + 2);

[[noreturn]] void fail(const char* what) {
  ERR_clear_error();
  throw std::runtime_error(std::string("TLS cannot be set up: ") + what);
}

void use(SSL_CTX* context, const Identity& identity) {
  if (SSL_CTX_use_certificate(context, identity.certificate.handle()) != 1 ||
      SSL_CTX_use_PrivateKey(context, identity.key.handle()) != 1)
    fail("the certificate and its key");
}

/// Creates the part of the context that both ends share.
asio::ssl::context make(const SSL_METHOD* method) {
  SSL_CTX* const c = SSL_CTX_new(method);
  if (c == nullptr) fail("no memory");
  asio::ssl::context owner(c);
  const bool good =
      SSL_CTX_set_min_proto_version(c, TLS1_3_VERSION) == 1 && SSL_CTX_set_max_proto_version(c, TLS1_3_VERSION) == 1 &&
      SSL_CTX_set_ciphersuites(c, "TLS_AES_256_GCM_SHA384:TLS_CHACHA20_POLY1305_SHA256") == 1 &&
      SSL_CTX_set1_groups_list(c, "X25519:P-256") == 1 && SSL_CTX_set1_sigalgs_list(c, "ECDSA+SHA256") == 1 &&
      SSL_CTX_set_num_tickets(c, 0) == 1 && SSL_CTX_set_max_early_data(c, 0) == 1;
  if (!good) fail("versions, ciphers or signatures are not in this OpenSSL");
  SSL_CTX_set_options(c, SSL_OP_NO_TICKET | SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION |
                             SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_PRIORITIZE_CHACHA);
  SSL_CTX_set_session_cache_mode(c, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_max_cert_list(c, kCertificatesMax);
  SSL_CTX_set_mode(c, SSL_MODE_RELEASE_BUFFERS);
  return owner;
}

/// Rejects a client that offers no protocol, for which OpenSSL does not call its ALPN callback.
int demand_alpn(SSL* connection, int* alert, void*) {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
  if (SSL_client_hello_get0_ext(connection, TLSEXT_TYPE_application_layer_protocol_negotiation, &data, &size) == 1)
    return SSL_CLIENT_HELLO_SUCCESS;
  *alert = SSL_AD_NO_APPLICATION_PROTOCOL;
  return SSL_CLIENT_HELLO_ERROR;
}

int choose_alpn(SSL*, const unsigned char** out, unsigned char* out_size, const unsigned char* in, unsigned int in_size,
                void*) {
  unsigned char* chosen = nullptr;  // without one in common, OpenSSL names the client's first
  if (SSL_select_next_proto(&chosen, out_size, kAlpnList.data(), kAlpnList.size(), in, in_size) !=
      OPENSSL_NPN_NEGOTIATED)
    return SSL_TLSEXT_ERR_ALERT_FATAL;
  *out = chosen;
  return SSL_TLSEXT_ERR_OK;
}

std::string_view alpn_of(SSL* connection) noexcept {
  const unsigned char* protocol = nullptr;
  unsigned int size = 0;
  SSL_get0_alpn_selected(connection, &protocol, &size);
  return {as_text(protocol), size};
}

/// Replaces OpenSSL's chain building: the leaf must contain a P-256 key. The handshake proves that the peer has its
/// private half.
int take_any_p256(X509_STORE_CTX* store, void*) {
  const X509* const leaf = X509_STORE_CTX_get0_cert(store);
  const bool good = leaf != nullptr && fingerprint_of(leaf).has_value();
  X509_STORE_CTX_set_error(store, good ? X509_V_OK : X509_V_ERR_CERT_REJECTED);
  return good ? 1 : 0;
}

}  // namespace

asio::ssl::context server_tls(const Identity& identity) {
  asio::ssl::context context = make(TLS_server_method());
  SSL_CTX* const c = context.native_handle();
  use(c, identity);
  SSL_CTX_set_client_hello_cb(c, &demand_alpn, nullptr);
  SSL_CTX_set_alpn_select_cb(c, &choose_alpn, nullptr);
  SSL_CTX_set_verify(c, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT | SSL_VERIFY_CLIENT_ONCE, nullptr);
  SSL_CTX_set_cert_verify_callback(c, &take_any_p256, nullptr);
  return context;
}

struct ClientTls::State {
  IdentityCallback judge;
  asio::ssl::context context = make(TLS_client_method());
  const Identity* identity = nullptr;
  std::string refusal;

  static int verify(X509_STORE_CTX* store, void* self) noexcept {
    State& state = *static_cast<State*>(self);
    bool good = false;
    try {
      const X509* const leaf = X509_STORE_CTX_get0_cert(store);
      const auto fingerprint =
          leaf == nullptr ? std::unexpected(std::string("the server shows no certificate")) : fingerprint_of(leaf);
      auto identity = fingerprint ? state.judge(PresentedKey(*fingerprint, credential_in(leaf)))
                                  : std::unexpected(fingerprint.error());
      good = identity.has_value() && *identity != nullptr;
      if (good) {
        state.identity = *identity;
      } else {
        state.refusal = identity ? "there is no key to show to this server" : std::move(identity.error());
      }
    } catch (...) {
      good = false;
    }
    X509_STORE_CTX_set_error(store, good ? X509_V_OK : X509_V_ERR_CERT_REJECTED);
    return good ? 1 : 0;
  }
  /// Called by OpenSSL when its own certificate is due, which is after the check of the server's.
  static int show(SSL* connection, void* self) noexcept {
    const State& state = *static_cast<const State*>(self);
    if (state.identity == nullptr) return 0;
    return SSL_use_certificate(connection, state.identity->certificate.handle()) == 1 &&
                   SSL_use_PrivateKey(connection, state.identity->key.handle()) == 1
               ? 1
               : 0;
  }
};

ClientTls::ClientTls(IdentityCallback judge) : state_(std::make_unique<State>()) {
  state_->judge = std::move(judge);
  SSL_CTX* const c = state_->context.native_handle();
  if (SSL_CTX_set_alpn_protos(c, kAlpnList.data(), kAlpnList.size()) != 0) fail("ALPN");
  SSL_CTX_set_verify(c, SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_cert_verify_callback(c, &State::verify, state_.get());
  SSL_CTX_set_cert_cb(c, &State::show, state_.get());
}

ClientTls::~ClientTls() = default;
asio::ssl::context& ClientTls::context() noexcept { return state_->context; }
const std::string& ClientTls::rejection() const noexcept { return state_->refusal; }

std::expected<KeyFingerprint, std::string> authenticated_peer(SSL* connection) {
  if (const std::string_view protocol = alpn_of(connection); protocol != kAlpn && protocol != kAlpnHeld)
    return std::unexpected("the other side does not speak " + std::string(kAlpn));
  if (SSL_version(connection) != TLS1_3_VERSION) return std::unexpected("the other side does not use TLS 1.3");
  const X509* const certificate = SSL_get0_peer_certificate(connection);
  if (certificate == nullptr || SSL_get_verify_result(connection) != X509_V_OK)
    return std::unexpected("the other side has not shown a key");
  return fingerprint_of(certificate);
}

bool peer_knows_held(SSL* connection) noexcept { return alpn_of(connection) == kAlpnHeld; }

std::expected<Secret<kExportSize>, std::string> export_secrets(SSL* connection, const ExporterContext& context) {
  const auto digest = digest_of(context);
  Secret<kExportSize> out;
  if (SSL_export_keying_material(connection, raw(out.bytes.data()), out.bytes.size(), kExporterLabel.data(),
                                 kExporterLabel.size(), raw(digest.data()), digest.size(), 1) != 1) {
    ERR_clear_error();
    return std::unexpected("TLS gives no secrets for datagrams");
  }
  return out;
}

}  // namespace tandem::auth
