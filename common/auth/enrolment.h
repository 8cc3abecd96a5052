#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/auth/key_fingerprint.h"
#include "common/base/secret.h"

namespace tandem::auth {

/// Single-use secret that enrols one workstation: 128 random bits, 26 characters as text. The server stores only its
/// hash.
using EnrolmentCode = Secret<16>;
using CodeHash = std::array<std::byte, 32>;

/// Returns the SHA-256 of a label and the code. A code has 128 random bits, so no slow hash is needed.
[[nodiscard]] CodeHash hash_of(const EnrolmentCode& code) noexcept;

/// The string that a user copies to a new workstation: the server's address, its key fingerprint and the code.
struct EnrolmentString {
  static constexpr std::size_t kAddressMax = 96;

  std::string address;  ///< HOST:PORT that the workstation connects to, 1 to 96 printable characters
  KeyFingerprint server;
  EnrolmentCode code;

  /// Returns `tandem:` and base32 of: version 1 | length of the address | address | fingerprint 32 | code 16 | first 4
  /// bytes of the SHA-256 of all before.
  /// @return empty if the address is too long or not printable
  [[nodiscard]] std::string to_text() const;
  /// @return the parts, or the reason for rejection; that does not repeat the text, which contains a secret
  [[nodiscard]] static std::expected<EnrolmentString, std::string> from_text(std::string_view text);
};

/// Returns the name of a session among enrolled workstations: 10 base32 characters, 50 bits of the 7 random bytes
/// passed in.
[[nodiscard]] std::string session_code(std::span<const std::byte, 7> random);
/// Returns the canonical form of a typed session code: 10 upper-case characters; nullopt if the text is not a session
/// code.
[[nodiscard]] std::optional<std::string> canonical_session_code(std::string_view typed);

}  // namespace tandem::auth
