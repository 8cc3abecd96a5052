#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/service/fenced_writer.h"

namespace tandem::server {

/// State of a member for operators.
struct ServiceStatus {
  bool registered = false;  ///< under its name, with a lease
  bool name_taken = false;  ///< another server is registered under this name
  bool follows = false;     ///< the copies of the directory follow the store
  bool answers = false;     ///< the store has answered within twice the limit of an answer
  /// The copies follow the store, and its newest answer is no older than one and a half periods of renewal: a watch
  /// alone notices the silence of the store seconds later.
  bool current = false;
  std::optional<Time> answered{};  ///< time of the store's newest answer; nullopt: none yet
  bool holding = true;             ///< no hand may be engaged
  std::string trouble;             ///< the store's newest error since its last answer
  /// Time since the sending of the newest renewal that counts [s]; nullopt: no lease.
  std::optional<double> lease_age_s{};
  std::size_t owned = 0, members = 0, sessions = 0;
  std::uint64_t unanswered = 0;  ///< requests without an answer
  std::uint64_t moves = 0;       ///< sessions that this server has begun to move to others
  std::uint64_t losses = 0;      ///< times at which the directory was begun from nothing, or put back
  bool recovers = false;         ///< after that: sessions are not claimed yet
  bool stranger = false;         ///< it does not know the directory from before, and claims no session yet
  FencedWriter::Counters writes{};
  std::int64_t voucher_ends = 0;  ///< last second of this server's voucher, since 1970, UTC; 0: unknown

  /// Sessions of this server are HELD by the directory.
  [[nodiscard]] bool held() const noexcept { return holding && owned > 0; }
};

}  // namespace tandem::server
