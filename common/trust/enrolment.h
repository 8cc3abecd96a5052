#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/trust/pin.h"
#include "common/base/secret.h"

namespace tandem::trust {

/// The secret that lets one workstation in, once: 128 random bits, 26 characters as text. The server keeps its hash only.
using EnrolmentCode = Secret<16>;
using CodeHash = std::array<std::byte, 32>;

/// SHA-256 of a label and the code: a code has 128 random bits, so no slow hash is needed.
[[nodiscard]] CodeHash hash_of(const EnrolmentCode& code) noexcept;

/// All a new workstation must be told, in one string for a person to copy: where the server is, what its key is, and the code.
struct EnrolmentString {
  static constexpr std::size_t kAddressMax = 96;

  std::string address;  ///< HOST:PORT as the workstation shall dial it, 1 to 96 printable characters
  Pin server;
  EnrolmentCode code;

  /// `tandem:` and base32 of: version 1 | length of the address | address | pin 32 | code 16 | first 4 bytes of the SHA-256 of all before.
  /// @return empty if the address is too long or not printable
  [[nodiscard]] std::string to_text() const;
  /// @return the parts, or what is wrong with the text (the text itself is not repeated: it holds a secret)
  [[nodiscard]] static std::expected<EnrolmentString, std::string> from_text(std::string_view text);
};

/// Names a session among enrolled workstations: 10 base32 characters, 50 random bits of the 7 bytes handed in.
[[nodiscard]] std::string session_code(std::span<const std::byte, 7> random);
/// The one form of what a person typed: 10 upper-case characters; nothing if it is none.
[[nodiscard]] std::optional<std::string> canonical_session_code(std::string_view typed);

}  // namespace tandem::trust
