#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/access_role.h"

/// The rows of the books that servers and workstations keep (proto/trust.proto), as plain structs. Times: seconds since 1970, UTC.
namespace tandem {

using Sha256 = std::array<std::byte, 32>;

struct WorkstationRow {
  std::string name;   ///< 1 to 32 of A-Z a-z 0-9 _ -
  Sha256 spki{};      ///< of its key
  std::int64_t enrolled_at = 0;
  friend bool operator==(const WorkstationRow&, const WorkstationRow&) = default;
};

/// A one-time code that was given out and not used yet.
struct CodeRow {
  Sha256 hash{};
  std::string workstation;
  std::int64_t not_after = 0;
  friend bool operator==(const CodeRow&, const CodeRow&) = default;
};

/// A server a workstation knows.
struct ServerRow {
  std::string address;  ///< HOST:PORT as it was dialled
  Sha256 spki{};
  std::string name;     ///< what the server calls this workstation
  friend bool operator==(const ServerRow&, const ServerRow&) = default;
};

/// What a running server tells the commands beside it, so that a ticket can be written for a session by its name or code.
struct OpenSeat {
  std::string name;
  AccessRole role = AccessRole::kTrainee;
  bool taken = false, required = false;
  friend bool operator==(const OpenSeat&, const OpenSeat&) = default;
};
struct OpenSession {
  std::array<std::byte, 16> id{};
  std::string code;  ///< 10 base32 characters; empty: tickets only
  std::string name;
  std::uint64_t epoch = 0;
  std::vector<OpenSeat> seats;
  std::string phase{};  ///< waiting, running, paused, stopped, ending; empty: not known
  friend bool operator==(const OpenSession&, const OpenSession&) = default;
};
/// What a running server writes down about itself.
struct ServingSpec {
  std::string address;  ///< HOST:PORT it listens on
  std::vector<OpenSession> sessions;
  friend bool operator==(const ServingSpec&, const ServingSpec&) = default;
};

}  // namespace tandem
