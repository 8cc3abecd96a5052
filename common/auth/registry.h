#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/enrolment.h"
#include "common/auth/key_fingerprint.h"
#include "proto/spec/registry_spec.h"

/// Decisions on the registry: which workstations are enrolled and which codes are valid. Values in, values out; file
/// access is in common/auth/io.
namespace tandem::auth {

/// The lists of workstations and codes of a server.
struct RegistryLists {
  std::vector<WorkstationRow> workstations;
  std::vector<CodeRow> codes;
  friend bool operator==(const RegistryLists&, const RegistryLists&) = default;
};

/// Most workstations, and most codes, of a server (proto/schema/registry.proto).
inline constexpr std::size_t kRegistryRowsMax = 4096;

/// Returns whether a name has 1 to 32 characters of A-Z a-z 0-9 _ -
[[nodiscard]] bool is_valid_name(std::string_view name) noexcept;

/// @return the workstation with this key; null if it is not enrolled (or was revoked)
[[nodiscard]] const WorkstationRow* find_workstation(const std::vector<WorkstationRow>& book,
                                                     const KeyFingerprint& fingerprint) noexcept;
[[nodiscard]] const WorkstationRow* find_workstation(const std::vector<WorkstationRow>& book,
                                                     std::string_view name) noexcept;

/// Issues a code. An older code for the same name becomes invalid, and expired codes are removed.
void issue_code(std::vector<CodeRow>& codes, const EnrolmentCode& code, std::string_view workstation, std::int64_t now,
                std::int64_t not_after);

enum class EnrollError : std::uint8_t {
  kUnknownCode,  ///< never issued, used, replaced by a newer one, or expired and removed
  kExpired,
  kKeyTaken,  ///< this key is enrolled under another name
  kBookFull,
};
[[nodiscard]] std::string to_text(EnrollError fault);

/// Enrols a workstation: consumes the code and binds its name to this key. A reinstalled machine can thus replace its
/// old key under the same name. A rejection changes nothing, except that an expired code is removed.
/// @return the new row
[[nodiscard]] std::expected<WorkstationRow, EnrollError> enroll(std::vector<WorkstationRow>& book,
                                                                std::vector<CodeRow>& codes, const EnrolmentCode& code,
                                                                const KeyFingerprint& fingerprint, std::int64_t now);

struct Revoked {
  std::size_t workstations = 0, codes = 0;
};
/// Removes a name from both lists: its key is rejected from then on, and an unused code becomes invalid.
[[nodiscard]] Revoked revoke(std::vector<WorkstationRow>& book, std::vector<CodeRow>& codes, std::string_view name);

/// Returns the stored data of the server at `address`; null if it is unknown.
[[nodiscard]] const ServerRow* find_server(const std::vector<ServerRow>& known, std::string_view address) noexcept;
/// Adds a server, or replaces the stored data of the same address.
void store_server(std::vector<ServerRow>& known, const ServerRow& server);

}  // namespace tandem::auth
