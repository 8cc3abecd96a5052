#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "common/io/socket_address.h"

namespace tandem::io {

/// Finds the addresses of names for callers that wait for a limited time and can be interrupted. The lookup itself,
/// getaddrinfo(3), cannot: it blocks for 5 s to 20 s if the DNS server does not answer. So each lookup has a thread
/// that no other thread waits for. Its result is kept for the next call with the same text if it comes too late for the
/// first one. For any thread. Copies share their lookups.
class NameResolver {
 public:
  using Addresses = std::vector<SocketAddress>;
  /// Returns the addresses of HOST:PORT, or the error. It may block. For several threads at a time.
  using Lookup = std::function<std::expected<Addresses, std::string>(const std::string& text)>;
  struct Failure {
    enum class Kind : std::uint8_t {
      kUnknown,      ///< the lookup found no address
      kPending,      ///< no result yet; a later call may get it
      kInterrupted,  ///< `signals` was readable
    } kind = Kind::kUnknown;
    std::string text;  ///< for users
  };

  static constexpr std::size_t kLookupsMax = 8;  ///< at a time; beyond them, a call fails with kPending

  explicit NameResolver(Lookup lookup);
  /// Returns the resolver that the whole program shares (`resolve_addresses`).
  [[nodiscard]] static const NameResolver& system();

  /// Returns the addresses of HOST:PORT. A host that is an address needs no lookup.
  /// @param wait     longest time for the result
  /// @param signals  file that interrupts the wait when it is readable; -1: none
  [[nodiscard]] std::expected<Addresses, Failure> resolve(std::string_view text, Duration wait, int signals) const;

 private:
  struct Pending;
  struct Shared;
  [[nodiscard]] std::shared_ptr<Pending> pending(const std::string& text) const;

  std::shared_ptr<Shared> shared_;
};

}  // namespace tandem::io
