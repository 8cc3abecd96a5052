#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// Another server of the service that serves a session.
struct ServerLocation {
  std::string address;              ///< HOST:PORT of its control connection
  std::array<std::byte, 32> key{};  ///< SHA-256 of its public key
  std::vector<std::byte> voucher;   ///< signed by the service's key, as that server published it
  std::string session;              ///< name
  std::uint64_t revision = 0;       ///< of its ownership; a client obeys the highest one that it has seen
};

/// Where the sessions of a service are, as this server knows it. Control plane's thread.
class SessionLocator {
 public:
  struct Here {};
  struct Coming {
    std::uint32_t retry_after_ms = 300;
  };  ///< a server is about to own it: ask again
  struct Unknown {
    std::string why;
  };  ///< the directory does not answer, or has never answered
  struct None {};
  using Found = std::variant<None, Here, ServerLocation, Coming, Unknown>;
  virtual ~SessionLocator() = default;
  /// Finds a session by id, code or name. Begins to take it over if it has no owner.
  [[nodiscard]] virtual Found locate(const rpc::SessionChoice& choice) = 0;
  /// Session that this server does not serve, for lists, with the name of its server; empty: a server is about to.
  struct Elsewhere {
    rpc::ListedSession session;
    std::string server;
  };
  [[nodiscard]] virtual std::vector<Elsewhere> elsewhere() const = 0;
  /// Addresses of members, this one first, at most 16, for clients that look for a new owner.
  [[nodiscard]] virtual std::vector<std::string> members() const = 0;
  /// Whether this copy of the directory follows the store, which answers; false: lists may be old, and say so.
  [[nodiscard]] virtual bool fresh() const noexcept = 0;
};

}  // namespace tandem::server
