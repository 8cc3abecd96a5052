#pragma once

#include <cstdint>

#include "proto/rpc/rpc_limits.h"

namespace tandem::server {

/// Connection id of a client at the server. The low byte is the place in a session: the seat's number plus one, then
/// places of link tests and of watchers. The next byte is the session's slot. The upper two bytes are drawn at random
/// for each join, so that old ids match nothing.
[[nodiscard]] constexpr std::uint32_t connection_id(std::uint16_t drawn, std::uint8_t slot,
                                                    std::uint8_t place) noexcept {
  return std::uint32_t{drawn} << 16 | std::uint32_t{slot} << 8 | place;
}
[[nodiscard]] constexpr std::uint8_t slot_of(std::uint32_t cid) noexcept { return static_cast<std::uint8_t>(cid >> 8); }
static_assert(rpc::kSessionsMax == 1 + slot_of(0xffffffff), "a server has as many sessions as there are slots");
[[nodiscard]] constexpr std::uint8_t place_of(std::uint32_t cid) noexcept { return static_cast<std::uint8_t>(cid); }

}  // namespace tandem::server
