#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/trust/enrolment.h"
#include "common/trust/pin.h"
#include "proto/trust_spec.h"

/// Decisions over the books: who is enrolled, what a code is good for. Values in, values out; files are common/trust/io.
namespace tandem::trust {

/// 1 to 32 characters of A-Z a-z 0-9 _ -
[[nodiscard]] bool legal_name(std::string_view name) noexcept;

/// @return the workstation with this key; null: it is not enrolled (or was revoked)
[[nodiscard]] const WorkstationRow* find_workstation(const std::vector<WorkstationRow>& book, const Pin& pin) noexcept;
[[nodiscard]] const WorkstationRow* find_workstation(const std::vector<WorkstationRow>& book, std::string_view name) noexcept;

/// Gives out a code: an older one for the same name is no longer good, and expired ones are forgotten.
void give_out(std::vector<CodeRow>& codes, const EnrolmentCode& code, std::string_view workstation, std::int64_t now, std::int64_t not_after);

enum class EnrolFault : std::uint8_t {
  kUnknownCode,   ///< never given out, used already, replaced by a newer one, or expired and forgotten
  kExpired,
  kKeyTaken,      ///< this key is enrolled under another name
  kBookFull,
};
[[nodiscard]] std::string to_text(EnrolFault fault);

/// Takes a workstation in: the code is gone, and the name stands for this key from now on (a machine that was set up anew takes its old
/// name with a new key). Changes nothing when refused, but an expired code goes.
/// @return the row that was made
[[nodiscard]] std::expected<WorkstationRow, EnrolFault> enrol(std::vector<WorkstationRow>& book, std::vector<CodeRow>& codes,
                                                              const EnrolmentCode& code, const Pin& pin, std::int64_t now);

struct Revoked {
  std::size_t workstations = 0, codes = 0;
};
/// Takes a name out of both books: its key is refused from now on, and a code not used yet is void.
[[nodiscard]] Revoked revoke(std::vector<WorkstationRow>& book, std::vector<CodeRow>& codes, std::string_view name);

/// What the client at hand knows of `address`; null: nothing.
[[nodiscard]] const ServerRow* find_server(const std::vector<ServerRow>& known, std::string_view address) noexcept;
/// Adds, or replaces what was known of the same address.
void remember(std::vector<ServerRow>& known, const ServerRow& server);

}  // namespace tandem::trust
