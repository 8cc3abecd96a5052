#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/rpc/rpc_limits.h"

/// Structs of the messages about a service, which is several servers with the same sessions (proto/schema/rpc.proto).
namespace tandem::rpc {

/// Reply of a server that does not serve the session which a request names: another server of the service does.
struct Elsewhere {
  std::string address;              ///< HOST:PORT of its control connections, at most kAddressMax
  std::array<std::byte, 32> key{};  ///< SHA-256 of its public key
  std::vector<std::byte> voucher;   ///< ServiceStatement or MemberCredential, 1 ... kVoucherMax; not checked here
  std::string session;              ///< a name
  std::optional<Id> id{};           ///< nullopt: the request named no id
  /// Of the ownership of the session; rises with each change of its server. A client obeys the highest it has seen.
  std::uint64_t revision = 0;
  friend bool operator==(const Elsewhere&, const Elsewhere&) = default;
};

}  // namespace tandem::rpc
