#pragma once

#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <optional>
#include <string>
#include <string_view>

#include "common/auth/tls_key.h"
#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::server::test {

/// A blocking TCP connection of an unknown sender. Its generous timeout makes a mistake fail the test instead of
/// hanging it.
class RawTcp {
 public:
  explicit RawTcp(const io::SocketAddress& to) : fd_(::socket(to.family(), SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval timeout{30, 0};
    setsockopt(fd_.get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    connected = ::connect(fd_.get(), to.get(), to.size) == 0;
  }
  bool send(std::string_view bytes) const {
    return ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// Reads until the other side closes. @return nullopt if it did not
  [[nodiscard]] std::optional<std::string> read_to_end() const {
    std::string all;
    char part[4096];
    while (true) {
      const ssize_t n = ::recv(fd_.get(), part, sizeof part, 0);
      if (n == 0 || (n < 0 && errno == ECONNRESET)) return all;
      if (n < 0) return std::nullopt;
      all.append(part, static_cast<std::size_t>(n));
    }
  }
  void close() { fd_.reset(); }
  [[nodiscard]] int get() const { return fd_.get(); }
  bool connected = false;

 private:
  io::Fd fd_;
};

/// Options of a TLS client that may violate the protocol.
struct RawTlsWish {
  int version_min = TLS1_3_VERSION, version_max = TLS1_3_VERSION;
  std::optional<std::string> alpn = "tandem/1";
  const auth::Identity* identity = nullptr;
  const char* ciphersuites = nullptr;
};
class RawTls {
 public:
  RawTls(const io::SocketAddress& to, const RawTlsWish& wish) : tcp_(to), context_(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_security_level(context_, 0);  // also allows old versions
    SSL_CTX_set_min_proto_version(context_, wish.version_min);
    SSL_CTX_set_max_proto_version(context_, wish.version_max);
    if (wish.ciphersuites != nullptr) SSL_CTX_set_ciphersuites(context_, wish.ciphersuites);
    if (wish.identity != nullptr) {
      SSL_CTX_use_certificate(context_, wish.identity->certificate.handle());
      SSL_CTX_use_PrivateKey(context_, wish.identity->key.handle());
    }
    tls_ = SSL_new(context_);
    if (wish.alpn) {
      const std::string list = static_cast<char>(wish.alpn->size()) + *wish.alpn;
      SSL_set_alpn_protos(tls_, reinterpret_cast<const unsigned char*>(list.data()),
                          static_cast<unsigned>(list.size()));
    }
    SSL_set_fd(tls_, tcp_.get());
    handshake = SSL_connect(tls_) == 1;
  }
  ~RawTls() {
    SSL_free(tls_);
    SSL_CTX_free(context_);
  }
  RawTls(const RawTls&) = delete;
  RawTls& operator=(const RawTls&) = delete;

  /// Reads until the server closes the connection or the timeout passes. @return the received bytes; empty if TLS
  /// itself rejected the client
  [[nodiscard]] std::string read_to_end() const {
    std::string all;
    char part[4096];
    int n = 0;
    while ((n = SSL_read(tls_, part, sizeof part)) > 0) all.append(part, static_cast<std::size_t>(n));
    return all;
  }
  [[nodiscard]] std::string read(std::size_t size) const {
    std::string all(size, '\0');
    std::size_t got = 0;
    while (got < size) {
      const int n = SSL_read(tls_, all.data() + got, static_cast<int>(size - got));
      if (n <= 0) break;
      got += static_cast<std::size_t>(n);
    }
    all.resize(got);
    return all;
  }
  bool write(std::string_view bytes) const { return SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size())) > 0; }
  bool handshake = false;

 private:
  RawTcp tcp_;
  SSL_CTX* context_ = nullptr;
  SSL* tls_ = nullptr;
};

}  // namespace tandem::server::test
