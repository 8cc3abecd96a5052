#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/app/join_client.h"
#include "common/io/socket_address.h"
#include "proto/spec/registry_spec.h"

namespace tandem::client {

/// Addresses at which a client tries to connect, at most.
inline constexpr std::size_t kAddressesTried = 32;

/// Sets the server and the alternatives of the options. A name may have several addresses.
/// @param text  HOST:PORT, or several separated by commas: servers of one service
/// @return the error; empty if at least one address was found
[[nodiscard]] std::string set_server_addresses(std::string_view text, JoinOptions& options);

/// Addresses at which a client tries to connect, each once, in this order: first those that are known, then those of
/// names. A name is resolved only when all addresses before it have failed, so that a DNS server that does not answer
/// delays no attempt at a known address.
class ServerAddresses {
 public:
  /// @param options  its resolver and signals; no address is taken from it
  explicit ServerAddresses(const JoinOptions& options) : resolver_(options.names), signals_(options.signals) {}

  /// Adds an address that is not in the list yet.
  void add(const io::SocketAddress& address);
  /// Adds HOST:PORT, a name or an address.
  void add(std::string_view text);
  /// Number of addresses, and of names without address.
  [[nodiscard]] std::size_t size() const noexcept { return known_.size() + names_.size(); }

  /// Begins to go through the list. Names without address are resolved again.
  /// @param names_wait   longest time to wait for all names together
  /// @param names_until  end of the waiting
  void begin(Duration names_wait, Time names_until = Time::max()) noexcept;
  /// Returns whether there is an address `i`. Resolves names, one at a time, while there is none.
  [[nodiscard]] bool has(std::size_t i);
  const io::SocketAddress& operator[](std::size_t i) const noexcept { return known_[i]; }

  /// Addresses that are known so far.
  [[nodiscard]] const std::vector<io::SocketAddress>& known() const noexcept { return known_; }
  /// True if a name may have an address the next time, because its lookup lasts.
  [[nodiscard]] bool pending() const noexcept { return pending_; }
  /// True if a signal has interrupted `has`.
  [[nodiscard]] bool interrupted() const noexcept { return interrupted_; }
  /// Returns why names have no address; empty: no lookup failed.
  [[nodiscard]] std::string unresolved() const;

 private:
  struct Name {
    std::string text, why;
  };
  io::NameResolver resolver_;
  int signals_;
  std::vector<io::SocketAddress> known_;
  std::vector<Name> names_;  ///< without address
  std::size_t next_ = 0;     ///< name to resolve next
  Duration wait_{};          ///< time that is left for the names
  Time until_{};             ///< end of the waiting for names
  bool pending_ = false, interrupted_ = false;
};

/// Returns the addresses to try: those of the options, then those of the servers that the workstation has learnt from
/// any of them.
/// @param known  servers at which the workstation is enrolled
[[nodiscard]] ServerAddresses addresses_to_try(const JoinOptions& options, const std::vector<ServerRow>& known);

}  // namespace tandem::client
