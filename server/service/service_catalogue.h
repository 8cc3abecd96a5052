#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/directory/prefix_follower.h"
#include "server/service/service_keys.h"
#include "server/service/service_session.h"

namespace tandem::server {

/// Copy of all sessions of a service, those of other servers included. The copy may be old.
class ServiceCatalogue {
 public:
  /// Sessions beyond this number are counted, not kept.
  static constexpr std::size_t kSessionsMax = 16384;

  struct Entry {
    std::optional<ServiceSession> spec;
    std::string spec_text, listed_text;
    std::string move_to;  ///< name of a server; empty: no move is wanted
    std::string home;     ///< server to which an operator has moved it; empty: any
  };
  using Entries = std::map<std::string, Entry, std::less<>>;

  explicit ServiceCatalogue(ServiceKeys keys) : keys_(std::move(keys)), follower_(keys_.catalogue()) {}

  /// Returns the request to begin now, if there is one.
  [[nodiscard]] std::optional<directory::Request> poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after) {
    return follower_.poll_request(now, operation, retry_after);
  }
  /// Takes a reply. Returns whether it belongs to the catalogue.
  bool on_reply(const directory::Reply& reply);

  [[nodiscard]] bool follows() const noexcept { return follower_.follows(); }
  /// Has everything read again.
  void read_again() noexcept { follower_.restart(); }
  /// Times at which everything was read.
  [[nodiscard]] std::uint64_t readings() const noexcept { return follower_.readings(); }
  [[nodiscard]] const Entries& entries() const noexcept { return entries_; }
  /// Null: unknown, or its text cannot be read.
  [[nodiscard]] const ServiceSession* find(std::string_view name) const;
  /// Name of the session with this id, code or name; with neither, of the only session. Empty: there is none.
  [[nodiscard]] std::string name_of(const rpc::SessionChoice& choice) const;
  /// Keys that could not be read, or did not fit.
  [[nodiscard]] std::uint64_t rejected() const noexcept { return rejected_; }
  /// Rises with each change.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }

 private:
  void apply(const directory::Change& change);

  ServiceKeys keys_;
  directory::PrefixFollower follower_;
  Entries entries_;
  std::uint64_t rejected_ = 0, version_ = 0;
};

}  // namespace tandem::server
