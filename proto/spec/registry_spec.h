#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/spec/access_role.h"

/// Rows of the registry files of servers and workstations (proto/schema/registry.proto) as plain structs. Times are
/// seconds since 1970, UTC.
namespace tandem {

using Sha256 = std::array<std::byte, 32>;

struct WorkstationRow {
  std::string name;  ///< 1 to 32 of A-Z a-z 0-9 _ -
  Sha256 spki{};     ///< of its key
  std::int64_t enrolled_at = 0;
  friend bool operator==(const WorkstationRow&, const WorkstationRow&) = default;
};

/// A one-time code that is issued and not yet used.
struct CodeRow {
  Sha256 hash{};
  std::string workstation;
  std::int64_t not_after = 0;
  friend bool operator==(const CodeRow&, const CodeRow&) = default;
};

/// Public keys of a service by which a workstation recognises its servers [Ed25519].
struct ServicePin {
  std::array<std::byte, 32> key{};
  std::array<std::byte, 32> previous{};  ///< the key before the newest change
  std::int64_t previous_until = 0;       ///< last second in which vouchers of `previous` count; 0: none does
  friend bool operator==(const ServicePin&, const ServicePin&) = default;
};

/// A server that a workstation knows.
struct ServerRow {
  static constexpr std::size_t kMembersMax = 16;

  std::string address;  ///< HOST:PORT as dialled
  Sha256 spki{};
  std::string name;                     ///< name of this workstation at the server
  std::optional<ServicePin> service{};  ///< the server's service; nullopt: it belongs to none
  std::vector<std::string> members{};   ///< HOST:PORT of the servers of that service, at most kMembersMax
  friend bool operator==(const ServerRow&, const ServerRow&) = default;
};

/// Membership of a server in a service, as its member file has it. No signature is checked.
struct MemberRow {
  std::string name;                                 ///< of the server in the service
  std::array<std::byte, 32> service_key{};          ///< public key of the service
  std::string ticket_key;                           ///< the line of a ticket key; secret
  std::vector<std::byte> voucher;                   ///< an encoded statement (proto/rpc/service_codec.h)
  std::vector<std::vector<std::byte>> key_changes;  ///< encoded statements, oldest first
  friend bool operator==(const MemberRow&, const MemberRow&) = default;
};

/// A server for which its service has vouched.
struct VouchedRow {
  static constexpr std::size_t kMax = 4096;  ///< in one file

  std::string name;  ///< of the server in the service
  Sha256 spki{};
  std::int64_t not_after = 0;  ///< last second of the voucher
  friend bool operator==(const VouchedRow&, const VouchedRow&) = default;
};

/// A session that a running server publishes for commands on the same machine. They use it to write a ticket for a
/// session given by name or code.
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
  std::string phase{};  ///< waiting, running, paused, stopped, ending; empty: unknown
  friend bool operator==(const OpenSession&, const OpenSession&) = default;
};
/// State that a running server writes to serving.textproto.
struct ServingSpec {
  std::string address;  ///< HOST:PORT that the server listens on
  std::vector<OpenSession> sessions;
  friend bool operator==(const ServingSpec&, const ServingSpec&) = default;
};

}  // namespace tandem
