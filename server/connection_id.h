#pragma once

#include <cstdint>

namespace tandem::server {

/// Connection ids at a server: a table look-up, and nothing of an old connection. The low byte is the place in a session (a seat's
/// number plus one, visitors behind the seats), the next the session's slot, the rest is drawn for each joining.
[[nodiscard]] constexpr std::uint32_t connection_id(std::uint16_t drawn, std::uint8_t slot, std::uint8_t place) noexcept {
  return std::uint32_t{drawn} << 16 | std::uint32_t{slot} << 8 | place;
}
[[nodiscard]] constexpr std::uint8_t slot_of(std::uint32_t cid) noexcept { return static_cast<std::uint8_t>(cid >> 8); }
[[nodiscard]] constexpr std::uint8_t place_of(std::uint32_t cid) noexcept { return static_cast<std::uint8_t>(cid); }

}  // namespace tandem::server
