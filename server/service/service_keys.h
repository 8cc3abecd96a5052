#pragma once

#include <string>
#include <string_view>

namespace tandem::server {

/// Names of a service's keys below the prefix of its directory, besides those of `directory::DirectoryKeys`:
///
///     catalogue/SESSION/spec     text of the session (ServiceSession)
///     catalogue/SESSION/listed   its phase and seats
///     catalogue/SESSION/move     server to which an operator moves the session, or kAnyServer; empty: none
///     catalogue/SESSION/home     server to which an operator has moved it, so that it stays there; empty: any
///     snapshots/SESSION          newest snapshot; apart from the catalogue, which all servers follow
///     consoles/SESSION           its consoles (ServiceConsoles); apart from the snapshot, which older servers write
///     writes/SERVER              empty; its revision is that of the server's newest write of values (FencedWriter)
class ServiceKeys {
 public:
  /// @param prefix  begins and ends with "/"
  explicit ServiceKeys(std::string prefix) : prefix_(std::move(prefix)) {}

  [[nodiscard]] std::string catalogue() const { return prefix_ + "catalogue/"; }
  [[nodiscard]] std::string spec(std::string_view session) const { return catalogue() + std::string(session) + kSpec; }
  [[nodiscard]] std::string listed(std::string_view session) const {
    return catalogue() + std::string(session) + kListed;
  }
  [[nodiscard]] std::string move(std::string_view session) const { return catalogue() + std::string(session) + kMove; }
  [[nodiscard]] std::string home(std::string_view session) const { return catalogue() + std::string(session) + kHome; }
  [[nodiscard]] std::string snapshot(std::string_view session) const {
    return prefix_ + "snapshots/" + std::string(session);
  }
  [[nodiscard]] std::string consoles(std::string_view session) const {
    return prefix_ + "consoles/" + std::string(session);
  }
  [[nodiscard]] std::string writes(std::string_view server) const { return prefix_ + "writes/" + std::string(server); }

  static constexpr const char* kSpec = "/spec";
  static constexpr const char* kListed = "/listed";
  static constexpr const char* kMove = "/move";
  static constexpr const char* kHome = "/home";
  /// Text of a key `move`: the session may be at any server again. No server has this name.
  static constexpr const char* kAnyServer = "*";

 private:
  std::string prefix_;
};

}  // namespace tandem::server
