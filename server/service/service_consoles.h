#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// Consoles that a session has at its owner: the text of key `consoles/SESSION`. The next owner lets them in by the
/// tickets that they have, if the owner dies. A key of its own beside the snapshot, which older servers read and write
/// without it.
struct ServiceConsoles {
  using Ticket = std::array<std::byte, 16>;
  static constexpr std::size_t kTicketsMax = 64;  ///< further consoles need a new ticket at the next owner

  rpc::Id session{};            ///< another session may have had the name before
  std::uint64_t epoch = 0;      ///< of the owner that wrote it
  std::vector<Ticket> tickets;  ///< ids of the tickets by which they were admitted, at most kTicketsMax
  friend bool operator==(const ServiceConsoles&, const ServiceConsoles&) = default;
};

/// Longest text that is read [bytes].
inline constexpr std::size_t kServiceConsolesMax = 4096;

/// As JSON, with the first kTicketsMax tickets.
[[nodiscard]] std::string to_text(const ServiceConsoles& consoles);
/// Reads any text. Returns nothing if it is longer than kServiceConsolesMax, if a value is missing, has the wrong type
/// or is out of range. Unknown keys are ignored: they are of a newer version.
[[nodiscard]] std::optional<ServiceConsoles> parse_service_consoles(std::string_view text);

/// Returns the tickets of a text for the next owner of a session. None of it counts if it is of another session, or if
/// an owner without this list wrote the newest snapshot: its consoles are not known.
/// @param snapshot_epoch  of the newest snapshot; 0: there is none
[[nodiscard]] std::vector<ServiceConsoles::Ticket> tickets_for_next_owner(std::string_view text, const rpc::Id& session,
                                                                          std::uint64_t snapshot_epoch);

}  // namespace tandem::server
