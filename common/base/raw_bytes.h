#pragma once

#include <cstddef>
#include <span>
#include <string_view>

/// Casts between std::byte, text and the unsigned char of OpenSSL and libsodium.
namespace tandem {

[[nodiscard]] inline unsigned char* raw(std::byte* p) noexcept { return reinterpret_cast<unsigned char*>(p); }
[[nodiscard]] inline const unsigned char* raw(const std::byte* p) noexcept {
  return reinterpret_cast<const unsigned char*>(p);
}
[[nodiscard]] inline const unsigned char* raw(const char* p) noexcept {
  return reinterpret_cast<const unsigned char*>(p);
}
[[nodiscard]] inline const std::byte* as_bytes(const char* p) noexcept { return reinterpret_cast<const std::byte*>(p); }
[[nodiscard]] inline const char* as_text(const unsigned char* p) noexcept { return reinterpret_cast<const char*>(p); }
[[nodiscard]] inline const char* as_text(const std::byte* p) noexcept { return reinterpret_cast<const char*>(p); }

[[nodiscard]] inline std::span<const std::byte> bytes_of(std::string_view text) noexcept {
  return {as_bytes(text.data()), text.size()};
}
[[nodiscard]] inline std::string_view text_of(std::span<const std::byte> bytes) noexcept {
  return {as_text(bytes.data()), bytes.size()};
}

}  // namespace tandem
