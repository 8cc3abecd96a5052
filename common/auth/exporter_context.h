#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/auth/ticket.h"

namespace tandem::auth {

/// Values to which the datagram secrets of a connection are bound. Another session, epoch, connection, role or seat
/// yields other keys.
struct ExporterContext {
  Id16 session_id{};
  std::uint64_t epoch = 0;
  std::uint32_t server_cid = 0;
  AccessRole role = AccessRole::kObserver;
  std::string_view seat;  ///< at most 255 characters
};

/// Label of the TLS exporter and size of its output: the first 32 bytes for datagrams to the server, the last 32 to the
/// client.
inline constexpr std::string_view kExporterLabel = "EXPORTER-tandem-udp-v1";
inline constexpr std::size_t kExportSize = 64;

/// Returns the SHA-256 of session_id 16 | epoch u64 | server_cid u32 | role u8 | length of seat u8 | seat; numbers
/// little-endian.
[[nodiscard]] std::array<std::byte, 32> digest_of(const ExporterContext& context) noexcept;

}  // namespace tandem::auth
